#include "sim/contact/set_search.hpp"

#include <algorithm>
#include <utility>

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int sets_from_answers = 12;  // each answer being where the next sweeps start
constexpr int sets_from_sweeps = 8;    // then sweeps go on from where they were, ever longer
constexpr int most_sweeps = 200;       // between two sets
constexpr int quiet_sweeps = 10;       // sweeps without a change of state
// Where the nearest answer is looked for, the first sweeps are so many times as long, and go on to
// the second set: what the answer of a set leads to may be another.
constexpr int patience_for_nearest = 5;
// From the seventh set on answers say themselves what is next, if that is so little.
constexpr int sets_by_sweeps_alone = 6;
constexpr std::size_t most_changes = 50;
// Before it sweeps are over-relaxed and see farther, and leave joints as they are while their
// bodies' forces change by no more than a part of the largest; but not where the nearest answer is
// looked for: they may pass it by.
constexpr double over_relaxed = 1.6;
constexpr double negligible = 1e-4;
// Part of the reactions that an answer may err by, where it breaks a law by more; most that keep
// the law to the first and break it after all show that by the second.
constexpr double rough = 1e-4, closer = 1e-8;
constexpr double useful = 0.1;   // to start from, likewise
constexpr double enough = 1e-9;  // to be an answer, likewise

Held held_in(JointState state) {
  if (state == JointState::stick) return Held::fully;
  return state == JointState::open ? Held::not_at_all : Held::normal;
}

}  // namespace

SetSearch::SetSearch(const Bodies& bodies)
    : bodies_(&bodies), sweeps_(bodies), stiffness_(joint_stiffness(bodies)) {}

void SetSearch::take(const std::vector<JointState>& states) {
  std::vector<Held> held(states.size());
  std::ranges::transform(states, held.begin(), held_in);
  if (!structure_)
    structure_.emplace(*bodies_, std::move(held));
  else if (structure_->held() != held && !structure_->hold_nearby(held))
    structure_->hold(std::move(held));
}

// Of the structure as it is, for the result's states.
void SetSearch::answer(const JointStep& step, double accuracy, JointStepResult& result) {
  const auto joints = static_cast<Index>(result.states.size());
  StructureLoads loads{step.forces,
                       step.prescribed,
                       step.held_at - step.predicted,
                       step.force_scale,
                       VectorXd::Zero(2 * joints),
                       VectorXd::Zero(joints),
                       accuracy,
                       last_.residual < useful ? &last_ : nullptr};
  // An open joint bears −c, a sliding one μ(R_N + c) against its slip, R_N being found with all
  // else.
  for (Index j = 0; j < joints; ++j) {
    const JointState state = result.states[static_cast<std::size_t>(j)];
    const JointLaw& law = step.laws[static_cast<std::size_t>(j)];
    loads.friction(j) = -slip_sign(state) * law.friction;
    if (state == JointState::open) loads.given(2 * j) = -law.cohesion;
    loads.given(2 * j + 1) = loads.friction(j) * law.cohesion;
  }
  last_ = structure_->solve(loads);
  // Where corrections of another set's factor do not end, this one gets its own, and where those of
  // a factor in single precision do not, one in double precision.
  for (const Precision precision : {Precision::single_where_enough, Precision::full}) {
    const bool ends = last_.residual <= std::max(accuracy, enough);
    if (ends || !structure_->would_differ(precision)) continue;
    structure_->hold(structure_->held(), precision);
    result.converged = false;
    if (!structure_->ok()) return;
    if (!(last_.residual < useful)) loads.near = nullptr;
    last_ = structure_->solve(loads);
  }
  ++result.iterations;
  result.gaps = step.predicted + last_.gaps;
  result.reactions = last_.reactions;
  result.displacements = last_.displacements;
  lawful_ = lawful(step, result, accuracy);
  result.converged = lawful_ == result.states;
}

