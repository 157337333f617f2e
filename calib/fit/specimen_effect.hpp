// How much specimens differ beyond noise and the model's own randomness.
#pragma once

#include "calib/fit/fit_problem.hpp"

namespace havers::calib {

/// Residuals of one landmark: difference of logarithms and its variance without the specimen
/// effect; of bounds how far above them the simulation is. [-]
struct Sample {
  std::vector<double> difference, variance;
  std::vector<double> above{}, variance_above{};
};

/// (F9) A variance between specimens with Σ difference²/(variance + it) = `freedom`, bounds by
/// (F25); 0 where the sum is less without one, or the freedom less than `least_freedom`.
double variance_between(const Sample& sample, double freedom);

/// With less freedom (residuals of a landmark less the parameters spent on it) nothing is told of
/// how much specimens differ. [-]
inline constexpr double least_freedom = 0.5;

/// How much of the columns' directions each row of J has: the sum of all is their number. [-]
Eigen::VectorXd leverage(const Eigen::MatrixXd& jacobian);
/// What of the residuals the columns can follow: their projection, by least squares.
Eigen::VectorXd followed(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals);

/// Parameters spent on each landmark, by the leverage of those of its residuals that tell how much
/// specimens differ (F9).
Landmarks parameters_spent(const FitProblem& problem, const Evaluation& at,
                           const Eigen::MatrixXd& jacobian);

/// Standard deviation between specimens of each log landmark (F9), by Paule and Mandel: one with
/// which the residuals of that landmark are no larger than they should be. Zero where
/// there are too few to tell.
Landmarks specimen_effect(const FitProblem& problem, const Weights& weights, const Evaluation& at,
                          const Eigen::MatrixXd& jacobian);

}  // namespace havers::calib
