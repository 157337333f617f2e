// (F11) Standard errors by J⁺, since residuals have unit variance, and quantiles by how well the
// parts of that variance are known.
#include "calib/fit/uncertainty.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "calib/fit/specimen_effect.hpp"

namespace havers::calib {
namespace {

/// What the residuals' variances rest on: the part that the replicates' spread makes is as well
/// known as the replicates of all specimens of an orientation tell it.
struct VarianceSources {
  Eigen::VectorXd replicates;        // part of each residual's variance
  Eigen::VectorXd weight;            // 1/variance of each residual; 0 where it tells nothing
  std::vector<double> orientation;   // of each fitted specimen
  std::map<double, double> freedom;  // of the replicates, by orientation
};

VarianceSources sources_of(const FitProblem& problem, const Weights& weights,
                           const Evaluation& at) {
  const Eigen::Index count = at.residuals.size();
  VarianceSources result{.replicates = Eigen::VectorXd(count),
                         .weight = Eigen::VectorXd(count),
                         .orientation = {},
                         .freedom = {}};
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    const Eigen::Index row = first_row(f);
    result.orientation.push_back(problem.study.specimens[s].orientation);
    result.replicates.segment<landmark_count>(row) =
        (weights.replicates[s] / weights.sd[s]).square();
    result.weight.segment<landmark_count>(row) =
        tells(at.predictions[f], problem.targets[s])
            .select(weights.sd[s].square().inverse(), Landmarks(Landmarks::Zero()));
    result.freedom[result.orientation.back()] += std::max(at.predictions[f].usable - 1, 1);
  }
  return result;
}

// (F11) Part of an unknown's variance that the specimen effect of landmark q makes. Residuals tell
// that effect by their weights: the larger of the part as it is, and of that by weight.
double effect_share(const Eigen::VectorXd& shares, const Eigen::VectorXd& weight, Eigen::Index q) {
  double share = 0.0, weighted = 0.0, weights = 0.0, told = 0.0;
  for (Eigen::Index row = q; row < shares.size(); row += landmark_count) {
    share += shares[row];
    weighted += shares[row] * weight[row];
    weights += weight[row];
    told += weight[row] > 0.0 ? 1.0 : 0.0;
  }
  return told > 0.0 ? std::max(share, weighted * told / weights) : share;
}

// (F11) Satterthwaite: an unknown knows its own error only as well as the few replicates of a
// specimen, and, where the specimen effect was estimated, the few residuals of a landmark tell it.
double quantile(const Eigen::VectorXd& shares, const Landmarks& freedom, const Landmarks& effect,
                const VarianceSources& sources) {
  double inverse = 0.0;
  for (Eigen::Index q = 0; q < landmark_count; ++q) {
    std::map<double, double> by_replicates;
    for (Eigen::Index row = q; row < shares.size(); row += landmark_count)
      by_replicates[sources.orientation[static_cast<std::size_t>(row / landmark_count)]] +=
          shares[row] * sources.replicates[row];
    if (effect[q] > 0.0)
      inverse += std::pow(effect_share(shares, sources.weight, q), 2) / std::max(freedom[q], 1.0);
    for (const auto& [orientation, part] : by_replicates)
      inverse += part * part / sources.freedom.at(orientation);
  }
  // With a million degrees of freedom and more Student's t is as good as normal.
  return inverse > 1e-6 ? gsl_cdf_tdist_Pinv(0.975, std::max(1.0 / inverse, 1.0))
                        : gsl_cdf_ugaussian_Pinv(0.975);
}

}  // namespace

bool at_bound(const Unknown& unknown, double position) {
  const double margin = 0.005 * unknown.range();
  return position < unknown.lower + margin || position > unknown.upper - margin;
}

Eigen::MatrixXd free_columns(const FitProblem& problem, const Point& point, const Active& unknowns,
                             const Eigen::MatrixXd& jacobian) {
  std::vector<Eigen::Index> movable;
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k) {
    const Eigen::Index unknown = unknowns[static_cast<std::size_t>(k)];
    if (!at_bound(problem.unknown(unknown), point[unknown])) movable.push_back(k);
  }
  return jacobian(Eigen::all, movable);
}

Eigen::MatrixXd weighed(const FitProblem& problem, const Weights& had, const Weights& now,
                        Eigen::MatrixXd slopes) {
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const std::size_t s = problem.fitted[f];
    // Rows are divided by s, as residuals are.
    slopes.middleRows<landmark_count>(first_row(f)).array().colwise() *= had.sd[s] / now.sd[s];
  }
  return slopes;
}

Uncertainty uncertainty_of(const FitProblem& problem, const Weights& weights, const Evaluation& at,
                           const Active& active, const Eigen::MatrixXd& slopes) {
  // Errors hold at the values of what is left out, whose columns only cost degrees of freedom.
  const Eigen::MatrixXd jacobian = slopes.leftCols(static_cast<Eigen::Index>(active.size()));
  const VarianceSources sources = sources_of(problem, weights, at);

  Uncertainty result{.follow = jacobian.completeOrthogonalDecomposition().pseudoInverse()};
  const Eigen::MatrixXd& follow = result.follow;
  result.freedom = residuals_told(problem, at) - parameters_spent(problem, at, slopes);
  result.standard_error = follow.rowwise().norm();
  result.half_width = result.standard_error;
  for (Eigen::Index k = 0; k < follow.rows(); ++k) {
    // The share of each residual in the unknown's variance.
    const Eigen::VectorXd shares =
        follow.row(k).array().square() / std::max(follow.row(k).squaredNorm(), 1e-300);
    result.half_width[k] *= quantile(shares, result.freedom, weights.specimen, sources);
  }
  result.lower = -result.half_width;
  result.upper = result.half_width;
  // (F12) ½ |P r|², P the projection on the columns of the unknowns that are free to move.
  result.distance =
      0.5 * followed(free_columns(problem, at.point, active, jacobian), at.residuals).squaredNorm();
  return result;
}

}  // namespace havers::calib
