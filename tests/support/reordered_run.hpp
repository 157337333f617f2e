// Steps of a run on an assembly that the caller may have mirrored or renumbered: (M3) and (M6)
// written out, for comparison with simulate(), which lays its own.
#pragma once

#include <algorithm>
#include <vector>

#include "sim/contact/active_set.hpp"
#include "sim/simulation.hpp"

namespace havers::test {

/// The run and its joints, as far as comparisons need them.
struct SteppedRun {
  std::vector<double> right, left;  ///< Stress at the sides, a step each. [Pa]
  std::vector<int> broken_in;       ///< Step of each joint's break; -1: never.
};

/// The mirror image: y → H − y, or x → W − x, whose sides change places.
inline sim::Assembly mirrored(sim::Assembly assembly, bool upside_down) {
  const Eigen::Vector2d sign(upside_down ? 1.0 : -1.0, upside_down ? -1.0 : 1.0);
  const Eigen::Vector2d shift(upside_down ? 0.0 : assembly.width,
                              upside_down ? assembly.height : 0.0);
  for (Eigen::Vector2d& node : assembly.nodes) node = shift + sign.cwiseProduct(node);
  for (auto& triangle : assembly.triangles) std::swap(triangle[1], triangle[2]);
  for (sim::Joint& joint : assembly.joints) {
    joint.position = shift + sign.cwiseProduct(joint.position);
    joint.normal = sign.cwiseProduct(joint.normal);
  }
  if (!upside_down) std::swap(assembly.left, assembly.right);
  for (sim::Tie& tie : assembly.ties)
    if (upside_down)
      tie = {tie.body_bottom, tie.body_top,      tie.edge_bottom,
             tie.edge_top,    tie.weight_bottom, tie.weight_top};
  return assembly;
}

/// The field of unit strain rate, about the held corner.
inline Eigen::VectorXd uniform_field(const sim::Assembly& assembly, double poisson) {
  Eigen::VectorXd field(static_cast<Eigen::Index>(2 * assembly.nodes.size()));
  const double y0 = assembly.nodes[static_cast<std::size_t>(assembly.corner)].y();
  for (std::size_t i = 0; i < assembly.nodes.size(); ++i)
    field.segment<2>(static_cast<Eigen::Index>(2 * i)) << assembly.nodes[i].x(),
        -poisson * (assembly.nodes[i].y() - y0);
  return field;
}

/// Before the first step: all joints hold.
inline sim::JointStep intact_joints(const std::vector<sim::Threshold>& thresholds) {
  sim::JointStep step;
  const std::size_t joints = thresholds.size();
  step.gaps = step.held_at = step.reactions =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(2 * joints));
  step.states.assign(joints, sim::JointState::stick);
  step.broken.assign(joints, 0);
  for (const sim::Threshold& threshold : thresholds)
    step.laws.push_back(sim::intact_law(threshold));
  return step;
}

/// @param thresholds  One per joint of the assembly.
inline SteppedRun run_steps(const sim::Scene& scene, const sim::Assembly& assembly,
                            const std::vector<sim::Threshold>& thresholds, int steps) {
  using Eigen::VectorXd;
  const double h = *scene.solver.step, speed = scene.loading.strain_rate * assembly.width;
  const sim::Bodies bodies(assembly, scene.material, {1.0 / (h * h), 1.0});
  sim::ActiveSetSolver solver(bodies);
  VectorXd q = VectorXd::Zero(bodies.dofs());
  VectorXd v = scene.loading.strain_rate * uniform_field(assembly, scene.material.poisson);
  sim::JointStep step = intact_joints(thresholds);
  const std::size_t joints = thresholds.size();
  SteppedRun run{{}, {}, std::vector<int>(joints, -1)};
  for (int i = 0; i < steps; ++i) {
    step.forces = -bodies.stiffness_times(q + h * v);
    step.predicted = joint_gaps(bodies, q + h * v);
    step.prescribed = VectorXd::Zero(bodies.dofs());
    for (const int node : assembly.left) step.prescribed(2 * node) = -h * v(2 * node);
    for (const int node : assembly.right) step.prescribed(2 * node) = h * (speed - v(2 * node));
    const sim::JointStepResult result = solver.solve(step);
    if (!result.converged) break;
    v += result.displacements / h;
    q += h * v;
    const VectorXd force = bodies.mass().cwiseProduct(result.displacements) / (h * h) +
                           bodies.stiffness_times(q) -
                           joint_forces_on_nodes(bodies, result.reactions);
    const auto stress = [&](const std::vector<int>& nodes) {
      double sum = 0.0;
      for (const int node : nodes) sum += force(2 * node);
      return sum / assembly.height;
    };
    run.right.push_back(stress(assembly.right));
    run.left.push_back(-stress(assembly.left));
    for (std::size_t j = 0; j < joints; ++j) {
      const auto row = static_cast<Eigen::Index>(2 * j);
      if (step.broken[j] == 0 && result.states[j] != sim::JointState::stick) {
        step.broken[j] = 1;
        step.laws[j] = sim::broken_law(scene.joints.friction);
        run.broken_in[j] = i;
      }
      if (step.broken[j] != 0) step.held_at(row + 1) = result.gaps(row + 1);
    }
    step.states = result.states;
    step.gaps = result.gaps;
    step.reactions = result.reactions;
    step.force_scale = std::max(step.force_scale, result.reactions.norm());
  }
  return run;
}

}  // namespace havers::test
