#include "calib/porosity/method_comparison.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace havers::calib {
namespace {

// Precondition: at least one trial.
MethodSummary summary_of(PorosityMethod method, const std::vector<PorosityTrial>& trials) {
  MethodSummary summary{.method = method,
                        .worst_if_none = std::numeric_limits<double>::quiet_NaN()};
  std::vector<double> errors;
  errors.reserve(trials.size());
  double pixels = 0.0, cpu = 0.0;
  for (const PorosityTrial& trial : trials) {
    errors.push_back(trial.error(method));
    // fmax takes the number where the other is none.
    if (trial.truth == 0.0) summary.worst_if_none = std::fmax(summary.worst_if_none, errors.back());
    pixels += trial.pixels;
    cpu += trial.readings.at(static_cast<std::size_t>(method)).cpu;
  }
  summary.worst_error = std::ranges::max(errors);
  summary.median_error = gsl_stats_median(errors.data(), 1, errors.size());
  // The ratio of the sums, so that a large image weighs by its size.
  summary.cpu_per_pixel = cpu / pixels;
  return summary;
}

std::array<MethodSummary, porosity_methods> summaries_of(const std::vector<PorosityTrial>& trials) {
  std::array<MethodSummary, porosity_methods> all;
  for (std::size_t i = 0; i < all.size(); ++i)
    all.at(i) = summary_of(static_cast<PorosityMethod>(i), trials);
  return all;
}

}  // namespace

std::string to_string(PorosityMethod method) {
  constexpr std::array words{"middle of the grey scale, whole image", "Otsu, whole image",
                             "Otsu inside the bone", "havers porosity"};
  return words.at(static_cast<std::size_t>(method));
}

double PorosityTrial::error(PorosityMethod method) const {
  return std::abs(readings.at(static_cast<std::size_t>(method)).porosity - truth);
}

MethodComparison compare_methods(std::vector<PorosityTrial> trials) {
  assert(!trials.empty());
  MethodComparison comparison{.methods = summaries_of(trials)};
  // In the order in which they first occur.
  std::vector<std::string> known;
  for (const PorosityTrial& trial : trials)
    if (std::ranges::find(known, trial.hardship) == known.end()) known.push_back(trial.hardship);
  for (const std::string& hardship : known) {
    std::vector<PorosityTrial> some;
    for (const PorosityTrial& trial : trials)
      if (trial.hardship == hardship) some.push_back(trial);
    comparison.hardships.push_back({hardship, summaries_of(some)});
  }
  comparison.trials = std::move(trials);
  return comparison;
}

}  // namespace havers::calib
