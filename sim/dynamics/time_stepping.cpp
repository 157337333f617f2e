#include "sim/dynamics/time_stepping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "sim/contact/active_set.hpp"
#include "sim/contact/gauss_seidel.hpp"
#include "sim/dynamics/energy.hpp"
#include "sim/dynamics/step_control.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/outcome.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::unique_ptr<JointSolver> make_solver(const SolverOptions& options, const Bodies& bodies) {
  if (options.contact == ContactMethod::gauss_seidel)
    return std::make_unique<GaussSeidelSolver>(bodies, options.tolerance, options.max_iterations);
  return std::make_unique<ActiveSetSolver>(bodies, options.max_iterations, options.leave_out);
}

// Everything that changes from step to step.
class DynamicRun {
 public:
  DynamicRun(const Scene& scene, const Assembly& assembly, double h);

  /// One step; false when the joints' problem was not solved.
  bool advance();
  /// After two steps of uniform motion, whose reactions change linearly: on to one step before the
  /// first break. Returns the strain leapt over. [-]
  double leap();
  [[nodiscard]] CurvePoint point() const;
  [[nodiscard]] const EnergyBalance& energy() const { return energy_; }
  [[nodiscard]] const VectorXd& displacements() const { return motion_.q; }
  [[nodiscard]] bool finite() const { return motion_.q.allFinite() && motion_.v.allFinite(); }

  std::vector<JointOutcome> joints;
  double worst_residual = 0.0, worst_penetration = 0.0;
  long iterations = 0;
  int steps = 0;

 private:
  void start();
  void prepare();
  void move(const JointStepResult& result);
  void account(const JointStepResult& result, const Motion& before);
  void break_joints(const JointStepResult& result);
  [[nodiscard]] double time() const { return leapt_ + steps * h_; }
  [[nodiscard]] double strain() const {
    const double rate = scene_.loading.strain_rate;
    return rate * leapt_ + rate * steps * h_;
  }
  [[nodiscard]] double time_to_first_break() const;

  const Scene& scene_;
  const Assembly& assembly_;
  double h_;
  Bodies bodies_;
  std::unique_ptr<JointSolver> solver_;
  Motion motion_;
  JointStep step_;
  EnergyBalance energy_;
  VectorXd slope_;                               // change of the reactions in the last step [N/m]
  double acceleration_force_ = 0.0;              // norm of M dv/h in the last step [N/m]
  double leapt_ = 0.0;                           // time that passed without steps [s]
  double force_right_ = 0.0, force_left_ = 0.0;  // of the machine on the specimen, along x [N/m]
  int broken_ = 0, missing_ = 0;
};

DynamicRun::DynamicRun(const Scene& scene, const Assembly& assembly, double h)
    : scene_(scene),
      assembly_(assembly),
      h_(h),
      bodies_(assembly, scene.material, {1.0 / (h * h), 1.0 + scene.material.viscosity / h},
              scene.solver.leave_out),
      solver_(make_solver(scene.solver, bodies_)) {
  start();
}

void DynamicRun::start() {
  const auto rows = static_cast<Index>(2 * assembly_.joints.size());
  motion_.q = motion_.v = VectorXd::Zero(bodies_.dofs());
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

  joints = initial_outcomes(draw_thresholds(scene_, assembly_));
  step_.gaps = step_.held_at = step_.reactions = slope_ = VectorXd::Zero(rows);
  step_.states.assign(joints.size(), JointState::stick);
  step_.broken.assign(joints.size(), 0);
  step_.laws.reserve(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const bool missing = joints[j].broken;
    missing_ += missing ? 1 : 0;
    step_.broken[j] = missing ? 1 : 0;
    step_.laws.push_back(missing ? broken_law(scene_.joints.friction)
                                 : intact_law(joints[j].threshold));
  }
}

// Loads and predicted gaps of the coming step (M3), for δ = h (v⁺ − v).
void DynamicRun::prepare() {
  const VectorXd Kv = (h_ + scene_.material.viscosity) * motion_.Kv;
  step_.forces = -(motion_.Kq + Kv);
  step_.predicted = step_.gaps + h_ * joint_gaps(bodies_, motion_.v);
  step_.prescribed = VectorXd::Zero(bodies_.dofs());
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

// Forces of the machine, from the momentum balance of the held nodes, and the energies.
void DynamicRun::account(const JointStepResult& result, const Motion& before) {
  const VectorXd inertia = bodies_.mass().cwiseProduct(motion_.v - before.v) / h_;
  acceleration_force_ = inertia.norm();
  const VectorXd reaction = inertia + motion_.Kq + scene_.material.viscosity * motion_.Kv -
                            joint_forces_on_nodes(bodies_, result.reactions);
  const auto along_x = [&](const std::vector<int>& nodes) {
    double sum = 0.0;
    for (const int node : nodes) sum += reaction(2 * node);
    return sum;
  };
  force_right_ = along_x(assembly_.right);
  force_left_ = along_x(assembly_.left);
  energy_.add({.time = h_,
               .viscosity = scene_.material.viscosity,
               .external_work = force_right_ * scene_.loading.strain_rate * assembly_.width * h_,
               .joint_dissipation = -result.reactions.dot(result.gaps - step_.gaps)},
              before, motion_, bodies_.mass());
}

// (M6): what has reached the boundary of its cone in the solution is broken from the next step on.
void DynamicRun::break_joints(const JointStepResult& result) {
  const double now = strain();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    if (!joints[j].broken && result.states[j] != JointState::stick) {
      joints[j].broken = true;
      joints[j].broken_at_strain = now;
      step_.broken[j] = 1;
      step_.laws[j] = broken_law(scene_.joints.friction);
      ++broken_;
    }
    joints[j].reaction_normal = result.reactions(row);
    joints[j].reaction_tangent = result.reactions(row + 1);
    joints[j].gap = result.gaps(row);
    worst_penetration = std::max(worst_penetration, -result.gaps(row));
    if (joints[j].broken) step_.held_at(row + 1) = result.gaps(row + 1);
  }
  step_.states = result.states;
  step_.gaps = result.gaps;
  // A bonded joint has no gap: no drift from rounding.
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (!joints[j].broken) step_.gaps.segment<2>(static_cast<Index>(2 * j)).setZero();
}

