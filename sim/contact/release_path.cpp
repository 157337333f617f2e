#include "sim/contact/release_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

// Part of the largest free reaction below which a force, or a gap times its stiffness, is nothing.
// Pieces that carry nothing must not change their minds about contacts without a force: where they
// do, the next larger part is taken.
constexpr std::array<double, 3> nothing{1e-10, 1e-8, 1e-6};

// The solution for given states: value at λ = 0 (column 0) and slope (column 1).
struct Branch {
  MatrixXd y, r, u;
  double force_tolerance = 0.0;  // [N/m]
};

// So many changes for every joint, and the path leads nowhere: those that arrive take fewer, but
// for a few, whose answer is found otherwise too.
constexpr int most_changes_of_a_joint = 5;

// Of the answers on the way, and of the last one where it is not solved for anew.
constexpr double accuracy_on_the_way = 1e-11, accuracy_of_answer = 1e-13;

Branch solve_branch(StateSystem& system, StateSolution known, const VectorXd& extra, double part) {
  const LocalContact& p = system.problem();
  const auto n = static_cast<Index>(p.laws.size());
  MatrixXd r0 = MatrixXd::Zero(2 * n, 2), u0 = MatrixXd::Zero(2 * n, 2), cohesion(n, 2);
  r0.col(0) = p.r0;
  u0.col(0) = p.u0;
  cohesion << cohesions(p), extra;
  if (known.y.size() == 0) known = {MatrixXd::Zero(2 * n, 2), r0};
  StateSolution solution =
      system.solve_from(std::move(known), r0, -u0, cohesion, accuracy_on_the_way);
  u0 += solution.y;
  return {std::move(solution.y), std::move(solution.r), std::move(u0),
          part * p.r0.lpNorm<Eigen::Infinity>()};
}

struct Change {
  double at = -1.0;  // λ; negative: none on the way to 0
  std::size_t joint = 0;
  JointState to = JointState::open;
};

// The next change of one joint on the way down from λ. Each state's conditions are those of the law
// (M5), (M7), written as forces ≥ 0.
Change next_change(const StateSystem& system, const Branch& branch, std::size_t joint, double extra,
                   double from) {
  const LocalContact& p = system.problem();
  const auto row = static_cast<Index>(2 * joint);
  const JointLaw& law = p.laws[joint];
  const RowVector2d push = branch.r.row(row) + RowVector2d(law.cohesion, extra);
  const RowVector2d shear = branch.r.row(row + 1);
  const RowVector2d opening = p.S(row, row) * branch.u.row(row);
  const RowVector2d slip = p.S(row + 1, row + 1) * branch.u.row(row + 1);
  Change first{.joint = joint};
  if (p.is_apart(joint)) return first;
  const auto consider = [&](const RowVector2d& condition, JointState to) {
    const double last = condition(0) + branch.force_tolerance;
    if (last >= 0.0) return;
    // One that does not even hold where the path is has to change at once.
    const double at = condition(1) > 0.0 ? std::clamp(-last / condition(1), 0.0, from) : from;
    if (at > first.at) first = {at, joint, to};
  };
  const bool forward = slip(0) + from * slip(1) >= 0.0;
  switch (system.states()[joint]) {
    case JointState::open:
      consider(opening, forward ? JointState::slip_forward : JointState::slip_backward);
      break;
    case JointState::stick:
      consider(law.friction * push - shear, JointState::slip_backward);
      consider(law.friction * push + shear, JointState::slip_forward);
      break;
    case JointState::slip_forward:
      consider(push, JointState::open);
      consider(slip, JointState::stick);
      break;
    case JointState::slip_backward:
      consider(push, JointState::open);
      consider(-slip, JointState::stick);
      break;
  }
  return first;
}

}  // namespace

VectorXd answer_of_states(StateSystem& system, StateSolution known) {
  const LocalContact& p = system.problem();
  const VectorXd c = cohesions(p);
  VectorXd anew = system.solve(p.r0, -p.u0, c).y;
  const double residual = law_residual_of(p, anew);
  if (residual <= law_is_met) return anew;
  VectorXd near = system.solve_from(std::move(known), p.r0, -p.u0, c, accuracy_of_answer).y;
  return law_residual_of(p, near) < residual ? near : anew;
}

VectorXd cohesions(const LocalContact& p) {
  VectorXd c(static_cast<Index>(p.laws.size()));
  for (Index i = 0; i < c.size(); ++i) c(i) = p.laws[static_cast<std::size_t>(i)].cohesion;
  return c;
}

VectorXd cohesion_to_stick(const VectorXd& reactions, const std::vector<JointLaw>& laws) {
  VectorXd extra(static_cast<Index>(laws.size()));
  for (Index i = 0; i < extra.size(); ++i) {
    const JointLaw& law = laws[static_cast<std::size_t>(i)];
    const double need = std::abs(reactions(2 * i + 1)) / std::max(law.friction, least_friction) -
                        reactions(2 * i) - law.cohesion;
    extra(i) = std::max(0.0, 1.01 * need);
  }
  return extra;
}

namespace {

LocalContactResult follow(StateSystem& system, StateSolution known, const VectorXd& extra,
                          double part) {
  LocalContactResult result;
  double lambda = 1.0;
  std::set<States> met;  // at this λ
  const int most = most_changes_of_a_joint * (1 + static_cast<int>(system.states().size()));
  while (result.iterations < most) {
    ++result.iterations;
    Branch branch = solve_branch(system, std::move(known), extra, part);
    result.y = branch.y.col(0);
    if (!branch.y.allFinite()) break;
    Change next;
    for (std::size_t j = 0; j < system.states().size(); ++j) {
      const Change change = next_change(system, branch, j, extra(static_cast<Index>(j)), lambda);
      if (change.at > next.at) next = change;
    }
    result.converged = next.at < 0.0;
    if (result.converged) {
      result.y = answer_of_states(system, {branch.y.col(0), branch.r.col(0)});
      break;
    }
    if (next.at < lambda) met.clear();
    if (!met.insert(system.states()).second)
      break;  // the same states again without having moved: the path turns back
    lambda = next.at;
    system.set(next.joint, next.to);
    known = {std::move(branch.y), std::move(branch.r)};
  }
  result.states = system.states();
  return result;
}

}  // namespace

LocalContactResult follow_release(StateSystem& system, const VectorXd& extra,
                                  const StateSolution& known) {
  const States start = system.states();
  LocalContactResult result;
  int spent = 0;
  for (const double part : nothing) {
    system.set(start);
    result = follow(system, known, extra, part);
    spent += result.iterations;
    if (result.converged) break;
  }
  result.iterations = spent;
  return result;
}

}  // namespace havers::sim
