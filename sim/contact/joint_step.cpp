// What the solvers of the joints' problem share: gaps, forces, and how an answer is judged (M11).
#include "sim/contact/joint_step.hpp"

#include <algorithm>
#include <cmath>

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd joint_gaps(const Bodies& bodies, const VectorXd& q) {
  return bodies.gaps(bodies.port_displacements(q));
}

VectorXd joint_forces_on_nodes(const Bodies& bodies, const VectorXd& reactions) {
  return bodies.port_forces_on_nodes(bodies.forces_of_joints(reactions));
}

// Of each joint the largest entry of Z's diagonal, over components and sides; unknowns beyond those
// of joints are of ties.
VectorXd joint_stiffness(const Bodies& bodies) {
  VectorXd stiffness = VectorXd::Zero(static_cast<Index>(bodies.assembly().joints.size()));
  for (const BodyClass& group : bodies.classes())
    for (const int body : group.bodies)
      for (Index i = 0; i < group.op.impedance.rows(); ++i) {
        const int unknown =
            bodies.ports()[static_cast<std::size_t>(bodies.first_port(body) + i)].unknown;
        if (unknown < 2 * stiffness.size())
          stiffness(unknown / 2) = std::max(stiffness(unknown / 2), group.op.impedance(i, i));
      }
  return stiffness;
}

double joint_residual(const JointStep& step, const JointStepResult& result,
                      const VectorXd& stiffness) {
  double squared = 0.0;
  for (std::size_t j = 0; j < step.laws.size(); ++j) {
    const Local gap = of_joint(result.gaps, j) - of_joint(step.held_at, j);
    squared += law_residual(of_joint(result.reactions, j), gap, step.laws[j],
                            stiffness(static_cast<Index>(j)))
                   .squaredNorm();
  }
  // Where no joint bears anything and the law is kept, the residual is 0 and not 0/0.
  const double scale = std::max(step.force_scale, result.reactions.norm());
  return squared == 0.0 ? 0.0 : std::sqrt(squared) / std::max(scale, 1e-300);
}

}  // namespace havers::sim
