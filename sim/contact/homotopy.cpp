// Path following in λ (C4): branch by branch, each linear in λ, from where one joint's condition
// ends to where the next one's does.
#include "sim/contact/homotopy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "sim/contact/state_system.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::VectorXd;
using States = std::vector<JointState>;

constexpr double farthest = 1e4;  // λ; a path that has gone up so far is not seen to come back
// Of the answers on the way, and of the last one where it is not solved for anew.
constexpr double accuracy_on_the_way = 1e-11, accuracy_of_answer = 1e-13;

// The solution for given states: value at λ = 0 (column 0) and slope (column 1).
struct Branch {
  MatrixXd y, r, u, cohesion;
  double force_tolerance = 0.0;  // [N/m]
};

MatrixXd with_slope(const VectorXd& value, const VectorXd& slope) {
  MatrixXd both = MatrixXd::Zero(value.size(), 2);
  both.col(0) = value;
  if (slope.size() > 0) both.col(1) = slope;
  return both;
}

// The branch of the system's states. `known` is a solution for other states, from which few
// corrections are needed, or empty.
Branch solve_branch(StateSystem& system, StateSolution known, const Homotopy& added,
                    double nothing) {
  const LocalContact& p = system.problem();
  const MatrixXd r0 = with_slope(p.r0, added.reactions);
  MatrixXd u = with_slope(p.u0, added.gaps), cohesion = with_slope(cohesions(p), added.cohesion);
  if (known.y.size() == 0) known = {MatrixXd::Zero(r0.rows(), 2), r0};
  StateSolution solution =
      system.solve_from(std::move(known), r0, -u, cohesion, accuracy_on_the_way);
  u += solution.y;
  return {std::move(solution.y), std::move(solution.r), std::move(u), std::move(cohesion),
          nothing * std::max(p.force_scale, p.r0.lpNorm<Eigen::Infinity>())};
}

// Where the path is, and where λ goes from there: down (−1), or up (+1) where the path turns back.
struct Course {
  double lambda = 1.0;
  double direction = -1.0;
};

// A change of one joint's state.
struct Change {
  double at = -1.0;  // λ; negative: none
  std::size_t joint = 0;
  JointState to = JointState::open;
};

// What holds a joint back from changing its state to another, (value, slope), as a force ≥ 0: the
// conditions of the law (M5), (M7).
RowVector2d condition(const StateSystem& system, const Branch& branch, const Change& change) {
  const LocalContact& p = system.problem();
  const auto row = static_cast<Index>(2 * change.joint);
  const JointLaw& law = p.laws[change.joint];
  const JointState from = system.states()[change.joint];
  RowVector2d push = branch.r.row(row) + branch.cohesion.row(static_cast<Index>(change.joint));
  if (from == JointState::open) return p.stiffness(row) * branch.u.row(row);
  if (from == JointState::stick)
    return law.friction * push + slip_sign(change.to) * branch.r.row(row + 1);
  if (change.to == JointState::open) return push;
  return slip_sign(from) * p.stiffness(row + 1) * branch.u.row(row + 1);
}

// Where a condition stops to hold on the way; negative: nowhere. One that does not even hold where
// the path is stops to hold at once, if it does not come to hold further on.
double end_of(const RowVector2d& condition, double tolerance, const Course& course) {
  const double last = condition(0) + tolerance, slope = condition(1);
  if (course.direction < 0.0) {
    if (last >= 0.0) return -1.0;
    return slope > 0.0 ? std::clamp(-last / slope, 0.0, course.lambda) : course.lambda;
  }
  return slope < 0.0 ? std::max(course.lambda, -last / slope) : -1.0;
}

// Whether a change comes before another on the way; none comes before none.
bool comes_before(double at, double other, const Course& course) {
  return at >= 0.0 && (other < 0.0 || course.direction * at < course.direction * other);
}

// The next change of one joint on the way.
Change next_change(const StateSystem& system, const Branch& branch, std::size_t joint,
                   const Course& course) {
  Change first{.joint = joint};
  if (system.problem().is_apart(joint)) return first;
  const auto consider = [&](JointState to) {
    const double at = end_of(condition(system, branch, {.joint = joint, .to = to}),
                             branch.force_tolerance, course);
    if (comes_before(at, first.at, course)) first = {at, joint, to};
  };
  const auto slip = branch.u.row(static_cast<Index>(2 * joint) + 1);
  switch (system.states()[joint]) {
    case JointState::open:
      // It closes, and slides in the direction of the slip that it has there.
      consider(JointState::slip_forward);
      if (slip(0) + first.at * slip(1) < 0.0) first.to = JointState::slip_backward;
      break;
    case JointState::stick:
      consider(JointState::slip_backward);
      consider(JointState::slip_forward);
      break;
    case JointState::slip_forward:
    case JointState::slip_backward:
      consider(JointState::open);
      consider(JointState::stick);
      break;
  }
  return first;
}

// Where a joint changes its state, what holds it back from changing again is zero. Whether that
// falls from there on: then the path goes on in the other direction.
bool turns(const StateSystem& system, const Branch& branch, const Change& back,
           const Course& course) {
  return course.direction * condition(system, branch, back)(1) < -branch.force_tolerance;
}

}  // namespace