// The states that the law gives joints with such an answer, where reactions err by part of the
// largest.
std::vector<JointState> SetSearch::lawful(const JointStep& step, const JointStepResult& result,
                                          double accuracy) const {
  std::vector<JointState> states(result.states.size());
  const double scale = accuracy / accuracy_of_forces *
                       std::max(step.force_scale, result.reactions.lpNorm<Eigen::Infinity>());
  for (std::size_t j = 0; j < step.laws.size(); ++j) {
    const Local gap = of_joint(result.gaps, j) - of_joint(step.held_at, j);
    states[j] = state_of(of_joint(result.reactions, j), stiffness_(static_cast<Index>(j)) * gap,
                         result.states[j], step.laws[j], scale);
  }
  return states;
}

// Returns the sweeps spent.
int SetSearch::look_for_states(const JointStep& step, int patience, bool far,
                               std::vector<JointState>& states) {
  const double relaxation = far ? over_relaxed : 1.0;
  const double least = far ? negligible * sweeps_.reactions().lpNorm<Eigen::Infinity>() : 0.0;
  int quiet = 0, sweep = 0;
  for (; sweep < patience * most_sweeps && quiet < patience * quiet_sweeps &&
         !stop_is_asked(step.stop_asked);
       ++sweep)
    quiet = sweeps_.sweep(step, relaxation, least) ? 0 : quiet + 1;
  states = sweeps_.states();
  return sweep;
}

// Whether the result's states are a set that keeps the law; that of no structure does not.
bool SetSearch::settles(const JointStep& step, JointStepResult& result) {
  take(result.states);
  if (!structure_->ok()) return false;
  for (const double accuracy : {rough, closer, accuracy_of_forces}) {
    answer(step, accuracy, result);
    if (!result.converged) break;
  }
  result.converged = result.converged && last_.residual < enough;
  if (result.converged) {
    result.residual = std::max(joint_residual(step, result, stiffness_), last_.residual);
    result.tie_forces = last_.tie_forces;
  }
  return result.converged;
}

// The same of those after it, each as the answer before asks, while that is ever less.
bool SetSearch::settles_nearby(const JointStep& step, std::size_t most, JointStepResult& result) {
  while (!settles(step, result)) {
    if (!structure_->ok()) return false;
    std::size_t changes = 0;
    for (std::size_t j = 0; j < lawful_.size(); ++j)
      if (lawful_[j] != result.states[j]) ++changes;
    if (changes == 0 || changes > most) return false;
    most = changes - 1;
    result.states = lawful_;
  }
  return true;
}

JointStepResult SetSearch::solve(const JointStep& step, bool nearest) {
  JointStepResult result;
  result.states = step.states;
  // What has broken since changes the last step's set.
  const auto broken = std::ranges::count(step.broken, 1);
  if (!nearest && std::exchange(broken_, broken) == broken && settles(step, result)) return result;
  // Friction may leave several solutions: towards the one nearest to the last.
  sweeps_.start(step, step.reactions, step.tie_forces);
  int patience = nearest ? patience_for_nearest : 1;
  const int most_sets = sets_from_answers + (nearest ? 0 : sets_from_sweeps);
  // Sweeps, the set that they come to, and its answer, from which the next sweeps start.
  for (int set = 0; set < most_sets && !stop_is_asked(step.stop_asked); ++set) {
    const bool by_sweeps_alone = set < sets_by_sweeps_alone;
    const bool far = by_sweeps_alone && !nearest;
    result.iterations += look_for_states(step, patience, far, result.states);
    if (settles_nearby(step, by_sweeps_alone ? 0 : most_changes, result) || !structure_->ok())
      break;
    const bool go_on = (nearest && set == 0) || set >= sets_from_answers;
    if (!go_on) sweeps_.start(step, last_.reactions, last_.tie_forces);
    patience = go_on ? 2 * patience : 1;
  }
  return result;
}

}  // namespace havers::sim
