#include "calib/fit/bound.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_erf.h>

#include <cmath>
#include <numbers>

namespace havers::calib {
namespace {

// log Φ(z).
double log_chance(double z) {
  // log(1 − Q) keeps the digits of a chance near 1, log erfc those of one near 0.
  return z > 0.0 ? std::log1p(-gsl_cdf_ugaussian_Q(z))
                 : gsl_sf_log_erfc(-z / std::numbers::sqrt2) - std::numbers::ln2;
}

// φ(z)/Φ(z).
double hazard(double z) {
  return std::exp(-0.5 * z * z - log_chance(z)) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
}

}  // namespace

double residual_of_bound(double z) {
  return -std::sqrt(-2.0 * log_chance(z));
}

double slope_of_bound(double z) {
  const double residual = residual_of_bound(z);
  // residual² = −2 log Φ, differentiated. Far above the bound both are 0.
  return residual < 0.0 ? -hazard(z) / residual : 0.0;
}

double square_of_bound(double z) {
  return z * hazard(z);
}

}  // namespace havers::calib
