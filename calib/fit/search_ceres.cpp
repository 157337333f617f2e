// Levenberg-Marquardt over the active unknowns, through the trail, which scores every point and
// keeps the best.
#include <algorithm>

#include "calib/fit/differences.hpp"
#include "calib/fit/least_squares.hpp"
#include "calib/fit/search.hpp"

namespace havers::calib {
namespace {

// What the search may leave on the table, as a cost: less than a tenth of a standard deviation.
constexpr double left_on_the_table = 5e-3;

// Where noise hides the way down, more steps find nothing; weights are made anew between searches.
constexpr int max_steps = 6;

}  // namespace

SearchResult search_ceres(Trail& trail, const Evaluation& start, const Active& active) {
  SearchResult result{.best = start};
  result.log = {.optimiser = "Ceres Levenberg-Marquardt",
                .cost_before = start.cost,
                .cost_after = start.cost};
  if (start.failed || active.empty() || trail.stopped()) return result;
  const int points_before = trail.points();
  const double seconds_before = trail.wall_seconds();

  const auto count = static_cast<Eigen::Index>(active.size());
  LeastSquares problem{.residuals = {}, .lower = Point(count), .upper = Point(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index k = active[static_cast<std::size_t>(i)];
    problem.lower[i] = trail.problem().unknown(k).lower;
    problem.upper[i] = trail.problem().unknown(k).upper;
  }
  problem.residuals = [&](const std::vector<Point>& moved) {
    // Unknowns that are not active stay where the start has them.
    std::vector<Point> points(moved.size(), start.point);
    for (std::size_t p = 0; p < moved.size(); ++p) points[p](active) = moved[p];
    std::vector<Eigen::VectorXd> residuals;
    for (auto& evaluation : trail.evaluate(points)) {
      residuals.push_back(evaluation.failed ? Eigen::VectorXd() : evaluation.residuals);
      if (evaluation.cost < result.best.cost) result.best = std::move(evaluation);
    }
    return residuals;
  };
  // Ceres' tolerance is relative to the cost: here what may be left on the table over the cost of
  // the start.
  const auto end = least_squares(problem, start.point(active),
                                 {.step = slope_step,
                                  .max_iterations = max_steps,
                                  .cost_tolerance = std::min(left_on_the_table / start.cost, 0.1)});
  result.log.cost_after = result.best.cost;
  result.log.evaluations = trail.points() - points_before;
  result.log.wall_seconds = trail.wall_seconds() - seconds_before;
  result.log.message = end.message;
  return result;
}

}  // namespace havers::calib
