// Implicit Euler (M3), with the joints' problem of each step left to a solver: the run prepares it,
// takes its answer over and keeps account of the energies.
#include "sim/dynamics/dynamic_run.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/contact/active_set.hpp"
#include "sim/contact/gauss_seidel.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/outcome.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Sweeps go from joint to joint, and judge what ties lack by the forces of joints: a fibre alone,
// which has none, is left to the direct solver.
std::unique_ptr<JointSolver> make_solver(const SolverOptions& options, const Bodies& bodies) {
  if (options.contact == ContactMethod::gauss_seidel && !bodies.assembly().joints.empty())
    return std::make_unique<GaussSeidelSolver>(bodies, options.tolerance, options.max_iterations);
  return std::make_unique<ActiveSetSolver>(bodies, options.leave_out);
}

}  // namespace

DynamicRun::DynamicRun(const Scene& scene, const Assembly& assembly, double step,
                       const StopAsked& stop_asked)
    : scene_(scene),
      assembly_(assembly),
      h_(step),
      bodies_(assembly, scene.material,
              {1.0 / (step * step), 1.0 + scene.material.viscosity / step}, scene.solver.leave_out),
      solver_(make_solver(scene.solver, bodies_)) {
  const auto rows = static_cast<Index>(2 * assembly_.joints.size());
  motion_.q = motion_.v = VectorXd::Zero(bodies_.dofs());
  // The velocity of uniform strain (section 5); the corner that is held in y has none.
  if (scene_.loading.start == Start::uniform) {
    const double rate = scene_.loading.strain_rate, nu = lateral_contraction(scene_.material);
    const double y0 = assembly_.nodes[static_cast<std::size_t>(assembly_.corner)].y();
    for (std::size_t i = 0; i < assembly_.nodes.size(); ++i)
      motion_.v.segment<2>(static_cast<Index>(2 * i)) =
          rate * Eigen::Vector2d(assembly_.nodes[i].x(), -nu * (assembly_.nodes[i].y() - y0));
  }
  motion_.Kq = VectorXd::Zero(bodies_.dofs());
  motion_.Kv = bodies_.stiffness_times(motion_.v);
  energy_.start(motion_, bodies_.mass());

  joints_ = initial_outcomes(draw_thresholds(scene_, assembly_));
  step_.gaps = step_.held_at = step_.reactions = slope_ = VectorXd::Zero(rows);
  step_.stop_asked = stop_asked;
  step_.states.assign(joints_.size(), JointState::stick);
  step_.broken.assign(joints_.size(), 0);
  step_.laws.reserve(joints_.size());
  // A missing joint bears pressure and friction only, from the first step on.
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const bool missing = joints_[j].broken;
    step_.broken[j] = missing ? 1 : 0;
    step_.laws.push_back(missing ? broken_law(scene_.joints.friction)
                                 : intact_law(joints_[j].threshold));
  }
}

// Loads and predicted gaps of the coming step (M3), for δ = h (v⁺ − v).
void DynamicRun::prepare() {
  // (M3) divided by h: Ā δ = F − K(q + hv) − τKv + Hᵀr⁺, F on the held nodes alone.
  const VectorXd Kv = (h_ + scene_.material.viscosity) * motion_.Kv;
  step_.forces = -(motion_.Kq + Kv);
  step_.predicted = step_.gaps + h_ * joint_gaps(bodies_, motion_.v);
  step_.prescribed = VectorXd::Zero(bodies_.dofs());
  // Held nodes have the machine's velocity at the end of the step, whatever they had before.
  for (const int node : assembly_.left) step_.prescribed(2 * node) = -h_ * motion_.v(2 * node);
  for (const int node : assembly_.right)
    step_.prescribed(2 * node) =
        h_ * (scene_.loading.strain_rate * assembly_.width - motion_.v(2 * node));
}

void DynamicRun::move(const JointStepResult& result) {
  motion_.v += result.displacements / h_;
  motion_.q += h_ * motion_.v;
  motion_.Kq = bodies_.stiffness_times(motion_.q);
  motion_.Kv = bodies_.stiffness_times(motion_.v);
}

// Of all ties on the bodies, in the last step: none but where sweeps leave them apart. [J/m]
double DynamicRun::work_of_ties(const VectorXd& tie_forces) const {
  if (tie_forces.size() == 0) return 0.0;
  const VectorXd moved = bodies_.port_displacements(h_ * motion_.v);
  const auto ends = std::span(bodies_.ends()).last(assembly_.ties.size());
  double work = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i)
    work += tie_forces(static_cast<Index>(i)) * (moved(ends[i][1]) - moved(ends[i][0]));
  return work;
}

// Forces of the machine, from the momentum balance of the held nodes, and the energies.
void DynamicRun::account(const JointStepResult& result, const Motion& before) {
  const VectorXd inertia = bodies_.mass().cwiseProduct(motion_.v - before.v) / h_;
  acceleration_force_ = inertia.norm();
  // Along x this is zero but at held nodes, where it is the force of the machine; along y it has
  // the forces of ties in it.
  const VectorXd reaction = inertia + motion_.Kq + scene_.material.viscosity * motion_.Kv -
                            joint_forces_on_nodes(bodies_, result.reactions);
  const auto along_x = [](const VectorXd& forces, const std::vector<int>& nodes) {
    double sum = 0.0;
    for (const int node : nodes) sum += forces(2 * node);
    return sum;
  };
  const double pull = along_x(reaction, assembly_.right);
  // From rest the held nodes have their velocity at once: that impulse over h is no stress.
  force_right_ = pull - along_x(inertia, assembly_.right);
  force_left_ = along_x(reaction, assembly_.left);
  energy_.add({.time = h_,
               .viscosity = scene_.material.viscosity,
               .external_work = pull * scene_.loading.strain_rate * assembly_.width * h_,
               .joint_dissipation = -result.reactions.dot(result.gaps - step_.gaps) -
                                    work_of_ties(result.tie_forces)},
              before, motion_, bodies_.mass());
}

