// All solutions of a small local contact problem, by trying every combination of states.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "sim/contact/local_contact.hpp"

namespace havers::test {

inline double direction(sim::JointState state) {
  if (state == sim::JointState::slip_forward) return 1.0;
  return state == sim::JointState::slip_backward ? -1.0 : 0.0;
}

/// The gaps that given states ask for: two equations a joint.
inline Eigen::VectorXd gaps_of(const sim::LocalContact& p,
                               const std::vector<sim::JointState>& states) {
  const Eigen::Index n = p.S.rows();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b(n);
  for (Eigen::Index row = 0; row < n; row += 2) {
    const sim::JointState state = states[static_cast<std::size_t>(row / 2)];
    const sim::JointLaw& law = p.laws[static_cast<std::size_t>(row / 2)];
    if (state == sim::JointState::open) {  // r_N + c = 0
      M.row(row) = p.S.row(row);
      b(row) = -p.r0(row) - law.cohesion;
    } else {  // u_N = 0
      M(row, row) = 1.0;
      b(row) = -p.u0(row);
    }
    if (state == sim::JointState::stick) {  // u_T = 0
      M(row + 1, row + 1) = 1.0;
      b(row + 1) = -p.u0(row + 1);
    } else {  // r_T + sign μ (r_N + c) = 0; nothing is left of it where open
      const double slope = direction(state) * law.friction;
      M.row(row + 1) = p.S.row(row + 1) + slope * p.S.row(row);
      b(row + 1) = -p.r0(row + 1) - slope * (p.r0(row) + law.cohesion);
    }
  }
  return M.fullPivLu().solve(b);
}

/// Whether gaps y keep the law at every joint, to within a force tolerance.
inline bool keeps_law(const sim::LocalContact& p, const Eigen::VectorXd& y, double tolerance) {
  if (!y.allFinite()) return false;
  const Eigen::VectorXd r = p.r0 + p.S * y, u = p.u0 + y;
  for (std::size_t i = 0; i < p.laws.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    if (sim::law_residual(r.segment<2>(row), u.segment<2>(row), p.laws[i], p.S(row, row)).norm() >
        tolerance)
      return false;
  }
  return true;
}

/// Every solution, found by its states; the same gaps are listed once.
inline std::vector<Eigen::VectorXd> all_solutions(const sim::LocalContact& p) {
  constexpr sim::JointState every[] = {sim::JointState::stick, sim::JointState::slip_forward,
                                       sim::JointState::slip_backward, sim::JointState::open};
  const std::size_t n = p.laws.size();
  std::vector<Eigen::VectorXd> found;
  for (std::size_t code = 0; code < (std::size_t{1} << (2 * n)); ++code) {
    std::vector<sim::JointState> states;
    for (std::size_t i = 0; i < n; ++i) states.push_back(every[(code >> (2 * i)) & 3U]);
    const Eigen::VectorXd y = gaps_of(p, states);
    if (!keeps_law(p, y, 1e-9)) continue;
    bool known = false;
    for (const Eigen::VectorXd& other : found) known = known || (other - y).norm() < 1e-7;
    if (!known) found.push_back(y);
  }
  return found;
}

/// A random problem of unit scale; the same for the same seed. A part of its joints is broken.
inline sim::LocalContact random_contact(int joints, double friction, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Index n = 2 * joints;
  const auto draw = [&] { return normal(random); };
  const Eigen::MatrixXd H = Eigen::MatrixXd::NullaryExpr(n, 2 * n, draw);
  sim::LocalContact p{H * H.transpose() / static_cast<double>(2 * n),
                      Eigen::VectorXd(n),
                      Eigen::VectorXd::Zero(n),
                      {}};
  p.r0 = Eigen::VectorXd::NullaryExpr(n, draw);
  for (int i = 0; i < joints; ++i) {
    const bool broken = i % 2 == 0;
    const double cohesion = 0.5 * std::abs(draw());
    p.laws.push_back(broken ? sim::broken_law(friction)
                            : sim::intact_law({cohesion, friction * cohesion}));
    p.u0(2 * i) = broken ? 0.3 * std::abs(draw()) : 0.0;
    p.u0(2 * i + 1) = 0.3 * draw();
  }
  return p;
}

}  // namespace havers::test
