// (F15) The cost at multiples of the half width (F11) on either side of the answer, the other
// unknowns moved by the slopes of the answer instead of a fit of their own. The interval ends by
// the signed root of the rise, which is a straight line where the cost is a parabola.
#include "calib/fit/profile.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace havers::calib {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Of Wald's half width; a tenth more, so that what is nearly a parabola meets its level.
constexpr std::array<double, 4> parts{-1.1, -0.5, 0.5, 1.1};
constexpr std::array<double, 2> further{1.5, 2.0};  // one after the other, where that is not enough
// Others that would move less than this part of their half width stay, which saves simulations.
constexpr double worth_moving = 0.03;

/// One point of a profile: active unknown `fixed` is held, the others follow.
struct Held {
  Index fixed = 0;
  Point point;
};

// Adds `shift` of the columns `others` to a point, where it is worth its simulations.
void add_worth(const Answer& answer, const std::vector<Index>& others, const VectorXd& shift,
               Point& point) {
  for (std::size_t i = 0; i < others.size(); ++i) {
    const auto at = static_cast<Index>(i);
    if (std::abs(shift[at]) > worth_moving * answer.uncertainty.half_width[others[i]])
      point[answer.active[static_cast<std::size_t>(others[i])]] += shift[at];
  }
}

std::vector<Index> without(Index count, Index k) {
  std::vector<Index> others;
  for (Index j = 0; j < count; ++j)
    if (j != k) others.push_back(j);
  return others;
}

// Least squares over the others with the slopes of the answer.
VectorXd follow(const Eigen::MatrixXd& jacobian, const std::vector<Index>& others,
                const VectorXd& residuals) {
  if (others.empty()) return {};
  return -jacobian(Eigen::all, others).colPivHouseholderQr().solve(residuals);
}

// Unknown k at a part of its half width from the answer, the others where the slopes send them.
Held held_at(const FitProblem& problem, const Answer& answer, Index k, double part) {
  const auto& jacobian = answer.slopes.jacobian;
  const double shift = part * answer.uncertainty.half_width[k];
  const auto others = without(jacobian.cols(), k);
  Point point = answer.best.point;
  add_worth(answer, others, follow(jacobian, others, jacobian.col(k) * shift), point);
  point[answer.active[static_cast<std::size_t>(k)]] += shift;
  return {k, inside_bounds(problem.unknowns, point)};
}

std::vector<Evaluation> evaluate(Trail& trail, const std::vector<Held>& held) {
  std::vector<Point> points;
  points.reserve(held.size());
  for (const Held& one : held) points.push_back(one.point);
  return trail.evaluate(points);
}

// One more step of the others, with the residuals found.
std::vector<Held> corrected(const FitProblem& problem, const Answer& answer, std::vector<Held> held,
                            const std::vector<Evaluation>& found) {
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (found[i].failed) continue;
    const auto others = without(answer.slopes.jacobian.cols(), held[i].fixed);
    add_worth(answer, others, follow(answer.slopes.jacobian, others, found[i].residuals),
              held[i].point);
    held[i].point = inside_bounds(problem.unknowns, held[i].point);
  }
  return held;
}

double signed_root(double side, double rise) {
  return std::copysign(std::sqrt(2.0 * std::max(rise, 0.0)), side);
}

/// Position and signed root of the rise, in order of position.
using Root = std::pair<double, double>;

double quantile_of(const Answer& answer, Index k) {
  return answer.uncertainty.half_width[k] / answer.uncertainty.standard_error[k];
}

// Simulates what is held, twice, and adds what it finds to the roots of its unknown.
void add_roots(Trail& trail, const Answer& answer, const std::vector<Held>& held,
               std::vector<std::vector<Root>>& roots) {
  const auto first = evaluate(trail, held);
  const auto second = evaluate(trail, corrected(trail.problem(), answer, held, first));
  for (std::size_t i = 0; i < held.size(); ++i) {
    const auto k = static_cast<std::size_t>(held[i].fixed);
    const double at = held[i].point[answer.active[k]], centre = answer.best.point[answer.active[k]];
    const double cost = std::min(first[i].cost, second[i].cost);
    // At a bound the value that is held may be that of the answer itself.
    if (std::isfinite(cost) && at != centre)
      roots[k].emplace_back(at, signed_root(at - centre, cost - answer.best.cost));
  }
  for (auto& of_one : roots) std::ranges::sort(of_one);
}

