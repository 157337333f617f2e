#include "sim/contact/state_system.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A piece that hangs on nothing leaves the equations singular: a trace of their diagonal holds it,
// and a few corrections take the trace's effect on everything else away.
constexpr double trace = 1e-8;
constexpr int corrections = 3;

double friction_slope(JointState state, const JointLaw& law) {
  if (state == JointState::slip_forward) return law.friction;
  if (state == JointState::slip_backward) return -law.friction;
  return 0.0;
}

}  // namespace

StateSystem::StateSystem(const LocalContact& problem, const std::vector<JointState>& states)
    : problem_(&problem) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    if (states[i] == JointState::open) {
      unknown_.push_back(row);
      slope_.push_back(0.0);
    }
    if (states[i] != JointState::stick) {
      unknown_.push_back(row + 1);
      slope_.push_back(friction_slope(states[i], problem.laws[i]));
    }
  }
  const auto n = static_cast<Index>(unknown_.size());
  if (n == 0) return;
  matrix_.resize(n, n);
  for (Index k = 0; k < n; ++k) {
    const Index row = unknown_[static_cast<std::size_t>(k)];
    matrix_.row(k) = problem.S(row, unknown_);
    const double slope = slope_[static_cast<std::size_t>(k)];
    if (slope != 0.0) matrix_.row(k) += slope * problem.S(row - 1, unknown_);
  }
  MatrixXd held = matrix_;
  held.diagonal() *= 1.0 + trace;
  factor_.compute(held);
}

VectorXd StateSystem::solve(const VectorXd& r0, const VectorXd& held,
                            const VectorXd& cohesion) const {
  VectorXd y = held;
  if (unknown_.empty()) return y;
  for (const Index row : unknown_) y(row) = 0.0;
  const VectorXd r = r0 + problem_->S * y;
  VectorXd b(static_cast<Index>(unknown_.size()));
  for (Index k = 0; k < b.size(); ++k) {
    const Index row = unknown_[static_cast<std::size_t>(k)];
    const double slope = slope_[static_cast<std::size_t>(k)];
    b(k) = -r(row);
    if (row % 2 == 0) b(k) -= cohesion(row / 2);
    if (slope != 0.0) b(k) -= slope * (r(row - 1) + cohesion(row / 2));
  }
  VectorXd x = factor_.solve(b);
  for (int i = 0; i < corrections; ++i) {
    const VectorXd missing = b - matrix_ * x;
    x += factor_.solve(missing);
  }
  y(unknown_) = x;
  return y;
}

}  // namespace havers::sim
