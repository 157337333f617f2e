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

/// Standard deviation of the noise of a smooth signal, from its second differences over so many
/// rows (X7): of what differs between them. Unit of `values`.
double noise_of(std::span<const double> values, std::size_t lag = 1);

/// The same where rows that are near err alike: over as many rows as it grows with (X7).
double settled_noise_of(std::span<const double> values);

/// Row at which the last loading begins of a record that ends at the strength: from there strain
/// and stress do not go back together (X7). 0 where it has too few rows to tell a noise.
std::size_t last_loading(std::span<const double> strain, std::span<const double> stress);

/// Strain rate of the loading up to the last row (X8); 0 where time does not advance. [1/s]
double loading_rate(std::span<const double> strain, std::span<const double> time);

/// How many rows tell as much as one that is independent of the others: what a model leaves of a
/// record is no white noise. 1 + 2 Σ r(k), r the autocorrelation, up to the first k at which it is
/// within 2/√rows of zero (X4), (X17).
double rows_per_independent(std::span<const double> residuals);

}  // namespace havers::calib
