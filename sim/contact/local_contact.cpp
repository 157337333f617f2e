// Tries what is quick first: a few sets (C2), a short path from the last states, ever longer ones
// from all joints sticking (C4), and all of these once more with springs (C7).
#include "sim/contact/local_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "sim/contact/homotopy.hpp"
#include "sim/contact/state_system.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using States = std::vector<JointState>;

constexpr double rounding = 1e-12;
// Residual of the law below which an answer is one, and above which it is none though its states
// agree with it: nothing holds a piece. In between a better one is looked for.
constexpr double well_met = 1e-9, nearly_met = 1e-8;
constexpr int sets_at_once = 3;  // that follow from each other, before paths are followed
// From all joints sticking, each with twice the changes for a joint that the one before may take.
constexpr int ways = 7, changes_of_first_way = 10;
// Of all paths of a problem together, with springs and without: of those that were seen to be
// solved, all but a few took less than a tenth.
constexpr int changes_in_all = 30'000;
// Of springs that hold joints, parts of the largest stiffness; each is tried with so many answers.
constexpr std::array<double, 5> springs{1e-11, 1e-10, 1e-9, 1e-8, 1e-7};
constexpr int times_moved = 8;

// The states that the law gives joints with the gaps y; gaps are compared as forces.
States states_of(const LocalContact& p, const VectorXd& y, const States& now) {
  const VectorXd r = p.r0 + p.S * y, u = p.u0 + y;
  const double scale =
      std::max({p.force_scale, r.cwiseAbs().maxCoeff(), p.r0.cwiseAbs().maxCoeff()});
  States states(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    const double stiffness = p.stiffness(row);
    states[i] = p.is_apart(i) ? JointState::open
                              : state_of(r.segment<2>(row), stiffness * u.segment<2>(row), now[i],
                                         p.laws[i], scale);
  }
  return states;
}

}  // namespace

double law_missed(const LocalContact& p, const VectorXd& r, const VectorXd& gaps) {
  double squared = 0.0;
  for (std::size_t i = 0; i < p.laws.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    if (p.is_apart(i)) continue;
    squared += law_residual(r.segment<2>(row), gaps.segment<2>(row), p.laws[i], p.stiffness(row))
                   .squaredNorm();
  }
  return std::sqrt(squared);
}

double law_residual_of(const LocalContact& p, const VectorXd& y) {
  const double missed = law_missed(p, p.r0 + p.S * y, p.u0 + y);
  return missed == 0.0 ? 0.0 : missed / std::max(p.force_scale, p.r0.norm());
}

JointState state_of(const Local& reaction, const Local& gap, JointState now, const JointLaw& law,
                    double scale) {
  // A state is left only where its own condition fails by more than rounding.
  const double tolerance = rounding * scale;
  if (now == JointState::open) return gap.x() < -tolerance ? JointState::stick : JointState::open;
  if (reaction.x() + law.cohesion < -tolerance) return JointState::open;
  if (now == JointState::stick) {
    if (cone_margin(reaction, law) >= -tolerance) return now;
    return reaction.y() < 0.0 ? JointState::slip_forward : JointState::slip_backward;
  }
  return slip_sign(now) * gap.y() < -tolerance ? JointState::stick : now;
}

namespace {

// A few sets, each made of the answer to the one before.
LocalContactResult try_sets(const LocalContact& p, States states) {
  LocalContactResult result{.states = std::move(states)};
  std::set<States> tried;
  while (result.iterations < sets_at_once && tried.insert(result.states).second) {
    ++result.iterations;
    result.y = StateSystem(p, result.states).solve().y;
    if (!result.y.allFinite()) break;
    States wanted = states_of(p, result.y, result.states);
    result.converged = wanted == result.states;
    if (result.converged) break;
    result.states = std::move(wanted);
  }
  return result;
}

// Sets from the last one on; where these lead nowhere, paths, so many of them from all joints
// sticking, while no more changes are spent than are left.
LocalContactResult solve_as_it_is(const LocalContact& problem, const States& states, int most_ways,
                                  int left) {
  LocalContactResult result = try_sets(problem, states);
  if (result.converged) return result;
  int spent = result.iterations;
  StateSystem system(problem, states);
  const auto goes_on = [&] {
    return !result.converged && spent < left && !stop_is_asked(problem.stop_asked);
  };
  const auto follow = [&](const Homotopy& path, int changes) {
    const int left_for_each = 1 + (left - spent) / static_cast<int>(states.size());
    result = follow_homotopy(system, path, {}, std::min(changes, left_for_each));
    spent += result.iterations;
  };
  // First the path from the last states, which is short where these are nearly those of the answer.
  if (const std::optional<Homotopy> near = from_states(system)) follow(*near, 1);
  for (int way = 0; way < most_ways && goes_on(); ++way)
    follow(from_sticking(system, way), changes_of_first_way << way);
  result.iterations = spent;
  return result;
}

// (C7). Joints held by springs where the last answer has left them, until these bear nothing, or
// no less than what rounding leaves on a piece that hangs on nothing: the best of all answers.
LocalContactResult solve_with_springs(const LocalContact& problem, const States& states,
                                      LocalContactResult best, int most_ways) {
  const States nearest = best.converged ? best.states : states;
  double least = best.converged ? law_residual_of(problem, best.y) : nearly_met;
  best.converged = best.converged && least <= nearly_met;
  least = std::min(nearly_met, least);  // of what is no number too
  int spent = best.iterations;
  for (const double part : springs) {
    const double stiffness = part * problem.S.diagonal().maxCoeff();
    LocalContact held = problem;
    held.S.diagonal().array() += stiffness;
    // Every stiffness starts from the same states, whatever softer springs led to.
    LocalContactResult result{.states = nearest};
    for (int i = 0; i < times_moved && least > well_met && spent < changes_in_all &&
                    !stop_is_asked(problem.stop_asked);
         ++i) {
      result = solve_as_it_is(held, result.states, most_ways, changes_in_all - spent);
      spent += result.iterations;
      if (!result.converged) break;
      const double residual = law_residual_of(problem, result.y);
      // The springs have no force at this answer: the next one loads them by what it moves beyond
      // it.
      held.r0 = problem.r0 - stiffness * result.y;
      if (!(residual <= least)) continue;
      least = residual;
      best = result;
    }
  }
  best.iterations = spent;
  return best;
}

}  // namespace

LocalContactResult solve_local_contact(const LocalContact& problem, const States& states,
                                       Effort effort) {
  if (states.empty()) return {.converged = true, .y = {}, .states = {}, .iterations = 0};
  const int most_ways = effort == Effort::little ? 1 : ways;
  LocalContactResult result = solve_as_it_is(problem, states, most_ways, changes_in_all);
  const bool solved = result.converged && law_residual_of(problem, result.y) <= well_met;
  if (solved || (effort == Effort::little && !result.converged)) return result;
  return solve_with_springs(problem, states, std::move(result), most_ways);
}

}  // namespace havers::sim
