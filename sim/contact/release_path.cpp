#include "sim/contact/release_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/contact/state_system.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using States = std::vector<JointState>;

// y and r as value at λ = 0 (column 0) and slope (column 1).
struct Branch {
  MatrixXd y, r, u;
};

Branch solve_branch(const LocalContact& p, const States& states, const VectorXd& extra) {
  const auto n = static_cast<Index>(p.laws.size());
  VectorXd cohesion(n);
  for (Index i = 0; i < n; ++i) cohesion(i) = p.laws[static_cast<std::size_t>(i)].cohesion;
  const StateSystem system(p, states);
  Branch branch{MatrixXd(2 * n, 2), MatrixXd(2 * n, 2), MatrixXd(2 * n, 2)};
  branch.y.col(0) = system.solve(p.r0, -p.u0, cohesion);
  branch.y.col(1) = system.solve(VectorXd::Zero(2 * n), VectorXd::Zero(2 * n), extra);
  branch.r = p.S * branch.y;
  branch.r.col(0) += p.r0;
  branch.u = branch.y;
  branch.u.col(0) += p.u0;
  return branch;
}

// Where a condition a + λ b ≥ 0 stops to hold on the way down from λ.
double crossing(double a, double b, double from) {
  if (!(b > 0.0) || a >= 0.0) return -1.0;
  return std::min(from, -a / b);
}

struct Change {
  double at = -1.0;  // λ; negative: none on the way to 0
  std::size_t joint = 0;
  JointState to = JointState::open;
};

// The next change of one joint. Each state's conditions are those of the law (M5), (M7).
Change next_change(const Branch& branch, std::size_t joint, JointState state, const JointLaw& law, double extra,
                   double from) {
  const auto row = static_cast<Index>(2 * joint);
  const auto u = [&](Index c) { return branch.u.row(row + c); };
  const Eigen::RowVector2d n = branch.r.row(row) + Eigen::RowVector2d(law.cohesion, extra);
  const Eigen::RowVector2d t = branch.r.row(row + 1);
  Change first{.joint = joint};
  const auto consider = [&](const Eigen::RowVector2d& condition, JointState to) {
    const double at = crossing(condition(0), condition(1), from);
    if (at > first.at) first = {at, joint, to};
  };
  switch (state) {
    case JointState::open: {
      const double slip = u(1)(0) + from * u(1)(1);
      consider(u(0), slip >= 0.0 ? JointState::slip_forward : JointState::slip_backward);
      break;
    }
    case JointState::stick:
      consider(law.friction * n - t, JointState::slip_backward);
      consider(law.friction * n + t, JointState::slip_forward);
      break;
    case JointState::slip_forward:
      consider(n, JointState::open);
      consider(u(1), JointState::stick);
      break;
    case JointState::slip_backward:
      consider(n, JointState::open);
      consider(-u(1), JointState::stick);
      break;
  }
  return first;
}

}  // namespace

VectorXd cohesion_to_stick(const LocalContact& p) {
  const VectorXd r = p.r0 - p.S * p.u0;
  VectorXd extra(static_cast<Index>(p.laws.size()));
  for (Index i = 0; i < extra.size(); ++i) {
    const JointLaw& law = p.laws[static_cast<std::size_t>(i)];
    const double need = std::abs(r(2 * i + 1)) / std::max(law.friction, 1e-3) - r(2 * i) - law.cohesion;
    extra(i) = std::max(0.0, 1.01 * need);
  }
  return extra;
}

LocalContactResult follow_release(const LocalContact& problem, States states, const VectorXd& extra,
                                  int max_changes) {
  LocalContactResult result;
  double lambda = 1.0;
  std::size_t last_joint = states.size();
  JointState last_from = JointState::open;
  double last_at = 2.0;
  for (; result.iterations < max_changes; ++result.iterations) {
    const Branch branch = solve_branch(problem, states, extra);
    if (!branch.y.allFinite()) break;
    Change next;
    for (std::size_t j = 0; j < states.size(); ++j) {
      const Change change =
          next_change(branch, j, states[j], problem.laws[j], extra(static_cast<Index>(j)), lambda);
      if (change.at > next.at) next = change;
    }
    result.y = branch.y.col(0);
    if (next.at < 0.0) {
      result.converged = true;
      break;
    }
    // Back to where it came from without having moved: the path turns back.
    if (next.joint == last_joint && next.to == last_from && next.at == last_at) break;
    last_joint = next.joint;
    last_from = states[next.joint];
    last_at = next.at;
    lambda = next.at;
    states[next.joint] = next.to;
  }
  result.states = std::move(states);
  return result;
}

}  // namespace havers::sim
