// How well the answer is known.
#pragma once

#include <Eigen/Core>

#include "calib/fit/differences.hpp"

namespace havers::calib {

/// Standard errors of the active unknowns, in the scale of their search (F11).
struct Uncertainty {
  Eigen::VectorXd standard_error;
  Eigen::VectorXd half_width;  ///< Of the 95 % interval: t quantile times the standard error.
  double distance =
      0.0;  ///< Expected fall of the cost to the minimum of the linear model (F12). [-]
};

/// Precondition: every active unknown is informed, so that the Jacobian has full rank.
Uncertainty uncertainty_of(const FitProblem& problem, const Weights& weights, const Evaluation& at,
                           const Active& active, const Eigen::MatrixXd& jacobian);

/// Whether a position lies at a bound of its unknown.
bool at_bound(const Unknown& unknown, double position);

}  // namespace havers::calib
