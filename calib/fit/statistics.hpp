// Mean and standard deviation of a few values.
#pragma once

#include <vector>

namespace havers::calib {

struct Statistics {
  long n = 0;
  double mean = 0.0, sd = 0.0;  ///< NaN without enough values: one, and two.

  /// Of the mean. NaN for fewer than two values, as is the half width.
  [[nodiscard]] double standard_error() const;
  /// Half width of the interval of confidence 1 − `risk`, by Student's t.
  [[nodiscard]] double half_width(double risk = 0.05) const;
};

/// Of finite values.
Statistics statistics_of(const std::vector<double>& values);

}  // namespace havers::calib
