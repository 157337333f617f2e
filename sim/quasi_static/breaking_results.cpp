// What a breaking sequence shows of itself: rows of the curve, joints, displacements, checks.
#include <algorithm>
#include <cmath>

#include "sim/quasi_static/breaking_run.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

// ½qᵀKq = ½ (F W ε + r·u).
CurvePoint BreakingRun::point(double strain) const {
  const Assembly& assembly = intact_->assembly();
  const double stress = scene_.material.young * force_ * strain / assembly.height;
  return {.time = strain / scene_.loading.strain_rate,
          .strain = strain,
          .stress_right = stress,
          .stress_left = stress,
          .broken_joints = broken,
          .elastic = 0.5 * strain *
                     (stress * assembly.width * assembly.height +
                      scene_.material.young * strain * joint_work_),
          .dissipated = dissipated};
}

void BreakingRun::take_note_of_penetration(double strain) {
  for (Index i = 0; i < y_.size(); i += 2)
    worst_penetration_ = std::max(worst_penetration_, -strain * y_(i));
}

std::vector<JointOutcome> BreakingRun::outcomes(double strain) const {
  std::vector<JointOutcome> outcomes = joints;
  const double young = scene_.material.young;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    outcomes[j].reaction_normal = young * strain * reactions_(row);
    outcomes[j].reaction_tangent = young * strain * reactions_(row + 1);
  }
  for (std::size_t i = 0; i < loose_.size(); ++i)
    outcomes[static_cast<std::size_t>(loose_.joints()[i])].gap =
        strain * y_(2 * static_cast<Index>(i));
  return outcomes;
}

VectorXd BreakingRun::displacements(double strain) const {
  return strain * intact_->stretch(gaps()).displacements;
}

// What events computed is checked against the refined answer, ½ qᵀKq = ½ (F W ε + r·u) too.
void BreakingRun::finish(double strain, double energy_scale, Simulation& simulation) {
  const double scale = intact_->answer().reactions.norm();
  refine();
  const UnitAnswer& last = reference_;
  reactions_ = last.reactions;
  simulation.displacements = strain * last.displacements;
  simulation.joints = outcomes(strain);
  take_note_of_penetration(strain);
  simulation.worst_penetration = worst_penetration_;
  const double elastic = intact_->energy(last.displacements);
  const double work = 0.5 * (last.force * intact_->assembly().width + last.reactions.dot(gaps()));
  if (energy_scale > 0.0)
    simulation.energy_defect =
        scene_.material.young * strain * strain * std::abs(elastic - work) / energy_scale;
  simulation.worst_residual =
      std::max({simulation.worst_residual, intact_->answer().residual, last.residual,
                worst_residual_ / scale, law_missed(contact_, of_loose(last.reactions), y_) / scale,
                std::abs(last.force - force_) / intact_->answer().force});
  simulation.iterations = iterations;
}

}  // namespace havers::sim
