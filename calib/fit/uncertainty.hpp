// How well the answer is known.
#pragma once

#include <Eigen/Core>

#include "calib/fit/fit_problem.hpp"

namespace havers::calib {

/// Standard errors of the active unknowns, in the scale of their search (F11).
struct Uncertainty {
  Eigen::MatrixXd follow;  ///< J⁺, active unknowns by residuals, which have unit variance.
  Eigen::VectorXd standard_error;
  Eigen::VectorXd half_width;    ///< t quantile of 95 % times the standard error.
  Eigen::VectorXd lower, upper;  ///< Ends of the 95 % interval, from the answer (F11), (F22).
  Landmarks freedom = Landmarks::Zero();  ///< Residuals less the parameters spent (F9). [-]
  double distance =
      0.0;  ///< Expected fall of the cost to the minimum of the linear model (F12). [-]
};

/// @param slopes  the Jacobian of the active unknowns, then of those left out, which cost freedom.
/// Precondition: every active unknown is informed, so that its columns have full rank.
Uncertainty uncertainty_of(const FitProblem& problem, const Weights& weights, const Evaluation& at,
                           const Active& active, const Eigen::MatrixXd& slopes);

/// Whether a position lies at a bound of its unknown.
bool at_bound(const Unknown& unknown, double position);

/// The columns of unknowns that can follow the residuals: those that are not at a bound.
/// @param unknowns  of each column
Eigen::MatrixXd free_columns(const FitProblem& problem, const Point& point, const Active& unknowns,
                             const Eigen::MatrixXd& jacobian);

/// Slopes of residuals that were standardised by the weights `had`, as slopes of residuals
/// standardised by `now`.
Eigen::MatrixXd weighed(const FitProblem& problem, const Weights& had, const Weights& now,
                        Eigen::MatrixXd slopes);

}  // namespace havers::calib