// From the answer outwards.
std::vector<Root> side_of(const std::vector<Root>& roots, bool upper) {
  std::vector<Root> side;
  for (const Root& root : roots)
    if (upper ? root.second >= 0.0 : root.second <= 0.0) side.push_back(root);
  if (!upper) std::ranges::reverse(side);
  return side;
}

// Where the signed root reaches ±quantile, NaN where it does not.
double crossing(const std::vector<Root>& roots, double quantile, bool upper) {
  const auto side = side_of(roots, upper);
  for (std::size_t i = 1; i < side.size(); ++i) {
    const auto [from, low] = side[i - 1];
    const auto [to, high] = side[i];
    if (std::abs(high) < quantile) continue;
    // Between two points the root is taken to be straight.
    return from + (to - from) * (quantile - std::abs(low)) / (std::abs(high) - std::abs(low));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Further out on the sides where the cost has not risen to the level, but for those that end at a
// bound.
std::vector<Held> held_further(const FitProblem& problem, const Answer& answer,
                               const std::vector<std::vector<Root>>& roots, double part) {
  std::vector<Held> held;
  for (std::size_t k = 0; k < roots.size(); ++k)
    for (const bool upper : {false, true}) {
      const auto i = static_cast<Index>(k);
      const auto& unknown = problem.unknown(answer.active[k]);
      const double last = side_of(roots[k], upper).back().first;
      const bool bound = upper ? last >= unknown.upper : last <= unknown.lower;
      if (bound || std::isfinite(crossing(roots[k], quantile_of(answer, i), upper))) continue;
      held.push_back(held_at(problem, answer, i, upper ? part : -part));
    }
  return held;
}

std::vector<std::vector<Root>> trace(Trail& trail, const Answer& answer) {
  std::vector<std::vector<Root>> roots;
  for (const Index unknown : answer.active) roots.push_back({{answer.best.point[unknown], 0.0}});
  std::vector<Held> held;
  for (std::size_t k = 0; k < roots.size(); ++k)
    for (const double part : parts)
      held.push_back(held_at(trail.problem(), answer, static_cast<Index>(k), part));
  add_roots(trail, answer, held, roots);
  for (const double part : further) {
    held = held_further(trail.problem(), answer, roots, part);
    if (!held.empty()) add_roots(trail, answer, held, roots);
  }
  return roots;
}

Profile profile_of(const Unknown& unknown, const Answer& answer, Index k,
                   const std::vector<Root>& roots) {
  Profile profile{.parameter = unknown.label};
  for (const auto& [at, root] : roots) {
    profile.value.push_back(value_in_unit(unknown, at));
    profile.rise.push_back(0.5 * root * root);
  }
  const double quantile = quantile_of(answer, k);
  profile.level = 0.5 * quantile * quantile;
  const double centre = answer.best.point[answer.active[static_cast<std::size_t>(k)]];
  const auto end = [&](bool upper) {
    // Where the cost does not show an end this is NaN, and stays so below.
    double at = crossing(roots, quantile, upper);
    // No narrower than what is left out allows (F22), which the cost beside one of its values does
    // not show.
    if (!answer.elsewhere.empty())
      at = upper ? std::max(at, centre + answer.uncertainty.upper[k])
                 : std::min(at, centre + answer.uncertainty.lower[k]);
    return value_in_unit(unknown, std::clamp(at, unknown.lower, unknown.upper));
  };
  profile.interval_95 = {end(false), end(true)};
  return profile;
}

}  // namespace

std::vector<Profile> profiles_of(Trail& trail, const Answer& answer) {
  const auto& problem = trail.problem();
  const auto roots = trace(trail, answer);
  std::vector<Profile> profiles;
  for (std::size_t k = 0; k < roots.size(); ++k)
    profiles.push_back(
        profile_of(problem.unknown(answer.active[k]), answer, static_cast<Index>(k), roots[k]));
  return profiles;
}

}  // namespace havers::calib