// (M6): what has reached the boundary of its cone in the solution is broken from the next step on.
void DynamicRun::break_joints(const JointStepResult& result) {
  const double now = strain();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    if (!joints_[j].broken && result.states[j] != JointState::stick) {
      joints_[j].broken = true;
      joints_[j].broken_at_strain = now;
      step_.broken[j] = 1;
      step_.laws[j] = broken_law(scene_.joints.friction);
      ++broken_;
    }
    joints_[j].reaction_normal = result.reactions(row);
    joints_[j].reaction_tangent = result.reactions(row + 1);
    joints_[j].gap = result.gaps(row);
    worst_penetration_ = std::max(worst_penetration_, -result.gaps(row));
    // A broken joint that sticks does so where it is now: friction acts against the slip of each
    // step.
    if (joints_[j].broken) step_.held_at(row + 1) = result.gaps(row + 1);
  }
  step_.states = result.states;
  step_.gaps = result.gaps;
  // A bonded joint has no gap: no drift from rounding.
  for (std::size_t j = 0; j < joints_.size(); ++j)
    if (!joints_[j].broken) step_.gaps.segment<2>(static_cast<Index>(2 * j)).setZero();
}

bool DynamicRun::advance() {
  prepare();
  const JointStepResult result = solver_->solve(step_);
  iterations_ += result.iterations;
  worst_residual_ = worse(worst_residual_, result.residual);
  // An answer that is not finite is taken over, so that the run ends with that as its reason.
  if (!result.converged && result.displacements.allFinite()) return false;
  const Motion before = motion_;
  move(result);
  if (!finite()) return true;  // the joints stay as they are in the last row
  account(result, before);
  ++steps_;
  // Kept for a leap, which needs it where the motion is uniform.
  slope_ = result.reactions - step_.reactions;
  step_.reactions = result.reactions;
  step_.tie_forces = result.tie_forces;
  break_joints(result);
  step_.force_scale = std::max(step_.force_scale, result.reactions.norm());
  return true;
}

// Margins of the cones, μ (R_N + c) ∓ R_T, change linearly: when the first is used up. [s]
double DynamicRun::time_to_first_break() const {
  const double noise = 1e-9 * slope_.lpNorm<Eigen::Infinity>();
  // No leap goes beyond the strain limit.
  double first = (scene_.loading.max_strain / scene_.loading.strain_rate) - time();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Local r = of_joint(step_.reactions, j), change = of_joint(slope_, j);
    const JointLaw& law = step_.laws[j];
    for (const double side : {1.0, -1.0}) {
      const double used = side * change.y() - law.friction * change.x();  // of the margin, a step
      if (used > noise * std::max(1.0, law.friction))
        first = std::min(first, h_ * (law.friction * (r.x() + law.cohesion) - side * r.y()) / used);
    }
  }
  return first;
}

double DynamicRun::leap() {
  constexpr double uniform = 1e-9, beyond = 1.0 + 1e-9;  // so that the step then breaks the joint
  // It leaps only where all accelerations are rounding and nothing has broken: then all is linear
  // in time.
  if (std::ranges::any_of(joints_, &JointOutcome::broken) ||
      acceleration_force_ > uniform * motion_.Kq.norm())
    return 0.0;
  const double to_go = beyond * time_to_first_break() - h_;
  if (!(to_go > h_)) return 0.0;
  // Where nothing is left out each whole step is taken, and only the rest goes at once, so that a
  // step ends on the break all the same.
  const double time =
      scene_.solver.leave_out ? to_go : to_go - h_ * static_cast<double>(whole_steps(to_go));
  // Viscous stress is constant on the way, and so is its power.
  energy_.viscous += scene_.material.viscosity * time * motion_.v.dot(motion_.Kv);
  motion_.q += time * motion_.v;
  motion_.Kq += time * motion_.Kv;
  step_.reactions += time / h_ * slope_;
  step_.force_scale = std::max(step_.force_scale, step_.reactions.norm());
  // The account starts anew from here: no step tells the work that the leap took.
  energy_.start(motion_, bodies_.mass());
  leapt_ += time;
  return to_go;
}

CurvePoint DynamicRun::point() const {
  return {.time = time(),
          .strain = strain(),
          .stress_right = force_right_ / assembly_.height,
          .stress_left = -force_left_ / assembly_.height,
          .broken_joints = broken_,
          .kinetic = energy_.kinetic,
          .elastic = energy_.elastic,
          .dissipated = energy_.joints + energy_.viscous,
          .numerical = energy_.numerical};
}

void DynamicRun::finish(Simulation& simulation) const {
  simulation.joints = joints_;
  simulation.displacements = motion_.q;
  simulation.steps = steps_;
  simulation.iterations = iterations_;
  simulation.energy_defect = energy_.relative_defect;
  if (energy_.external > 0.0) simulation.numerical_loss = energy_.numerical / energy_.external;
  simulation.worst_residual = simulation.residual_to_strength = worst_residual_;
  simulation.worst_penetration = worst_penetration_;
}

}  // namespace havers::sim
