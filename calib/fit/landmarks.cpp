// (F4) The landmarks that need a whole curve. Up to the peak its rows are averaged in blocks,
// against noise, and taken as parts of stress and strain at the peak, so that scales do not matter.
#include "calib/fit/landmarks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace havers::calib {
namespace {

// A noisy curve is longer than the line through it: its rows are averaged down to about so many.
constexpr std::size_t blocks = 64;
constexpr int heights = 7;      // at 1/8 ... 7/8 of the arc length
constexpr double least = 1e-3;  // of the energy of a straight curve, so that a logarithm exists

/// A curve up to its peak as part of strain and stress there; it ends in (1, 1).
struct Normalised {
  std::vector<double> strain{0.0}, stress{0.0};
};

// Rows beyond the last whole block are left out; the peak is the last point by itself.
Normalised normalised(std::span<const double> strain, std::span<const double> stress,
                      std::size_t peak) {
  Normalised curve;
  const std::size_t block = std::max<std::size_t>(peak / blocks, 1);
  for (std::size_t first = 0; first + block <= peak; first += block) {
    double mean_strain = 0.0, mean_stress = 0.0;
    for (std::size_t i = first; i < first + block; ++i) {
      mean_strain += strain[i];
      mean_stress += stress[i];
    }
    const auto rows = static_cast<double>(block);
    curve.strain.push_back(mean_strain / rows / strain[peak]);
    curve.stress.push_back(mean_stress / rows / stress[peak]);
  }
  curve.strain.push_back(1.0);
  curve.stress.push_back(1.0);
  return curve;
}

// y₄: heights above the chord at equal parts of the arc length.
double mean_height(const Normalised& curve) {
  std::vector<double> length{0.0};
  for (std::size_t i = 1; i < curve.strain.size(); ++i)
    length.push_back(length.back() + std::hypot(curve.strain[i] - curve.strain[i - 1],
                                                curve.stress[i] - curve.stress[i - 1]));
  double sum = 0.0;
  for (int k = 1; k <= heights; ++k) {
    const double at = length.back() * k / (heights + 1);
    const auto i = static_cast<std::size_t>(
        std::max<std::ptrdiff_t>(std::ranges::lower_bound(length, at) - length.begin(), 1));
    const double span = length[i] - length[i - 1];
    const double part = span > 0.0 ? (at - length[i - 1]) / span : 1.0;
    const auto height = [&](std::size_t j) { return curve.stress[j] - curve.strain[j]; };
    sum += height(i - 1) + part * (height(i) - height(i - 1));
  }
  return sum / heights;
}

// Of a straight curve, ½.
double area(const Normalised& curve) {
  double sum = 0.0;
  for (std::size_t i = 1; i < curve.strain.size(); ++i)
    sum += 0.5 * (curve.stress[i] + curve.stress[i - 1]) * (curve.strain[i] - curve.strain[i - 1]);
  return sum;
}

// y₆, to the first row at half the peak or below; the end of a curve counts as its fall.
double strain_of_fall(std::span<const double> strain, std::span<const double> stress,
                      std::size_t peak) {
  std::size_t i = peak;
  while (i + 1 < stress.size() && stress[i] > fallen_part * stress[peak]) ++i;
  return std::max(strain[i] / strain[peak] - 1.0, 0.0);
}

}  // namespace

std::string_view name_of(Landmark landmark) {
  constexpr std::array<std::string_view, landmark_count> names{
      "modulus", "strength", "failure strain", "pre-peak curve", "energy", "post-peak drop"};
  return names.at(static_cast<std::size_t>(landmark));
}

Landmarks shape_of(std::span<const double> strain, std::span<const double> stress) {
  Landmarks shape = Landmarks::Zero();
  if (stress.empty() || strain.size() != stress.size()) return shape;
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
  // Nothing can be taken as a part of a peak without strain or stress.
  if (!(strain[peak] > 0.0 && stress[peak] > 0.0)) return shape;
  const Normalised curve = normalised(strain, stress, peak);
  shape[pre_peak] = mean_height(curve);
  shape[energy] = std::log(std::max(2.0 * area(curve), least));
  shape[post_peak] = strain_of_fall(strain, stress, peak);
  return shape;
}

}  // namespace havers::calib
