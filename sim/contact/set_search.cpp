#include "sim/contact/set_search.hpp"

#include <algorithm>
#include <utility>

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int most_sets = 12;
constexpr int most_sweeps = 200;  // between two sets
constexpr int quiet_sweeps = 10;  // sweeps without a change of state

Held held_in(JointState state) {
  if (state == JointState::stick) return Held::fully;
  return state == JointState::open ? Held::not_at_all : Held::normal;
}

double slope_in(JointState state, const JointLaw& law) {
  if (state == JointState::slip_forward) return -law.friction;
  return state == JointState::slip_backward ? law.friction : 0.0;
}

}  // namespace

SetSearch::SetSearch(const Bodies& bodies)
    : bodies_(&bodies), sweeps_(bodies), stiffness_(joint_stiffness(bodies)) {}

void SetSearch::take(const std::vector<JointState>& states) {
  std::vector<Held> held(states.size());
  std::transform(states.begin(), states.end(), held.begin(), held_in);
  if (!structure_ || structure_->held() != held) structure_.emplace(*bodies_, std::move(held));
}

StructureResponse SetSearch::answer(const JointStep& step,
                                    const std::vector<JointState>& states) const {
  const auto joints = static_cast<Index>(states.size());
  StructureLoads loads{step.forces,
                       step.prescribed,
                       step.held_at - step.predicted,
                       step.force_scale,
                       VectorXd::Zero(2 * joints),
                       VectorXd::Zero(joints)};
  for (Index j = 0; j < joints; ++j) {
    const JointState state = states[static_cast<std::size_t>(j)];
    const JointLaw& law = step.laws[static_cast<std::size_t>(j)];
    loads.friction(j) = slope_in(state, law);
    if (state == JointState::open) loads.given(2 * j) = -law.cohesion;
    loads.given(2 * j + 1) = loads.friction(j) * law.cohesion;
  }
  return structure_->solve(loads);
}

// Returns the sweeps spent.
int SetSearch::look_for_states(const JointStep& step, const StructureResponse& from,
                               std::vector<JointState>& states) {
  sweeps_.start(step, from.reactions, from.tie_forces);
  int quiet = 0, sweep = 0;
  for (; sweep < most_sweeps && quiet < quiet_sweeps; ++sweep)
    quiet = sweeps_.sweep(step) ? 0 : quiet + 1;
  states = sweeps_.states();
  return sweep;
}

JointStepResult SetSearch::solve(const JointStep& step) {
  JointStepResult result;
  result.states = step.states;
  for (int set = 0; set < most_sets; ++set) {
    take(result.states);
    if (!structure_->ok()) return result;
    StructureResponse response = answer(step, result.states);
    ++result.iterations;
    result.gaps = step.predicted + joint_gaps(*bodies_, response.displacements);
    result.reactions = response.reactions;
    result.displacements = response.displacements;
    result.residual = std::max(joint_residual(step, result, stiffness_), response.residual);

    const double scale = std::max(step.force_scale, result.reactions.lpNorm<Eigen::Infinity>());
    bool lawful = true;
    for (std::size_t j = 0; j < step.laws.size() && lawful; ++j) {
      const auto row = static_cast<Index>(2 * j);
      const Local gap = result.gaps.segment<2>(row) - step.held_at.segment<2>(row);
      lawful = state_of(result.reactions.segment<2>(row), stiffness_(static_cast<Index>(j)) * gap,
                        result.states[j], step.laws[j], scale) == result.states[j];
    }
    result.converged = lawful && response.residual < 1e-9;
    if (result.converged) break;
    result.iterations += look_for_states(step, response, result.states);
  }
  return result;
}

}  // namespace havers::sim
