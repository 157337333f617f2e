// Levenberg-Marquardt steps by Ceres, the Jacobian by batches of differences.
#include "calib/fit/least_squares.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace havers::calib {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd inside(const LeastSquares& problem, const VectorXd& point) {
  return point.cwiseMax(problem.lower).cwiseMin(problem.upper);
}

// Ceres' own numeric derivatives leave the bounds and run one point at a time; these do neither.
// The best point tried is kept here. Members are mutable, as Ceres calls Evaluate of a const
// object.
class Residuals final : public ceres::CostFunction {
 public:
  Residuals(const LeastSquares& problem, const LeastSquaresOptions& options, VectorXd start,
            VectorXd here)
      : problem_(problem), options_(options), at_(std::move(start)), here_(std::move(here)) {
    set_num_residuals(static_cast<int>(here_.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(at_.size()));
    keep_best();
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    move_to(Eigen::Map<const VectorXd>(parameters[0], at_.size()));
    // The point failed: Ceres then tries a shorter step.
    if (here_.size() == 0) return false;
    std::ranges::copy(here_, residuals);
    if (!jacobians || !jacobians[0]) return true;
    const Eigen::MatrixXd slopes = difference_jacobian(problem_, at_, here_, options_);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        jacobians[0], here_.size(), at_.size()) = slopes;
    return true;
  }

  void report(LeastSquaresResult& result) const {
    result.best = best_;
    result.residuals = best_residuals_;
    result.cost = 0.5 * best_residuals_.squaredNorm();
  }

 private:
  // Ceres asks for a point's residuals, then for its derivatives: it is simulated once.
  void move_to(const VectorXd& point) const {
    if (point == at_) return;
    at_ = point;
    here_ = problem_.residuals({inside(problem_, point)}).front();
    if (!here_.allFinite()) here_.resize(0);
    if (here_.size() > 0 && here_.squaredNorm() < best_residuals_.squaredNorm()) keep_best();
  }

  void keep_best() const {
    best_ = inside(problem_, at_);
    best_residuals_ = here_;
  }

  const LeastSquares& problem_;
  const LeastSquaresOptions& options_;
  mutable VectorXd at_, here_, best_, best_residuals_;
};

void set_bounds(const LeastSquares& problem, std::vector<double>& values,
                ceres::Problem& description) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto k = static_cast<Index>(i);
    if (std::isfinite(problem.lower[k]))
      description.SetParameterLowerBound(values.data(), static_cast<int>(i), problem.lower[k]);
    if (std::isfinite(problem.upper[k]))
      description.SetParameterUpperBound(values.data(), static_cast<int>(i), problem.upper[k]);
  }
}

}  // namespace

Eigen::MatrixXd difference_jacobian(const LeastSquares& problem, const VectorXd& at,
                                    const VectorXd& here, const LeastSquaresOptions& options) {
  assert(options.stencil == 2 || options.stencil == 4);
  // Of unknown k and pair p the lower point has the index 2 (k · pairs + p), the upper one the
  // next.
  const Index pairs = options.stencil / 2;
  std::vector<VectorXd> points;
  for (Index k = 0; k < at.size(); ++k) {
    const double size = options.relative ? std::max(std::abs(at[k]), 1e-8) : 1.0;
    for (Index pair = 1; pair <= pairs; ++pair)
      for (const double side : {-1.0, 1.0}) {
        VectorXd moved = at;
        moved[k] += side * static_cast<double>(pair) * options.step * size;
        points.push_back(inside(problem, moved));
      }
  }
  const auto values = problem.residuals(points);

  // One-sided where the other side failed; 0 where both did, or where bounds leave no room.
  const auto slope = [&](Index k, Index pair) -> VectorXd {
    const auto low = static_cast<std::size_t>(2 * (k * pairs + pair));
    const bool low_fails = values[low].size() == 0, high_fails = values[low + 1].size() == 0;
    const double span =
        (high_fails ? at[k] : points[low + 1][k]) - (low_fails ? at[k] : points[low][k]);
    if (!(span > 0.0)) return VectorXd::Zero(here.size());
    return ((high_fails ? here : values[low + 1]) - (low_fails ? here : values[low])) / span;
  };
  Eigen::MatrixXd jacobian(here.size(), at.size());
  for (Index k = 0; k < at.size(); ++k) {
    jacobian.col(k) = slope(k, 0);
    if (pairs == 1) continue;
    // The errors of the two central differences are as 1 to 4, away from the bounds: a third of
    // what they differ by is that of the first.
    const auto first = static_cast<std::size_t>(2 * k * pairs);
    const double narrow = points[first + 1][k] - points[first][k];
    const double wide = points[first + 3][k] - points[first + 2][k];
    if (std::abs(wide - 2.0 * narrow) < 1e-3 * narrow)
      jacobian.col(k) += (jacobian.col(k) - slope(k, 1)) / 3.0;
  }
  return jacobian;
}

LeastSquaresResult least_squares(const LeastSquares& problem, const VectorXd& start,
                                 const LeastSquaresOptions& options) {
  LeastSquaresResult result{.best = inside(problem, start)};
  result.residuals = problem.residuals({result.best}).front();
  result.failed = result.residuals.size() == 0 || !result.residuals.allFinite();
  if (result.failed) return result;

  Residuals residuals(problem, options, result.best, result.residuals);
  std::vector<double> values(result.best.begin(), result.best.end());
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;  // `residuals` is a local
  ceres::Problem description(ownership);
  description.AddResidualBlock(&residuals, nullptr, values.data());
  set_bounds(problem, values, description);
  ceres::Solver::Options settings;
  settings.linear_solver_type = ceres::DENSE_QR;
  settings.logging_type = ceres::SILENT;
  settings.max_num_iterations = options.max_iterations;
  settings.function_tolerance = options.cost_tolerance;
  settings.parameter_tolerance = options.step_tolerance;
  settings.gradient_tolerance = 1e-15;
  settings.initial_trust_region_radius = options.trust_radius;
  // Each try of such a search costs derivatives.
  settings.max_num_line_search_step_size_iterations = options.search_steps ? 3 : 0;
  ceres::Solver::Summary summary;
  ceres::Solve(settings, &description, &summary);
  residuals.report(result);
  result.message = summary.message;
  return result;
}

}  // namespace havers::calib
