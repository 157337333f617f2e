#include "sim/contact/local_contact.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using States = std::vector<JointState>;

constexpr double rounding = 1e-12;

double sign_of(JointState state) {
  return state == JointState::slip_forward ? 1.0 : state == JointState::slip_backward ? -1.0 : 0.0;
}

// Gaps are prescribed where a joint sticks, along the normal also where it slips; the others are unknown.
std::vector<Index> unknown_gaps(const States& states) {
  std::vector<Index> unknown;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    if (states[i] == JointState::open) unknown.push_back(row);
    if (states[i] != JointState::stick) unknown.push_back(row + 1);
  }
  return unknown;
}

// (C2): one linear equation for each unknown gap: no force beyond −c where open, friction on the cone where slipping.
VectorXd solve_set(const LocalContact& p, const States& states) {
  VectorXd y = -p.u0;
  const std::vector<Index> unknown = unknown_gaps(states);
  const auto n = static_cast<Index>(unknown.size());
  if (n == 0) return y;
  for (const Index row : unknown) y(row) = 0.0;
  const VectorXd r = p.r0 + p.S * y;

  MatrixXd A(n, n);
  VectorXd b(n);
  for (Index k = 0; k < n; ++k) {
    const Index row = unknown[static_cast<std::size_t>(k)];
    const auto joint = static_cast<std::size_t>(row / 2);
    const JointLaw& law = p.laws[joint];
    const double slope = sign_of(states[joint]) * law.friction;  // r_T = −slope (r_N + c)
    A.row(k) = p.S(row, unknown);
    b(k) = -r(row);
    if (row % 2 == 0) b(k) -= law.cohesion;
    if (slope != 0.0) {
      A.row(k) += slope * p.S(row - 1, unknown);
      b(k) -= slope * (r(row - 1) + law.cohesion);
    }
  }
  // A piece that hangs on nothing leaves A singular; a trace of its diagonal holds it without a force.
  A.diagonal() *= 1.0 + 1e-13;
  const VectorXd solution = A.partialPivLu().solve(b);
  y(unknown) = solution;
  return y;
}

// (C3). Returns the sweeps spent.
int gauss_seidel(const LocalContact& p, VectorXd& y, int max_sweeps) {
  VectorXd r = p.r0 + p.S * y;
  for (int sweep = 1; sweep <= max_sweeps; ++sweep) {
    double change = 0.0, size = 0.0;
    for (std::size_t i = 0; i < p.laws.size(); ++i) {
      const auto row = static_cast<Index>(2 * i);
      const Eigen::Matrix2d S = p.S.block<2, 2>(row, row);
      const Local old = y.segment<2>(row);
      const Local found = solve_single_joint(S, r.segment<2>(row) - S * old, p.u0.segment<2>(row), p.laws[i]);
      r += p.S.middleCols<2>(row) * (found - old);
      y.segment<2>(row) = found;
      change += (found - old).squaredNorm();
      size += found.squaredNorm();
    }
    if (change <= 1e-28 * size) return sweep;
  }
  return max_sweeps;
}

States states_of(const LocalContact& p, const VectorXd& y, const States& now) {
  const VectorXd r = p.r0 + p.S * y, u = p.u0 + y;
  const double scale = std::max(r.cwiseAbs().maxCoeff(), p.r0.cwiseAbs().maxCoeff());
  States states(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    const double stiffness = p.S(row, row);
    states[i] = state_of(r.segment<2>(row), stiffness * u.segment<2>(row), now[i], p.laws[i], scale);
  }
  return states;
}

}  // namespace

JointState state_of(const Local& reaction, const Local& gap, JointState now, const JointLaw& law, double scale) {
  const double tolerance = rounding * scale;
  if (now == JointState::open) return gap.x() < -tolerance ? JointState::stick : JointState::open;
  if (reaction.x() + law.cohesion < -tolerance) return JointState::open;
  if (now == JointState::stick) {
    if (cone_margin(reaction, law) >= -tolerance) return now;
    return reaction.y() < 0.0 ? JointState::slip_forward : JointState::slip_backward;
  }
  return sign_of(now) * gap.y() < -tolerance ? JointState::stick : now;
}

// Stick, else open, else slip either way.
Local solve_single_joint(const Eigen::Matrix2d& S, const Local& free, const Local& u0, const JointLaw& law) {
  const Local stuck = -u0;
  if (cone_margin(free + S * stuck, law) >= 0.0) return stuck;
  const Local opened = -(S.inverse() * (free + Local(law.cohesion, 0.0)));
  if (opened.x() + u0.x() >= 0.0) return opened;
  const double rn = free.x() - S(0, 0) * u0.x() + law.cohesion, rt = free.y() - S(1, 0) * u0.x();
  Local slipped = stuck;
  for (const double sign : {1.0, -1.0}) {
    const double slope = sign * law.friction;
    slipped.y() = -(rt + slope * rn) / (S(1, 1) + slope * S(0, 1));
    if (sign * (slipped.y() + u0.y()) >= 0.0) break;
  }
  return slipped;
}

LocalContactResult solve_local_contact(const LocalContact& problem, States states, int max_iterations) {
  LocalContactResult result;
  if (states.empty()) return {.converged = true, .y = {}, .states = {}, .iterations = 0};
  std::set<States> tried;
  bool swept = false;
  while (result.iterations < max_iterations) {
    ++result.iterations;
    result.y = solve_set(problem, states);
    States next = states_of(problem, result.y, states);
    if (next == states || !result.y.allFinite()) {
      result.converged = result.y.allFinite();
      break;
    }
    if (!tried.insert(states).second) {
      if (swept) break;
      swept = true;
      tried.clear();
      result.iterations += gauss_seidel(problem, result.y, max_iterations);
      next = states_of(problem, result.y, next);
    }
    states = std::move(next);
  }
  result.states = std::move(states);
  return result;
}

}  // namespace havers::sim
