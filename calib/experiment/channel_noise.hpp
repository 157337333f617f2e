// Noise and median slope of a recorded channel.
#pragma once

#include <span>
#include <vector>

namespace havers::calib {

/// Median; 0 of nothing.
double median(std::vector<double> values);

/// Standard deviation of the noise of a smooth signal, from its second differences (X7). Unit of
/// `values`.
double noise_of(std::span<const double> values);

/// Median rate of a signal over its record (X8); 0 where time does not advance. [unit of values /
/// s]
double median_rate(std::span<const double> values, std::span<const double> time);

}  // namespace havers::calib
