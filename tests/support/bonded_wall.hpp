// One step of a wall in uniform stress: what solvers are timed with.
#pragma once

#include <cmath>

#include "sim/contact/joint_step.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/simulation.hpp"

namespace havers::test {

inline sim::Scene wall(int layers, int fibres, sim::Lateral lateral = sim::Lateral::periodic) {
  sim::Scene scene;
  scene.assembly.layers = layers;
  scene.assembly.fibres = fibres;
  scene.loading.lateral = lateral;
  return scene;
}

/// h of a given h c/L. [s]
inline double step_of(const sim::Scene& scene, double size) {
  return size * scene.assembly.fibre_length /
         std::sqrt(scene.material.young / scene.material.density);
}

/// A wall stretched uniformly, and its next step.
struct WallStep {
  sim::Assembly assembly;
  sim::Bodies bodies;
  sim::JointStep step;

  WallStep(const WallStep&) = delete;  // bodies point to the assembly
  WallStep& operator=(const WallStep&) = delete;
  WallStep(const sim::Scene& scene, double strain, double h)
      : assembly(sim::build_assembly(scene.assembly, scene.loading.lateral)),
        bodies(assembly, scene.material, {1.0 / (h * h), 1.0}) {
    const auto rows = static_cast<Eigen::Index>(2 * assembly.joints.size());
    Eigen::VectorXd u(bodies.dofs());  // the field of unit strain
    for (std::size_t i = 0; i < assembly.nodes.size(); ++i)
      u.segment<2>(static_cast<Eigen::Index>(2 * i)) << assembly.nodes[i].x(),
          -scene.material.poisson * assembly.nodes[i].y();
    step.forces = -strain * bodies.stiffness_times(u);
    step.prescribed = Eigen::VectorXd::Zero(bodies.dofs());
    step.predicted = step.gaps = step.held_at = step.reactions = Eigen::VectorXd::Zero(rows);
    step.broken.assign(assembly.joints.size(), 0);
    step.states.assign(assembly.joints.size(), sim::JointState::stick);
    for (const sim::Threshold& threshold : sim::draw_thresholds(scene, assembly))
      step.laws.push_back(sim::intact_law(threshold));
  }
};

}  // namespace havers::test
