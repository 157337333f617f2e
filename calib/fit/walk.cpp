// (F22) What was left out may have any value that the specimens allow: the others are refitted at
// some of these values, and their intervals contain where they come to.
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

// (F6) With the replicates' spread at that point; τ and the errors by porosity are the trail's.
Weights own_weights(const Trail& trail, const Evaluation& one) {
  return weigh(trail.problem(), one, trail.weights().scatter, trail.weights().specimen);
}

// ½ log |JᵀJ|, by R of QR.
double log_determinant(const Eigen::MatrixXd& slopes) {
  return slopes.colPivHouseholderQr().matrixQR().diagonal().array().abs().log().sum();
}

// −log of the restricted likelihood of each point by its own weights, beside that of the trail's:
// where simulations scatter more the tests tell less, and are less likely to be alike (F22).
void score_each(const Trail& trail, const Eigen::MatrixXd& jacobian,
                std::vector<Evaluation>& points) {
  const FitProblem& problem = trail.problem();
  const double here = log_determinant(jacobian);
  for (Evaluation& one : points) {
    if (one.failed) continue;
    const Weights own = own_weights(trail, one);
    score(problem, own, one);
    one.cost += log_determinant(weighed(problem, trail.weights(), own, jacobian)) - here;
    for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
      const std::size_t s = problem.fitted[f];
      const auto told = tells(one.predictions[f], problem.targets[s]);
      one.cost += told.select((own.sd[s] / trail.weights().sd[s]).log(), 0.0).sum();
    }
  }
}

// Where the slopes of the answer take the active unknowns, weighed as the residuals are.
Point refitted(const Trail& trail, const Evaluation& one, const Active& active,
               const Eigen::MatrixXd& jacobian) {
  const Eigen::MatrixXd slopes =
      weighed(trail.problem(), trail.weights(), own_weights(trail, one), jacobian);
  Point point = one.point;
  point(active) -= slopes.colPivHouseholderQr().solve(one.residuals);
  return inside_bounds(trail.problem().unknowns, point);
}

}  // namespace

std::vector<Evaluation> walk_along(Trail& trail, Eigen::Index unknown, const Active& active,
                                   const Eigen::MatrixXd& jacobian) {
  constexpr int refits = 2;
  const Evaluation best = trail.best();
  auto walked =
      trail.evaluate(from_bound_to_bound(trail.problem().unknown(unknown), unknown, best.point));
  score_each(trail, jacobian, walked);
  for (int k = 0; k < refits; ++k) {
    std::vector<Point> points;
    points.reserve(walked.size());
    for (const Evaluation& one : walked)
      points.push_back(one.failed ? one.point : refitted(trail, one, active, jacobian));
    auto moved = trail.evaluate(points);
    score_each(trail, jacobian, moved);
    for (std::size_t i = 0; i < walked.size(); ++i)
      // Far from the answer its slopes may lead astray: then the point stays as it was.
      if (moved[i].cost < walked[i].cost) walked[i] = std::move(moved[i]);
  }
  std::erase_if(walked, &Evaluation::failed);
  // However low its cost, no point of a walk is an answer.
  trail.restart(trail.weights(), best);
  return walked;
}

void widen_intervals(const Evaluation& best, const std::vector<Evaluation>& elsewhere,
                     const Active& active, Uncertainty& uncertainty) {
  // The likeliest value may be elsewhere than the answer has it.
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
    // The answer is one of the points: where another one is likelier, what the answer allows is
    // narrower too.
    uncertainty.lower[k] = uncertainty.upper[k] = 0.0;
    include(best);
    for (const Evaluation& one : elsewhere) include(one);
  }
}

}  // namespace havers::calib
