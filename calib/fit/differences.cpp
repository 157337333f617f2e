// (F8) Central differences of all active unknowns in one batch. Replicates of two points have the
// same seeds, so that most of their chance cancels; how much is left shows in the scatter of their
// differences.
#include "calib/fit/differences.hpp"

#include <cassert>

namespace havers::calib {
namespace {

// Variance of the mean difference between paired replicates: common random numbers leave only what
// does not cancel.
Landmarks variance_of_difference(const Prediction& a, const Prediction& b) {
  assert(a.replicates.size() == b.replicates.size());
  Landmarks sum = Landmarks::Zero(), squares = Landmarks::Zero();
  int n = 0;
  for (std::size_t i = 0; i < a.replicates.size(); ++i) {
    const Landmarks change = a.replicates[i] - b.replicates[i];
    if (!change.isFinite().all()) continue;
    sum += change;
    squares += change.square();
    ++n;
  }
  if (n < 2) return Landmarks::Zero();
  constexpr double but_for_rounding = 1.0 - 1e-12;  // of changes that are all the same
  return (but_for_rounding * squares - sum.square() / n).max(0.0) / (n * (n - 1.0));
}

// A parameter moved down and up.
struct Move {
  const Evaluation& low;
  const Evaluation& high;
};

void set_column(const FitProblem& problem, const Weights& weights, const Move& move,
                Eigen::Index column, Differences& result) {
  const auto& [low, high] = move;
  const double span = (high.point - low.point).norm();
  result.jacobian.col(column) = (high.residuals - low.residuals) / span;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const Landmarks& sd = weights.sd[problem.fitted[f]];
    const auto &one = low.predictions[f], &other = high.predictions[f];
    const Target& target = problem.targets[problem.fitted[f]];
    // Where a bound is nearer at one of them, noise counts as it does there.
    const Landmarks squared =
        (slopes_of_residuals(one, target, sd).max(slopes_of_residuals(other, target, sd)) /
         (span * sd))
            .square();
    const Landmarks paired = variance_of_difference(other, one) * squared;
    // If both points had seeds of their own, the variances of the two means would add.
    const Landmarks independent =
        (one.sd.square() / one.usable + other.sd.square() / other.usable) * squared;
    result.variance.col(column).segment<landmark_count>(first_row(f)) = paired;
    // Moves that need no new simulation cancel to rounding, and say nothing of the gain.
    if (paired.sum() <= 1e-9 * independent.sum()) continue;
    result.paired += paired.sum();
    result.independent += independent.sum();
  }
}

}  // namespace

std::vector<Point> moved_points(const std::vector<Unknown>& unknowns, const Point& at,
                                const Active& active, double step) {
  std::vector<Point> points;
  for (const Eigen::Index k : active)
    for (const double side : {-step, step}) {
      Point moved = at;
      moved[k] += side;
      points.push_back(inside_bounds(unknowns, moved));
    }
  return points;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a copy, as the header says
Differences differentiate(Trail& trail, Evaluation at, const Active& active, double step) {
  const auto& problem = trail.problem();
  const auto evaluations = trail.evaluate(moved_points(problem.unknowns, at.point, active, step));

  Differences result;
  const auto columns = static_cast<Eigen::Index>(active.size());
  result.jacobian = Eigen::MatrixXd::Zero(at.residuals.size(), columns);
  result.variance = result.jacobian;
  for (std::size_t i = 0; i < active.size(); ++i) {
    // One-sided beside a point that failed; where both did, or where bounds leave no room, there
    // are no slopes at all.
    const auto& low = evaluations[2 * i].failed ? at : evaluations[2 * i];
    const auto& high = evaluations[2 * i + 1].failed ? at : evaluations[2 * i + 1];
    if (low.failed || high.failed || low.point == high.point) return result;
    set_column(problem, trail.weights(), {low, high}, static_cast<Eigen::Index>(i), result);
  }
  result.failed = false;
  return result;
}

}  // namespace havers::calib
