#include "calib/fit/profile.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace havers::calib {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::array<double, 4> parts{-1.0, -0.5, 0.5, 1.0};  // of Wald's half width
// Others that would move less than this part of their half width stay, which saves simulations.
constexpr double worth_moving = 0.03;

/// One point of a profile: active unknown `fixed` is held, the others follow.
struct Held {
  Index fixed = 0;
  Point point;
};

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

std::vector<Held> held_points(const FitProblem& problem, const Answer& answer) {
  const auto& jacobian = answer.slopes.jacobian;
  std::vector<Held> held;
  for (Index k = 0; k < jacobian.cols(); ++k)
    for (const double part : parts) {
      const double shift = part * answer.uncertainty.half_width[k];
      const auto others = without(jacobian.cols(), k);
      Point point = answer.best.point;
      add_worth(answer, others, follow(jacobian, others, jacobian.col(k) * shift), point);
      point[answer.active[static_cast<std::size_t>(k)]] += shift;
      held.push_back({k, inside_bounds(problem.unknowns, point)});
    }
  return held;
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

// Where the signed root reaches ±quantile, from the answer outwards; the last stretch is prolonged.
double crossing(const std::vector<Root>& roots, double quantile, bool upper) {
  std::vector<Root> side;
  for (const Root& root : roots)
    if (upper ? root.second >= 0.0 : root.second <= 0.0) side.push_back(root);
  if (!upper) std::ranges::reverse(side);
  for (std::size_t i = 1; i < side.size(); ++i) {
    const auto [from, low] = side[i - 1];
    const auto [to, high] = side[i];
    const bool last = i + 1 == side.size();
    if (std::abs(high) < quantile && !last) continue;
    if (std::abs(high) <= std::abs(low)) return std::numeric_limits<double>::quiet_NaN();
    return from + (to - from) * (quantile - std::abs(low)) / (std::abs(high) - std::abs(low));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<Profile> profiles_of(Trail& trail, const Answer& answer) {
  const auto& problem = trail.problem();
  const auto held = held_points(problem, answer);
  const auto first = evaluate(trail, held);
  const auto better = corrected(problem, answer, held, first);
  const auto second = evaluate(trail, better);

  std::vector<Profile> profiles;
  for (std::size_t k = 0; k < answer.active.size(); ++k) {
    const auto& unknown = problem.unknowns[static_cast<std::size_t>(answer.active[k])];
    const double centre = answer.best.point[answer.active[k]];
    std::vector<Root> roots{{centre, 0.0}};
    for (std::size_t i = k * parts.size(); i < (k + 1) * parts.size(); ++i) {
      const double cost = std::min(first[i].cost, second[i].cost);
      const double at = held[i].point[answer.active[k]];
      if (std::isfinite(cost) && at != centre)
        roots.emplace_back(at, signed_root(at - centre, cost - answer.best.cost));
    }
    std::ranges::sort(roots);
    Profile profile{.parameter = unknown.label};
    for (const auto& [at, root] : roots) {
      profile.value.push_back(value_in_unit(unknown, at));
      profile.rise.push_back(0.5 * root * root);
    }
    const auto i = static_cast<Index>(k);
    const double quantile = answer.uncertainty.half_width[i] / answer.uncertainty.standard_error[i];
    profile.level = 0.5 * quantile * quantile;
    const auto end = [&](bool upper) {
      double at = crossing(roots, quantile, upper);
      if (!answer.elsewhere.empty())
        at = upper ? std::max(at, centre + answer.uncertainty.upper[i])
                   : std::min(at, centre + answer.uncertainty.lower[i]);
      return value_in_unit(unknown, std::clamp(at, unknown.lower, unknown.upper));
    };
    profile.interval_95 = {end(false), end(true)};
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace havers::calib
