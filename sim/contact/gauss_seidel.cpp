// Sweeps until the residual of all joints is below the tolerance. States are read off the answer,
// to within what the tolerance can tell.
#include "sim/contact/gauss_seidel.hpp"

#include <algorithm>

namespace havers::sim {

namespace {

constexpr int sweeps_between_checks = 10;  // of the residual, which looks at every joint too

// On the cone to within what the tolerance can tell.
JointState state_within(double tolerance, const Local& reaction, double slip, const JointLaw& law) {
  if (cone_margin(reaction, law) > tolerance) return JointState::stick;
  if (reaction.x() + law.cohesion <= tolerance) return JointState::open;
  return slip >= 0.0 ? JointState::slip_forward : JointState::slip_backward;
}

}  // namespace

GaussSeidelSolver::GaussSeidelSolver(const Bodies& bodies, double tolerance, int max_sweeps)
    : tolerance_(tolerance),
      max_sweeps_(max_sweeps),
      sweeps_(bodies),
      stiffness_(joint_stiffness(bodies)) {}

JointStepResult GaussSeidelSolver::solve(const JointStep& step) {
  JointStepResult result;
  sweeps_.start(step, step.reactions, step.tie_forces);
  const auto measure = [&] {
    result.reactions = sweeps_.reactions();
    result.gaps = sweeps_.gaps(step);
    const double scale = std::max({step.force_scale, result.reactions.norm(), 1e-300});
    // An open tie counts by the force that it would cause.
    result.residual = joint_residual(step, result, stiffness_) +
                      sweeps_.tie_gap() * stiffness_.lpNorm<Eigen::Infinity>() / scale;
    result.converged = result.residual <= tolerance_;
  };
  // No sweep where the last step's reactions are the answer.
  for (measure(); !result.converged && result.iterations < max_sweeps_; ++result.iterations) {
    sweeps_.sweep(step);
    if (result.iterations % sweeps_between_checks != sweeps_between_checks - 1) continue;
    measure();
    if (stop_is_asked(step.stop_asked)) break;
  }
  measure();
  result.tie_forces = sweeps_.tie_forces();
  result.displacements = sweeps_.displacements(step);
  const double unsure = tolerance_ * result.reactions.lpNorm<Eigen::Infinity>();
  for (std::size_t j = 0; j < step.laws.size(); ++j) {
    const Local gap = of_joint(result.gaps, j) - of_joint(step.held_at, j);
    result.states.push_back(
        state_within(unsure, of_joint(result.reactions, j), gap.y(), step.laws[j]));
  }
  return result;
}

}  // namespace havers::sim
