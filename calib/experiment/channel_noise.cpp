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
double noise_of(std::span<const double> values) {
  const std::size_t stride = 1 + values.size() / enough_for_median;
  std::vector<double> differences;
  for (std::size_t i = 1; i + 1 < values.size(); i += stride) {
    const double difference = std::abs(values[i - 1] - 2.0 * values[i] + values[i + 1]);
    if (std::isfinite(difference)) differences.push_back(difference);
  }
  constexpr double normal_sd_per_median = 1.4826;
  return normal_sd_per_median * median(std::move(differences)) / std::sqrt(6.0);
}

// (X8) Over a twentieth of the record, so that noise between neighbours does not count.
double median_rate(std::span<const double> values, std::span<const double> time) {
  assert(values.size() == time.size());
  const std::size_t span = std::max<std::size_t>(1, values.size() / 20);
  const std::size_t stride = 1 + values.size() / enough_for_median;
  std::vector<double> rates;
  for (std::size_t i = 0; i + span < values.size(); i += stride)
    if (time[i + span] > time[i])
      rates.push_back((values[i + span] - values[i]) / (time[i + span] - time[i]));
  return median(std::move(rates));
}

}  // namespace havers::calib
