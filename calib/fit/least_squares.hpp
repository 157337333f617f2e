// Least squares inside bounds, with derivatives by differences that are taken in parallel and never
// outside.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace havers::calib {

/// What to make small. `residuals` answers many points in one batch, in their order, with vectors
/// of one size; an empty vector says that a point has failed.
struct LeastSquares {
  std::function<std::vector<Eigen::VectorXd>(const std::vector<Eigen::VectorXd>&)> residuals;
  Eigen::VectorXd lower, upper;  ///< Bounds; infinite where there are none.
};

struct LeastSquaresOptions {
  double step = 0.05;            ///< Of the derivatives, see `relative`.
  bool relative = false;         ///< The step is a part of the unknown's magnitude.
  int stencil = 2;               ///< Points per derivative: 2, or 4 where residuals are exact.
  int max_iterations = 30;       ///< Steps of Levenberg-Marquardt.
  double cost_tolerance = 1e-4;  ///< Part of the cost that a step must win to go on.
  double trust_radius = 1e4;     ///< Of the first step; less is more cautious.
  bool search_steps = false;     ///< Beside bounds along each step: where residuals are exact.
  double step_tolerance = 1e-4;  ///< Part of the unknowns' norm that a step must move to go on.
};

struct LeastSquaresResult {
  bool failed = true;  ///< The start gave no residuals.
  Eigen::VectorXd best;
  Eigen::VectorXd residuals;  ///< At the best point.
  double cost = 0.0;          ///< ½ Σ residual².
  std::string message{};
};

/// Levenberg and Marquardt's method, by Ceres. Returns the best point that a step tried: those of
/// the differences do not count.
LeastSquaresResult least_squares(const LeastSquares& problem, const Eigen::VectorXd& start,
                                 const LeastSquaresOptions& options = {});

/// ∂(residuals)/∂x by central differences (F8), one-sided at a bound and beside points that fail;
/// a column without two usable points is zero. `here` are the residuals at `at`.
Eigen::MatrixXd difference_jacobian(const LeastSquares& problem, const Eigen::VectorXd& at,
                                    const Eigen::VectorXd& here,
                                    const LeastSquaresOptions& options = {});

}  // namespace havers::calib