VectorXd answer_of_states(StateSystem& system, StateSolution known) {
  const LocalContact& p = system.problem();
  VectorXd anew = system.solve().y;
  const double residual = law_residual_of(p, anew);
  if (residual <= law_is_met) return anew;
  VectorXd near =
      system.solve_from(std::move(known), p.r0, -p.u0, cohesions(p), accuracy_of_answer).y;
  return std::isnan(residual) || law_residual_of(p, near) < residual ? near : anew;
}

VectorXd cohesion_to_stick(const VectorXd& reactions, const std::vector<JointLaw>& laws) {
  VectorXd extra(static_cast<Index>(laws.size()));
  for (Index i = 0; i < extra.size(); ++i) {
    const JointLaw& law = laws[static_cast<std::size_t>(i)];
    const double need =
        std::abs(reactions(2 * i + 1)) / law.friction - reactions(2 * i) - law.cohesion;
    extra(i) = std::max(0.0, 1.01 * need);
  }
  return extra;
}

std::optional<Homotopy> from_states(StateSystem& system) {
  // What breaks the law is mirrored: an overlap becomes as wide a gap, a pull as strong a push, and
  // a slip against the sign of its state one along it.
  const LocalContact& p = system.problem();
  const StateSolution now = system.solve();
  if (!now.y.allFinite()) return std::nullopt;
  Homotopy added{VectorXd::Zero(p.r0.size()), VectorXd::Zero(p.r0.size()), {}};
  for (std::size_t i = 0; i < p.laws.size(); ++i) {
    if (p.is_apart(i)) continue;
    const auto row = static_cast<Index>(2 * i);
    const JointState state = system.states()[i];
    if (state == JointState::open) {
      added.gaps(row) = 2.0 * std::max(0.0, -p.u0(row) - now.y(row, 0));
      continue;
    }
    const JointLaw& law = p.laws[i];
    const double push = now.r(row, 0) + law.cohesion, shear = now.r(row + 1, 0),
                 limit = law.friction * std::abs(push), sign = slip_sign(state);
    added.reactions(row) = 2.0 * std::max(0.0, -push);
    if (state != JointState::stick) {
      added.reactions(row + 1) = -sign * law.friction * added.reactions(row);
      added.gaps(row + 1) = 2.0 * sign * std::max(0.0, -sign * (p.u0(row + 1) + now.y(row + 1, 0)));
    } else if (std::abs(shear) > limit) {
      // Back to half of what the cone allows.
      added.reactions(row + 1) = 0.5 * std::copysign(limit, shear) - shear;
    }
  }
  return added;
}

Homotopy from_sticking(StateSystem& system, int way) {
  const LocalContact& p = system.problem();
  States start(p.laws.size(), JointState::stick);
  VectorXd e = VectorXd::Zero(static_cast<Index>(start.size()));
  for (std::size_t i = 0; i < start.size(); ++i)
    if (p.is_apart(i))
      start[i] = JointState::open;
    else
      // From 1 to 2: fractional parts of multiples of the golden ratio are spread evenly, no two of
      // them alike.
      e(static_cast<Index>(i)) =
          1.0 + std::fmod(std::numbers::phi * (static_cast<double>(i) + 7.0 * way * way), 1.0);
  system.set(std::move(start));
  const VectorXd reactions = system.solve().r;
  // So much that the neediest joint sticks.
  return {.cohesion = cohesion_to_stick(reactions, p.laws).cwiseProduct(e).maxCoeff() * e};
}

LocalContactResult follow_homotopy(StateSystem& system, const Homotopy& added, StateSolution known,
                                   int most_changes, double nothing) {
  LocalContactResult result;
  Course course;
  std::set<std::pair<States, double>> met;  // at this λ, and the direction
  std::optional<Change> back;               // of the last change
  const int most = most_changes * (1 + static_cast<int>(system.states().size()));
  while (result.iterations < most) {
    ++result.iterations;
    Branch branch = solve_branch(system, std::move(known), added, nothing);
    result.y = branch.y.col(0);
    if (!branch.y.allFinite()) break;
    if (back && turns(system, branch, *back, course)) course.direction = -course.direction;
    // The first change on the way, of all joints.
    Change next;
    for (std::size_t j = 0; j < system.states().size(); ++j) {
      const Change change = next_change(system, branch, j, course);
      if (comes_before(change.at, next.at, course)) next = change;
    }
    if (next.at > farthest) break;
    if (next.at < 0.0) {  // all the way down, or up without an end
      result.converged = course.direction < 0.0;
      result.y = answer_of_states(system, {branch.y.col(0), branch.r.col(0)});
      break;
    }
    if (next.at != course.lambda) met.clear();
    if (!met.insert({system.states(), course.direction}).second)
      break;  // the same states again without having moved
    course.lambda = next.at;
    back = {course.lambda, next.joint, system.states()[next.joint]};
    system.set(next.joint, next.to);
    known = {std::move(branch.y), std::move(branch.r)};
    if (stop_is_asked(system.problem().stop_asked)) break;
  }
  result.states = system.states();
  return result;
}

}  // namespace havers::sim
