// The distribution of strength over the seeds, as two laws of the weakest link (W6).
#pragma once

#include <array>
#include <span>

namespace havers::calib {

/// Weibull: P(s < x) = 1 − exp(−(x/scale)^modulus). Gumbel: 1 − exp(−exp((x − location)/width)).
struct StrengthLaw {
  long runs = 0;                               ///< 0: too few, or all equal; nothing else is set.
  double weibull_modulus = 0.0;                ///< [-]
  std::array<double, 2> weibull_modulus_95{};  ///< 95 % interval (F23). [-]
  double weibull_scale = 0.0;                  ///< [Pa]
  double gumbel_location = 0.0;                ///< [Pa]
  double gumbel_width = 0.0;                   ///< [Pa]
  double log_likelihood_gain = 0.0;  ///< Of Gumbel over Weibull; above 2 it is clearly better. [-]
};

/// By maximum likelihood. Precondition: strengths are positive.
StrengthLaw strength_law(std::span<const double> strengths);

}  // namespace havers::calib
