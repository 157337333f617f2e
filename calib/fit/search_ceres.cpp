#include <ceres/ceres.h>

#include <algorithm>

#include "calib/fit/differences.hpp"
#include "calib/fit/search.hpp"

namespace havers::calib {
namespace {

// Ceres' own numeric derivatives leave the bounds and run one point at a time; these do neither.
class Residuals final : public ceres::CostFunction {
 public:
  Residuals(Trail& trail, const Evaluation& start, const Active& active)
      : trail_(trail), active_(active), best_(start), at_(start) {
    set_num_residuals(static_cast<int>(start.residuals.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(active.size()));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    move_to(parameters[0]);
    if (at_.failed) return false;
    std::ranges::copy(at_.residuals, residuals);
    if (!jacobians || !jacobians[0]) return true;
    auto slopes = differentiate(trail_, at_, active_, slope_step);
    if (slopes.failed) slopes.jacobian.setZero();
    // Where neighbours fail there is no slope: a zero one ends the search here, and the best point
    // stays.
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        jacobians[0], slopes.jacobian.rows(), slopes.jacobian.cols()) = slopes.jacobian;
    return true;
  }

  [[nodiscard]] const Evaluation& best() const { return best_; }

 private:
  void move_to(const double* values) const {
    Point point = at_.point;
    for (std::size_t i = 0; i < active_.size(); ++i) point[active_[i]] = values[i];
    if (!at_.failed && point == at_.point) return;
    auto next = trail_.evaluate(point);
    next.point = point;
    if (next.cost < best_.cost) best_ = next;
    at_ = std::move(next);
  }

  Trail& trail_;
  const Active& active_;
  mutable Evaluation best_, at_;
};

}  // namespace

SearchResult search_ceres(Trail& trail, const Evaluation& start, const Active& active) {
  SearchResult result{.best = start};
  result.log = {.optimiser = "Ceres Levenberg-Marquardt", .cost_before = start.cost};
  const int points_before = trail.points();
  if (start.failed || active.empty() || trail.stopped()) return result;

  std::vector<double> values;
  for (const Eigen::Index k : active) values.push_back(start.point[k]);
  Residuals residuals(trail, start, active);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&residuals, nullptr, values.data());
  for (std::size_t i = 0; i < active.size(); ++i) {
    const auto& unknown = trail.problem().unknowns[static_cast<std::size_t>(active[i])];
    problem.SetParameterLowerBound(values.data(), static_cast<int>(i), unknown.lower);
    problem.SetParameterUpperBound(values.data(), static_cast<int>(i), unknown.upper);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 30;
  options.function_tolerance = 1e-4;
  options.parameter_tolerance = 1e-4;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  result.best = residuals.best();
  result.log.cost_after = result.best.cost;
  result.log.evaluations = trail.points() - points_before;
  result.log.message = summary.message;
  return result;
}

}  // namespace havers::calib
