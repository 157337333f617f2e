#include "calib/fit/statistics.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <cmath>
#include <limits>

namespace havers::calib {

double Statistics::standard_error() const {
  return sd / std::sqrt(static_cast<double>(n));
}

double Statistics::half_width(double risk) const {
  if (n < 2) return std::numeric_limits<double>::quiet_NaN();
  return gsl_cdf_tdist_Qinv(0.5 * risk, static_cast<double>(n - 1)) * standard_error();
}

Statistics statistics_of(const std::vector<double>& values) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = values.size();
  return {.n = static_cast<long>(n),
          .mean = n > 0 ? gsl_stats_mean(values.data(), 1, n) : unknown,
          .sd = n > 1 ? gsl_stats_sd(values.data(), 1, n) : unknown};
}

}  // namespace havers::calib