bool DynamicRun::advance() {
  prepare();
  const JointStepResult result = solver_->solve(step_);
  iterations += result.iterations;
  worst_residual = std::max(worst_residual, result.residual);
  if (result.displacements.size() == 0) return false;
  const Motion before = motion_;
  move(result);
  account(result, before);
  ++steps;
  slope_ = result.reactions - step_.reactions;
  step_.reactions = result.reactions;
  break_joints(result);
  step_.force_scale = std::max(step_.force_scale, result.reactions.norm());
  return result.converged;
}

// Margins of the cones, μ (R_N + c) ∓ R_T, change linearly: when the first is used up. [s]
double DynamicRun::time_to_first_break() const {
  const double noise = 1e-9 * slope_.lpNorm<Eigen::Infinity>();
  double first = (scene_.loading.max_strain / scene_.loading.strain_rate) - time();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Local r = step_.reactions.segment<2>(static_cast<Index>(2 * j)),
                change = slope_.segment<2>(static_cast<Index>(2 * j));
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
  if (broken_ + missing_ > 0 || acceleration_force_ > uniform * motion_.Kq.norm()) return 0.0;
  const double time = beyond * time_to_first_break() - h_;
  if (!(time > h_)) return 0.0;
  energy_.viscous += scene_.material.viscosity * time * motion_.v.dot(motion_.Kv);
  motion_.q += time * motion_.v;
  motion_.Kq += time * motion_.Kv;
  energy_.start(motion_, bodies_.mass());
  leapt_ += time;
  return scene_.loading.strain_rate * time;
}

CurvePoint DynamicRun::point() const {
  return {.time = time(),
          .strain = strain(),
          .stress_right = force_right_ / assembly_.height,
          .stress_left = -force_left_ / assembly_.height,
          .broken_joints = broken_,
          .kinetic = energy_.kinetic,
          .elastic = energy_.elastic,
          .dissipated = energy_.joints + energy_.viscous};
}

// Section 7.
std::vector<LeftOut> left_out_in_time(const Scene& scene, const Simulation& simulation) {
  std::vector<LeftOut> list;
  if (simulation.leapt_strain > 0.0)
    list.push_back({fmt::format("time steps up to a strain of {:.4g}", simulation.leapt_strain),
                    "until the first break the motion is uniform and known"});
  if (scene.solver.leave_out && scene.solver.contact != ContactMethod::gauss_seidel)
    list.push_back(
        {"contact of joints that opened", "checked each step, and taken up again when they close"});
  return list;
}

}  // namespace

Simulation simulate_dynamic(const Scene& scene, const Observer& observer) {
  if (!scene.solver.step) return run_in_chosen_steps(scene, observer);
  Simulation run = run_in_steps(scene, {*scene.solver.step}, observer);
  run.step_error.reset();
  run.regime_ground = fmt::format(
      "; the step of {:.3g} ns is given, and its error is not known: a run without step_s chooses "
      "its own and says it",
      1e9 * run.step);
  return run;
}

Simulation run_in_steps(const Scene& scene, const Stepping& stepping, const Observer& observer) {
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  Simulation simulation;
  simulation.regime = Regime::dynamic;
  simulation.step = stepping.step;
  DynamicRun run(scene, assembly, simulation.step);
  simulation.curve.push_back(run.point());
  simulation.status = SimulationStatus::strain_limit;

  while (simulation.curve.back().strain < scene.loading.max_strain) {
    const bool solved = run.advance();
    if (!run.finite()) {
      simulation.status = SimulationStatus::not_finite;
      break;
    }
    simulation.curve.push_back(run.point());
    if (!solved) {
      simulation.status = SimulationStatus::not_converged;
      break;
    }
    if (observer &&
        !observer({simulation.curve.back(), simulation.curve.size() - 1,
                   [&run] { return run.joints; }, [&run] { return run.displacements(); }})) {
      simulation.status = SimulationStatus::cancelled;
      break;
    }
    if (has_failed(simulation, scene.loading.end_fraction)) {
      simulation.status = SimulationStatus::broken;
      break;
    }
    if (stepping.leap && run.steps == 2) simulation.leapt_strain = run.leap();
  }
  simulation.joints = run.joints;
  simulation.displacements = run.displacements();
  simulation.steps = run.steps;
  simulation.iterations = run.iterations;
  simulation.energy_defect = run.energy().relative_defect;
  simulation.worst_residual = run.worst_residual;
  simulation.worst_penetration = run.worst_penetration;
  simulation.dropped = assembly.dropped;
  simulation.left_out = left_out_in_time(scene, simulation);
  return simulation;
}

}  // namespace havers::sim
