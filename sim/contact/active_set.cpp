// Most joints hold, which is a linear condition and one solve. The joints that may move are found
// among those that this solve overloads; the order of ways in `solve` is that of (C5).
#include "sim/contact/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace havers::sim {

using Eigen::VectorXd;

namespace {

// Fewer that have opened are not worth a new factor, fewer that bear not some for each step.
constexpr int worth_detaching = 24;
constexpr std::size_t worth_searching = 48;
// Paths of more that leave the bonded state in a step are long, and may lead nowhere.
constexpr std::size_t most_at_once = 200;
// Part of the stiffness that inertia is, beyond which sweeps are quick.
constexpr double worth_sweeping = 1e-3;
// Cohesive friction that was seen to leave several answers; sweeps find the nearest.
constexpr double strong_friction = 1.25;
constexpr double least_borne = 1e-9;  // of the reactions
// Part of the stiffness that is less than what inertia adds, in all but the longest steps.
constexpr double below_inertia = 1e-13;

// Of the bodies that inertia holds best: slivers are stiff.
double inertia_part(const Bodies& bodies) {
  double part = 0.0;
  for (const BodyClass& group : bodies.classes()) part = std::max(part, group.op.inertia_part);
  return part;
}

// Broken joints that have just broken, or press.
std::size_t bearing(const JointStep& step) {
  std::size_t count = 0;
  for (std::size_t joint = 0; joint < step.broken.size(); ++joint)
    if (step.broken[joint] != 0 &&
        of_joint(step.reactions, joint).norm() > least_borne * step.force_scale)
      ++count;
  return count;
}

bool friction_is_strong(const JointStep& step) {
  return std::ranges::any_of(step.laws, [](const JointLaw& law) {
    return law.cohesion > 0.0 && law.friction > strong_friction;
  });
}

// Joints that leave the bonded state in an answer.
std::size_t leaving(const JointStep& step, const JointStepResult& result) {
  std::size_t count = 0;
  for (std::size_t j = 0; j < result.states.size(); ++j)
    if (step.broken[j] == 0 && result.states[j] != JointState::stick) ++count;
  return count;
}

}  // namespace

ActiveSetSolver::ActiveSetSolver(const Bodies& bodies, bool detach_open)
    : detach_open_(detach_open),
      sweeps_are_quick_(inertia_part(bodies) > worth_sweeping),
      may_search_(std::ranges::none_of(bodies.classes(),
                                       [](const BodyClass& group) { return group.op.at_rest(); })),
      structure_(bodies),
      loose_(structure_),
      search_(bodies),
      stiffness_(joint_stiffness(bodies)) {}

void ActiveSetSolver::rebuild(std::vector<Held> held) {
  structure_.hold(std::move(held));
  loose_ = LooseJoints(structure_);
}

void ActiveSetSolver::detach_opened(const JointStep& step) {
  if (!detach_open_) return;
  std::vector<Held> held = structure_.held();
  int opened = 0;
  for (std::size_t j = 0; j < held.size(); ++j) {
    if (step.broken[j] == 0 || step.states[j] != JointState::open || held[j] == Held::not_at_all)
      continue;
    held[j] = Held::not_at_all;
    ++opened;
  }
  if (opened >= worth_detaching) rebuild(std::move(held));
}

// Jumps that bring every joint to where it is held, the loose ones to where they are now.
VectorXd ActiveSetSolver::jumps(const JointStep& step) const {
  VectorXd target = VectorXd::Zero(step.gaps.size());
  target(loose_.rows()) = step.gaps(loose_.rows());
  return target - step.predicted;
}

// The loose joints among themselves.
bool ActiveSetSolver::settle_loose(const JointStep& step, const VectorXd& bonded_reactions,
                                   Effort effort, JointStepResult& result, VectorXd& y) const {
  // Gaps count from where each joint is held. The step's force scale is a norm over all joints;
  // divided by √n it is that of one joint. The trace stays below inertia, which has to be what
  // holds pieces.
  LocalContact contact{loose_.stiffness(),
                       bonded_reactions(loose_.rows()),
                       (step.gaps - step.held_at)(loose_.rows()),
                       {},
                       {},
                       below_inertia,
                       step.force_scale / std::sqrt(static_cast<double>(step.laws.size())),
                       step.stop_asked};
  std::vector<JointState> states;
  for (const int joint : loose_.joints()) {
    contact.laws.push_back(step.laws[static_cast<std::size_t>(joint)]);
    states.push_back(result.states[static_cast<std::size_t>(joint)]);
  }
  const LocalContactResult local = solve_local_contact(contact, states, effort);
  result.iterations += local.iterations;
  y = local.y;
  for (std::size_t i = 0; i < loose_.size() && local.converged; ++i)
    result.states[static_cast<std::size_t>(loose_.joints()[i])] = local.states[i];
  return local.converged;
}

// Joints that hold and that their reactions overload, which changes their states.
std::vector<int> ActiveSetSolver::violated(const JointStep& step, const VectorXd& reactions,
                                           JointStepResult& result) const {
  const double scale = reactions.lpNorm<Eigen::Infinity>();  // 0 where there is no joint
  std::vector<int> joints;
  for (int joint = 0; joint < static_cast<int>(step.laws.size()); ++joint) {
    const auto j = static_cast<std::size_t>(joint);
    if (detached(joint) || loose_.contains(joint)) continue;
    const JointState state =
        state_of(of_joint(reactions, j), Local::Zero(), JointState::stick, step.laws[j], scale);
    if (state == JointState::stick) continue;
    result.states[j] = state;
    joints.push_back(joint);
  }
  return joints;
}

