#include "calib/fit/uncertainty.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "calib/fit/specimen_effect.hpp"

namespace havers::calib {
namespace {

using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

// (F11) Satterthwaite: where the specimen effect was estimated, an unknown that rests on a landmark
// knows its own error only as well as that landmark's few residuals tell it.
double quantile(const Eigen::VectorXd& shares, const Landmarks& freedom, const Landmarks& effect) {
  double inverse = 0.0;
  for (Eigen::Index q = 0; q < landmark_count; ++q) {
    double share = 0.0;
    for (Eigen::Index row = q; row < shares.size(); row += landmark_count) share += shares[row];
    if (effect[q] > 0.0) inverse += share * share / std::max(freedom[q], 1.0);
  }
  return inverse > 1e-6 ? gsl_cdf_tdist_Pinv(0.975, 1.0 / inverse) : gsl_cdf_ugaussian_Pinv(0.975);
}

// (F12) ½ |P r|², P the projection on the columns of the unknowns that are free to move.
double distance_to_minimum(const FitProblem& problem, const Evaluation& at, const Active& active,
                           const Eigen::MatrixXd& jacobian) {
  std::vector<Eigen::Index> movable;
  for (std::size_t i = 0; i < active.size(); ++i)
    if (!at_bound(problem.unknowns[static_cast<std::size_t>(active[i])], at.point[active[i]]))
      movable.push_back(static_cast<Eigen::Index>(i));
  if (movable.empty()) return 0.0;
  const Svd svd(jacobian(Eigen::all, movable), Eigen::ComputeThinU);
  return 0.5 * (svd.matrixU().leftCols(svd.rank()).transpose() * at.residuals).squaredNorm();
}

}  // namespace

bool at_bound(const Unknown& unknown, double position) {
  const double margin = 0.005 * unknown.range();
  return position < unknown.lower + margin || position > unknown.upper - margin;
}

Uncertainty uncertainty_of(const FitProblem& problem, const Weights& weights, const Evaluation& at,
                           const Active& active, const Eigen::MatrixXd& jacobian) {
  const Svd svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  // Row k of the pseudo-inverse says how unknown k follows each residual, which has unit variance.
  const Eigen::MatrixXd follow =
      svd.solve(Eigen::MatrixXd::Identity(jacobian.rows(), jacobian.rows()));
  const Landmarks freedom = landmarks_present(problem) - parameters_spent(jacobian);

  Uncertainty result;
  result.standard_error = follow.rowwise().norm();
  result.half_width = result.standard_error;
  for (Eigen::Index k = 0; k < follow.rows(); ++k) {
    const Eigen::VectorXd shares =
        follow.row(k).array().square() / std::max(follow.row(k).squaredNorm(), 1e-300);
    result.half_width[k] *= quantile(shares, freedom, weights.specimen);
  }
  result.distance = distance_to_minimum(problem, at, active, jacobian);
  return result;
}

}  // namespace havers::calib
