// Noise is found from second differences, in which a smooth signal cancels, and the strain rate
// from steps of strain. Both are medians, so that a few breaks, jumps and holds do not matter.
#include "calib/experiment/channel_noise.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace havers::calib {
double median(std::vector<double> values) {
  return values.empty() ? 0.0 : gsl_stats_median(values.data(), 1, values.size());
}

// (X7) Second differences of white noise have six times its variance. The median is deaf to breaks
// and jumps.
double noise_of(std::span<const double> values, std::size_t lag) {
  const std::size_t stride = 1 + values.size() / enough_for_median;
  std::vector<double> differences;
  for (std::size_t i = lag; i + lag < values.size(); i += stride) {
    const double difference = std::abs(values[i - lag] - 2.0 * values[i] + values[i + lag]);
    // Spikes are sought before a record with numbers that are not finite is refused.
    if (std::isfinite(difference)) differences.push_back(difference);
  }
  // Standard deviation of a normal law over the median of its absolute values.
  constexpr double normal_sd_per_median = 1.4826;
  return normal_sd_per_median * median(std::move(differences)) / std::sqrt(6.0);
}

// (X7) Neighbours that err alike differ by less than their noise; rows farther apart show all of
// it. Growth that the scatter of a median of so few rows explains does not count.
double settled_noise_of(std::span<const double> values) {
  constexpr std::size_t fewest_lags = 40;  // in the record: over more of it the signal itself bends
  const double growth = 1.0 + 3.0 / std::sqrt(static_cast<double>(values.size()));
  double noise = noise_of(values);
  for (std::size_t lag = 2; lag * fewest_lags <= values.size(); lag *= 2)
    if (const double farther = noise_of(values, lag); farther > growth * noise) noise = farther;
  return noise;
}

// (X7) Goes backwards from the strength and keeps the row of the lowest strain so far. A row before
// that one with more strain and more stress shows that the specimen was unloaded in between. Noise
// does not move both channels together.
std::size_t last_loading(std::span<const double> strain, std::span<const double> stress) {
  assert(strain.size() == stress.size());
  constexpr std::size_t fewest = 20;
  constexpr double part = 0.05, noises = 5.0;
  if (strain.size() < fewest) return 0;
  const auto least_fall = [&](std::span<const double> values) {
    return std::max(part * values.back(), noises * noise_of(values));
  };
  const double least_strain = least_fall(strain), least_stress = least_fall(stress);
  std::size_t lowest = strain.size() - 1;
  for (std::size_t row = lowest; row-- > 0;) {
    if (strain[row] < strain[lowest]) lowest = row;
    if (strain[row] - strain[lowest] > least_strain && stress[row] - stress[lowest] > least_stress)
      return strain.size() - lowest < fewest ? 0 : lowest;
  }
  return 0;
}

// (X8) Goes through the levels of strain from the top down, each where it was last crossed: waiting
// and cycles before that are passed over.
double loading_rate(std::span<const double> strain, std::span<const double> time) {
  assert(strain.size() == time.size());
  if (strain.empty() || strain.back() <= 0.0) return 0.0;
  constexpr int steps = 20;
  const double step = strain.back() / steps;
  std::vector<double> rates;
  double above = time.back();
  std::size_t i = strain.size() - 1;
  for (int level = steps - 1; level > 0; --level) {
    const double at = level * step;
    while (i > 0 && strain[i] >= at) --i;
    if (strain[i] >= at) break;  // the record begins above it
    const double part = (at - strain[i]) / (strain[i + 1] - strain[i]);
    const double passed = std::lerp(time[i], time[i + 1], part);
    // Two levels that are crossed at one time have no rate between them.
    if (above > passed) rates.push_back(step / (above - passed));
    above = passed;
  }
  return median(std::move(rates));
}

double rows_per_independent(std::span<const double> residuals) {
  constexpr std::size_t furthest = 200;
  double squares = 0.0, rows = 1.0;
  for (const double residual : residuals) squares += residual * residual;
  if (!(squares > 0.0)) return rows;
  for (std::size_t lag = 1; lag < std::min(furthest, residuals.size()); ++lag) {
    double products = 0.0;
    for (std::size_t i = lag; i < residuals.size(); ++i)
      products += residuals[i] * residuals[i - lag];
    // r(k) = products / squares; below 2/√rows it is chance, and the sum ends.
    if (products * std::sqrt(static_cast<double>(residuals.size())) < 2.0 * squares) break;
    rows += 2.0 * products / squares;
  }
  return rows;
}

}  // namespace havers::calib
