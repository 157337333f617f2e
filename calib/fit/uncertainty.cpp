#include "calib/fit/uncertainty.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "calib/fit/specimen_effect.hpp"

namespace havers::calib {
namespace {

/// Part of each residual's variance that the replicates' spread makes, and how well that is known:
/// from the replicates of all specimens of an orientation.
struct Replicates {
  Eigen::VectorXd part;             // of each residual
  std::vector<double> orientation;  // of each fitted specimen
  std::map<double, double> freedom;
};

Replicates replicates_of(const FitProblem& problem, const Weights& weights, const Evaluation& at) {
  Replicates result{.part = Eigen::VectorXd(at.residuals.size()), .orientation = {}, .freedom = {}};
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    result.orientation.push_back(problem.study.specimens[s].orientation);
    result.part.segment<landmark_count>(landmark_count * static_cast<Eigen::Index>(f)) =
        (weights.replicates[s] / weights.sd[s]).square();
    result.freedom[result.orientation.back()] += std::max(at.predictions[f].usable - 1, 1);
  }
  return result;
}

// (F11) Satterthwaite: an unknown knows its own error only as well as the few replicates of a
// specimen, and, where the specimen effect was estimated, the few residuals of a landmark tell it.
double quantile(const Eigen::VectorXd& shares, const Landmarks& freedom, const Landmarks& effect,
                const Replicates& replicates) {
  double inverse = 0.0;
  for (Eigen::Index q = 0; q < landmark_count; ++q) {
    double share = 0.0;
    std::map<double, double> by_replicates;
    for (Eigen::Index row = q; row < shares.size(); row += landmark_count) {
      share += shares[row];
      by_replicates[replicates.orientation[static_cast<std::size_t>(row / landmark_count)]] +=
          shares[row] * replicates.part[row];
    }
    if (effect[q] > 0.0) inverse += share * share / std::max(freedom[q], 1.0);
    for (const auto& [orientation, part] : by_replicates)
      inverse += part * part / replicates.freedom.at(orientation);
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
  const Eigen::MatrixXd columns = jacobian(Eigen::all, movable);
  return 0.5 *
         (columns * columns.completeOrthogonalDecomposition().solve(at.residuals)).squaredNorm();
}

}  // namespace

bool at_bound(const Unknown& unknown, double position) {
  const double margin = 0.005 * unknown.range();
  return position < unknown.lower + margin || position > unknown.upper - margin;
}

Uncertainty uncertainty_of(const FitProblem& problem, const Weights& weights, const Evaluation& at,
                           const Active& active, const Eigen::MatrixXd& slopes) {
  const Eigen::MatrixXd jacobian = slopes.leftCols(static_cast<Eigen::Index>(active.size()));
  const Replicates replicates = replicates_of(problem, weights, at);

  Uncertainty result{.follow = jacobian.completeOrthogonalDecomposition().pseudoInverse()};
  const Eigen::MatrixXd& follow = result.follow;
  result.freedom = residuals_told(problem, at) - parameters_spent(slopes);
  result.standard_error = follow.rowwise().norm();
  result.half_width = result.standard_error;
  for (Eigen::Index k = 0; k < follow.rows(); ++k) {
    const Eigen::VectorXd shares =
        follow.row(k).array().square() / std::max(follow.row(k).squaredNorm(), 1e-300);
    result.half_width[k] *= quantile(shares, result.freedom, weights.specimen, replicates);
  }
  result.lower = -result.half_width;
  result.upper = result.half_width;
  result.distance = distance_to_minimum(problem, at, active, jacobian);
  return result;
}

}  // namespace havers::calib