bool ActiveSetSolver::reattach_closed(const JointStepResult& result) {
  std::vector<Held> held = structure_.held();
  std::vector<int> again;
  for (int joint = 0; joint < static_cast<int>(held.size()); ++joint)
    if (detached(joint) && of_joint(result.gaps, static_cast<std::size_t>(joint)).x() < 0.0)
      again.push_back(joint);
  if (again.empty()) return false;
  for (const int joint : again) held[static_cast<std::size_t>(joint)] = Held::fully;
  // What was loose stays loose.
  again.insert(again.end(), loose_.joints().begin(), loose_.joints().end());
  rebuild(std::move(held));
  if (structure_.ok())
    for (const int joint : again) loose_.add(joint);
  return true;
}

// Either way may find the set that the other misses.
JointStepResult ActiveSetSolver::solve(const JointStep& step) {
  const bool few_bear = bearing(step) < worth_searching;
  JointStepResult result;
  long iterations = 0;
  // An answer that keeps the law badly stands only where no other way has a better one.
  const auto unless_solved = [&](const auto& solve) {
    constexpr double well = 1e-9;  // of the residual (M11)
    if ((result.converged && result.residual <= well) || stop_is_asked(step.stop_asked)) return;
    JointStepResult other = solve();
    iterations += other.iterations;
    if (!result.converged || (other.converged && !(result.residual <= other.residual)))
      result = std::move(other);
  };
  const auto loosening = [&](std::size_t joints) {
    return solve_loose(step, Effort::little, joints);
  };
  // Several answers are possible here: the first one is taken as it is only where no joint leaves
  // the bonded state in it. Where few leave it, sets are searched for the nearest answer.
  if (few_bear && sweeps_are_quick_ && friction_is_strong(step)) {
    unless_solved([&] { return loosening(0); });
    if (leaving(step, result) < worth_searching) unless_solved([&] { return search(step, true); });
  }
  // Where few joints bear, the loose ones are solved for among themselves. Else, or where that
  // finds nothing, sets are searched by sweeps over all joints.
  if (few_bear && may_search_) unless_solved([&] { return loosening(most_at_once); });
  if (may_search_) unless_solved([&] { return search(step, false); });
  // Where neither finds an answer it is looked for with all effort. Where inertia is but a trace,
  // sets are only searched after that.
  unless_solved([&] { return solve_loose(step, Effort::all, step.laws.size()); });
  if (!may_search_) unless_solved([&] { return search(step, false); });
  result.iterations = iterations;
  return result;
}

JointStepResult ActiveSetSolver::search(const JointStep& step, bool nearest) {
  JointStepResult found = search_.solve(step, nearest);
  if (detach_open_ || !found.converged) return found;
  JointStep from_there = step;  // with the open joints in the factor
  from_there.states = std::move(found.states);
  JointStepResult result = solve_loose(from_there, Effort::all, step.laws.size());
  result.iterations += found.iterations;
  return result;
}

// Not converged where more joints than that leave the bonded state.
JointStepResult ActiveSetSolver::solve_loose(const JointStep& step, Effort effort,
                                             std::size_t most_leave) {
  detach_opened(step);
  JointStepResult result;
  result.states = step.states;
  if (!structure_.ok()) return result;
  // What is broken and not detached may move; after a rebuild it has to be said again.
  for (int joint = 0; joint < static_cast<int>(step.laws.size()); ++joint) {
    const auto j = static_cast<std::size_t>(joint);
    const bool moves = step.broken[j] != 0 || step.states[j] != JointState::stick;
    if (moves && !detached(joint) && !loose_.contains(joint)) loose_.add(joint);
  }

  // Done again where joints that were detached have closed.
  do {
    result.states = step.states;
    for (std::size_t j = 0; j < result.states.size(); ++j)
      if (detached(static_cast<int>(j))) result.states[j] = JointState::open;
    result.converged = false;
    if (!structure_.ok()) return result;
    // What all would bear if the loose ones stayed where they are.
    const StructureLoads bonded{step.forces, step.prescribed, jumps(step), step.force_scale};
    StructureResponse bonded_response = structure_.solve(bonded), loose_response;
    StructureResponse* response = nullptr;
    std::vector<int> overloaded;
    do {  // again with those that the answer overloads, until none is
      for (const int joint : overloaded) loose_.add(joint);
      VectorXd y;
      result.converged = settle_loose(step, bonded_response.reactions, effort, result, y);
      response = &bonded_response;
      if (!result.converged) break;
      // Nothing to solve for where nothing has moved.
      if (y.size() > 0 && !y.isZero(0.0)) {
        StructureLoads loads = bonded;
        loads.jumps(loose_.rows()) += y;
        loose_response = structure_.solve(loads);
        response = &loose_response;
      }
      overloaded = violated(step, response->reactions, result);
      result.converged = leaving(step, result) <= most_leave && !stop_is_asked(step.stop_asked);
    } while (result.converged && !overloaded.empty());
    result.iterations += response->solves;
    result.displacements = std::move(response->displacements);
    result.reactions = std::move(response->reactions);
    result.tie_forces = std::move(response->tie_forces);
    result.gaps = step.predicted + response->gaps;
    result.residual = std::max(joint_residual(step, result, stiffness_), response->residual);
  } while (result.converged && reattach_closed(result));
  return result;
}

}  // namespace havers::sim
