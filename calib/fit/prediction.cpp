#include "calib/fit/prediction.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace havers::calib {

Landmarks landmarks_of(const Response& response) {
  assert(!response.failed);
  const double log_modulus = std::log(response.modulus);
  const double log_strength = std::log(response.strength);
  Landmarks landmarks = shape_of(response.strain, response.stress);
  landmarks[modulus] = log_modulus;
  landmarks[strength] = log_strength;
  landmarks[linearity] = log_strength - log_modulus - std::log(response.failure_strain);
  return landmarks;
}

// A failed replicate keeps its place, as replicates of two points are compared pair by pair (F2).
Prediction summarise(std::span<const Response> responses) {
  assert(!responses.empty());
  Prediction result;
  int unbroken = 0;
  for (const auto& response : responses) {
    if (response.failed) {
      result.replicates.emplace_back(Landmarks::Constant(std::numeric_limits<double>::quiet_NaN()));
      continue;
    }
    result.replicates.push_back(landmarks_of(response));
    result.mean += result.replicates.back();
    ++result.usable;
    unbroken += response.broke ? 0 : 1;
  }
  if (result.usable == 0) return result;
  result.mean /= result.usable;
  result.censored = 2 * unbroken > result.usable;

  for (const auto& replicate : result.replicates)
    if (replicate.isFinite().all()) result.sd += (replicate - result.mean).square();
  // Of a single replicate it is 0.
  result.sd = (result.sd / std::max(result.usable - 1, 1)).sqrt();
  return result;
}

}  // namespace havers::calib
