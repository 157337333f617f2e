#include "calib/fit/walk.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace havers::calib {
namespace {

// Of a walk: over a factor of 20 a quarter from each to the next.
constexpr int stations = 13;

std::vector<Point> from_bound_to_bound(const Unknown& unknown, Eigen::Index index,
                                       const Point& from) {
  std::vector<Point> points(stations, from);
  for (int i = 0; i < stations; ++i)
    points[static_cast<std::size_t>(i)][index] =
        unknown.lower + unknown.range() * i / (stations - 1);
  return points;
}

// By the weights of each point itself: where simulations scatter more, the specimens tell less.
void score_each(const Trail& trail, std::vector<Evaluation>& points) {
  const Weights& here = trail.weights();
  for (Evaluation& one : points)
    if (!one.failed)
      score(trail.problem(), weigh(trail.problem(), one, here.scatter, here.specimen), one);
}

// Where the slopes of the answer take the active unknowns, weighed as the residuals are.
Point refitted(const Trail& trail, const Evaluation& one, const Active& active,
               const Eigen::MatrixXd& jacobian) {
  const FitProblem& problem = trail.problem();
  const Weights& here = trail.weights();
  const Weights own = weigh(problem, one, here.scatter, here.specimen);
  Eigen::MatrixXd slopes = jacobian;
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const Landmarks factor = here.sd[problem.fitted[f]] / own.sd[problem.fitted[f]];
    slopes.middleRows<landmark_count>(first_row(f)).array().colwise() *= factor;
  }
  Point point = one.point;
  point(active) -= slopes.colPivHouseholderQr().solve(one.residuals);
  return inside_bounds(problem.unknowns, point);
}

}  // namespace

std::vector<Evaluation> walk_along(Trail& trail, Eigen::Index unknown, const Active& active,
                                   const Eigen::MatrixXd& jacobian) {
  constexpr int refits = 2;
  const Evaluation best = trail.best();
  auto walked =
      trail.evaluate(from_bound_to_bound(trail.problem().unknown(unknown), unknown, best.point));
  score_each(trail, walked);
  for (int k = 0; k < refits; ++k) {
    std::vector<Point> points;
    points.reserve(walked.size());
    for (const Evaluation& one : walked)
      points.push_back(one.failed ? one.point : refitted(trail, one, active, jacobian));
    auto moved = trail.evaluate(points);
    score_each(trail, moved);
    for (std::size_t i = 0; i < walked.size(); ++i)
      if (moved[i].cost < walked[i].cost) walked[i] = std::move(moved[i]);
  }
  std::erase_if(walked, &Evaluation::failed);
  trail.restart(trail.weights(), best);
  return walked;
}

void widen_intervals(const Evaluation& best, const std::vector<Evaluation>& elsewhere,
                     const Active& active, Uncertainty& uncertainty) {
  double lowest = best.cost;
  for (const Evaluation& one : elsewhere) lowest = std::min(lowest, one.cost);
  for (std::size_t i = 0; i < active.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double error = uncertainty.standard_error[k];
    const double level = std::pow(uncertainty.half_width[k] / error, 2);
    const auto include = [&](const Evaluation& one) {
      const double left = level - 2.0 * (one.cost - lowest);
      if (left <= 0.0) return;
      const double shift = one.point[active[i]] - best.point[active[i]];
      uncertainty.lower[k] = std::min(uncertainty.lower[k], shift - error * std::sqrt(left));
      uncertainty.upper[k] = std::max(uncertainty.upper[k], shift + error * std::sqrt(left));
    };
    uncertainty.lower[k] = uncertainty.upper[k] = 0.0;
    include(best);
    for (const Evaluation& one : elsewhere) include(one);
  }
}

}  // namespace havers::calib
