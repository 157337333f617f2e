#include "calib/sweep/strength_law.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calib/fit/plain_law.hpp"
#include "calib/sweep/measure.hpp"

namespace havers::calib {
namespace {

// The scale belonging to Weibull's modulus, relative to the largest value, which keeps powers
// small.
double scale_of(std::span<const double> values, double modulus) {
  const double largest = *std::ranges::max_element(values);
  double mean = 0.0;
  for (const double x : values)
    mean += std::pow(x / largest, modulus) / static_cast<double>(values.size());
  return largest * std::pow(mean, 1.0 / modulus);
}

// Log-likelihood of the smallest-value law of location a and width b for values y.
double log_likelihood(std::span<const double> y, double a, double b) {
  double sum = 0.0;
  for (const double value : y) {
    const double z = (value - a) / b;
    sum += z - std::exp(z) - std::log(b);
  }
  return sum;
}

}  // namespace

// If exp(x/s) is Weibull of modulus m and scale q, then x is Gumbel of width s/m and location s ln
// q; and ln x of a Weibull x is Gumbel. So one maximisation serves both.
StrengthLaw strength_law(std::span<const double> strengths) {
  const std::vector<double> values(strengths.begin(), strengths.end());
  const Statistics all = statistics_of(values);
  StrengthLaw law;
  // Too few runs tell no law, and equal strengths have none.
  if (all.n < 5 || !(all.sd > 1e-9 * all.mean)) return law;
  law.runs = all.n;
  const Weibull fitted = weibull(values);
  law.weibull_modulus = fitted.modulus;
  law.weibull_modulus_95 = fitted.interval_95;
  law.weibull_scale = scale_of(values, fitted.modulus);

  std::vector<double> powers, logs;
  for (const double x : values) {
    // Shifted and scaled by mean and deviation, so that no exponential overflows.
    powers.push_back(std::exp((x - all.mean) / all.sd));
    logs.push_back(std::log(x));
  }
  const double modulus = weibull(powers).modulus;
  law.gumbel_width = all.sd / modulus;
  law.gumbel_location = all.mean + all.sd * std::log(scale_of(powers, modulus));
  double jacobian = 0.0;  // densities of x, not of ln x, are compared
  for (const double log : logs) jacobian += log;
  law.log_likelihood_gain =
      log_likelihood(values, law.gumbel_location, law.gumbel_width) -
      (log_likelihood(logs, std::log(law.weibull_scale), 1.0 / law.weibull_modulus) - jacobian);
  return law;
}

}  // namespace havers::calib
