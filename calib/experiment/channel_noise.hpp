// Noise and median slope of a recorded channel.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace havers::calib {

/// Of longer records these many rows tell a median to half a percent of its scatter; noise and
/// rates are medians over so many.
inline constexpr std::size_t enough_for_median = 1U << 16U;

/// Median; 0 of nothing.
double median(std::vector<double> values);

/// Standard deviation of the noise of a smooth signal, from its second differences (X7). Unit of
/// `values`.
double noise_of(std::span<const double> values);

/// Median rate of a signal over its record (X8); 0 where time does not advance. [unit of values /
/// s]
double median_rate(std::span<const double> values, std::span<const double> time);

}  // namespace havers::calib
