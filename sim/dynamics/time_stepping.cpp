#include "sim/dynamics/time_stepping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "sim/contact/active_set.hpp"
#include "sim/contact/gauss_seidel.hpp"
#include "sim/dynamics/energy.hpp"
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
  [[nodiscard]] CurvePoint point() const;
  [[nodiscard]] const EnergyBalance& energy() const { return energy_; }
  [[nodiscard]] const VectorXd& displacements() const { return motion_.q; }
  [[nodiscard]] bool finite() const { return motion_.q.allFinite() && motion_.v.allFinite(); }

  std::vector<JointOutcome> joints;
  double worst_residual = 0.0, worst_penetration = 0.0, penetration_scale = 0.0;
  long iterations = 0;
  int steps = 0;

 private:
  void start();
  void prepare();
  void move(const JointStepResult& result);
  void account(const JointStepResult& result, const Motion& before);
  void break_joints(const JointStepResult& result);

  const Scene& scene_;
  const Assembly& assembly_;
  double h_;
  Bodies bodies_;
  std::unique_ptr<JointSolver> solver_;
  Motion motion_;
  JointStep step_;
  EnergyBalance energy_;
  double force_right_ = 0.0, force_left_ = 0.0;  // of the machine on the specimen, along x [N/m]
  int broken_ = 0;
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
  step_.gaps = step_.held_at = VectorXd::Zero(rows);
  step_.states.assign(joints.size(), JointState::stick);
  step_.broken.assign(joints.size(), 0);
  for (const JointOutcome& joint : joints) step_.laws.push_back(intact_law(joint.threshold));
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
  const VectorXd reaction = bodies_.mass().cwiseProduct(motion_.v - before.v) / h_ + motion_.Kq +
                            scene_.material.viscosity * motion_.Kv -
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
  const double strain = scene_.loading.strain_rate * steps * h_;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    if (!joints[j].broken && result.states[j] != JointState::stick) {
      joints[j].broken = true;
      joints[j].broken_at_strain = strain;
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
  for (std::size_t j = 0; j < joints.size();
       ++j)  // a bonded joint has no gap: no drift from rounding
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
  break_joints(result);
  step_.force_scale = std::max(step_.force_scale, result.reactions.norm());
  return result.converged;
}

CurvePoint DynamicRun::point() const {
  return {.time = steps * h_,
          .strain = scene_.loading.strain_rate * steps * h_,
          .stress_right = force_right_ / assembly_.height,
          .stress_left = -force_left_ / assembly_.height,
          .broken_joints = broken_,
          .kinetic = energy_.kinetic,
          .elastic = energy_.elastic,
          .dissipated = energy_.joints + energy_.viscous};
}

}  // namespace

double choose_step(const Scene& scene) {
  const double wave = std::sqrt(scene.material.young / scene.material.density);
  const double strain = 1e-3 * scene.joints.head_tail / scene.material.young;
  return std::min(strain / scene.loading.strain_rate, 0.5 * scene.assembly.fibre_length / wave);
}

Simulation simulate_dynamic(const Scene& scene, const Observer& observer) {
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  Simulation simulation;
  simulation.regime = Regime::dynamic;
  simulation.step = scene.solver.step.value_or(choose_step(scene));
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
    if (observer && !observer({simulation.curve.back(), run.displacements(), run.joints})) {
      simulation.status = SimulationStatus::cancelled;
      break;
    }
    if (has_failed(simulation, scene.loading.end_fraction)) {
      simulation.status = SimulationStatus::broken;
      break;
    }
  }
  simulation.joints = run.joints;
  simulation.displacements = run.displacements();
  simulation.steps = run.steps;
  simulation.iterations = run.iterations;
  simulation.energy_defect = run.energy().relative_defect;
  simulation.worst_residual = run.worst_residual;
  simulation.worst_penetration = run.worst_penetration;
  return simulation;
}

}  // namespace havers::sim
