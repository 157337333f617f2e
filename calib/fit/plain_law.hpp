// Laws without fibres, for the model to be better than.
#pragma once

#include <array>
#include <span>
#include <string>

#include "calib/study/study.hpp"

namespace havers::calib {

/// One specimen as a law without fibres sees it.
struct Broken {
  double orientation = 0.0;  ///< θ. [rad]
  double scatter = 0.0;      ///< d. [-]
  double ratio = 1.0;        ///< r that the fitted model has. [-]
  double strength = 0.0;     ///< log of the measured strength.
  double model = 0.0;        ///< log of the strength that the fitted model gives.
};

/// The strength by the law that holds at the specimen's orientation or nearest to its ratio; NaN
/// where there is none. [Pa]
double strength_by(std::span<const SweepLaw> laws, const Broken& specimen);

/// Corrected information criterion of Akaike (F19); infinite where there are too few specimens.
/// @param parameters  those of the mean; the variance is one more.
double aicc(double sum_of_squares, double specimens, double parameters);

/// The best law of those that are linear elastic and brittle, after the laws of failure strain of
/// Pithioux et al.: per orientation a strength, and a slope in d or none; or a sweep's laws times a
/// factor.
struct PlainLaw {
  std::string name;
  double criterion = 0.0;        ///< aicc of the law.
  double model_criterion = 0.0;  ///< aicc of the model, on the same strengths.
  bool laws_compared = false;    ///< A sweep's laws, which have to hold for every specimen.
};

/// @param model_parameters  spent by the model on the strengths.
PlainLaw best_plain_law(std::span<const Broken> specimens, double model_parameters,
                        std::span<const SweepLaw> laws = {});

/// Weibull's modulus of positive values (F23). [-]
struct Weibull {
  double modulus = 0.0;   ///< By maximum likelihood, which of few values makes it too large.
  double unbiased = 0.0;  ///< As often too large as too small.
  std::array<double, 2> interval_95{};
};
/// Precondition: at least two values that differ.
Weibull weibull(std::span<const double> values);

}  // namespace havers::calib
