// What a breaking sequence shows of itself: rows of the curve, joints, displacements, checks.
#include <algorithm>
#include <cmath>

#include "sim/joint/cohesive_cone.hpp"
#include "sim/outcome.hpp"
#include "sim/quasi_static/breaking_run.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

// ½qᵀKq = ½ (F W ε + r·u).
CurvePoint BreakingRun::point() const {
  const Assembly& assembly = intact_->assembly();
  // In equilibrium: both ends bear the same.
  const double stress = scene_.material.young * force_ * strain_ / assembly.height;
  return {.time = strain_ / scene_.loading.strain_rate,
          .strain = strain_,
          .stress_right = stress,
          .stress_left = stress,
          .broken_joints = broken_,
          .elastic = 0.5 * strain_ *
                     (stress * assembly.width * assembly.height +
                      scene_.material.young * strain_ * joint_work_),
          .dissipated = dissipated_};
}

// Not where pieces touch whose position is not determined; where an event was left without contact.
void BreakingRun::take_note_of_penetration() {
  for (std::size_t i = 0; i < loose_.size(); ++i)
    if (!is_adrift(loose_.joints()[i]))
      worst_penetration_ = std::max(worst_penetration_, -strain_ * y_(2 * static_cast<Index>(i)));
}

std::vector<JointOutcome> BreakingRun::outcomes() const {
  std::vector<JointOutcome> outcomes = joints_;
  const VectorXd reactions = all_reactions();
  const double young = scene_.material.young;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    outcomes[j].reaction_normal = young * strain_ * reactions(row);
    outcomes[j].reaction_tangent = young * strain_ * reactions(row + 1);
  }
  for (std::size_t i = 0; i < loose_.size(); ++i) {
    const int joint = loose_.joints()[i];
    const double gap = strain_ * y_(2 * static_cast<Index>(i));
    // A piece that hangs on nothing lies in one of many places: in none where it overlaps.
    outcomes[static_cast<std::size_t>(joint)].gap = is_adrift(joint) ? std::max(gap, 0.0) : gap;
  }
  return outcomes;
}

VectorXd BreakingRun::displacements() const {
  return strain_ * intact_->stretch(gaps(y_)).displacements;
}

void BreakingRun::take_note_of_strength(const Event& event) {
  strongest_ = {event, force_, worst_residual_, y_};
}

// What a run says of its strength, against the whole structure with the gaps it had there.
double BreakingRun::missed_at_strength(const UnitAnswer& exact) const {
  if (strongest_.gaps.size() == 0 || strongest_.force == 0.0) return 0.0;  // known
  double missed = std::abs(strongest_.force / exact.force - 1.0);
  // The strain is checked as well, by that at which the whole structure would have broken the next
  // joints.
  for (const std::size_t j : strongest_.next.joints) {
    const double strain =
        strain_at_cone(of_joint(exact.reactions, j), intact_law(joints_[j].threshold),
                       scene_.material.young, noise_);
    missed = std::max(missed, std::abs(strongest_.next.strain / strain - 1.0));
  }
  return missed;
}

// Of ½ qᵀKq = ½ (F W ε + r·u), relative.
double BreakingRun::energy_defect(const UnitAnswer& exact, const VectorXd& y) const {
  const double work =
      0.5 * (exact.force * intact_->assembly().width + exact.reactions.dot(gaps(y)));
  return std::abs(intact_->energy(exact.displacements) / work - 1.0);
}

// What events computed is checked against whole structures: that at the strength, and the last one.
void BreakingRun::finish(Simulation& simulation) {
  const UnitAnswer& intact = intact_->answer();
  const double scale = intact.reactions.norm(), force = force_;
  // The force stays that of the last row: how much refining changes it is one of the checks below.
  if (!unsolved_) {
    refine();
    if (y_ != y_at_reference_) take_reference();
    force_ = force;
    worst_residual_ = worse(worst_residual_, law_missed(contact_, borne_, y_));
  }
  const UnitAnswer& last = reference_;
  reactions_ = last.reactions;
  simulation.displacements = strain_ * last.displacements;
  simulation.joints = outcomes();
  take_note_of_penetration();
  simulation.worst_penetration = worst_penetration_;
  const bool is_intact = strongest_.gaps.size() == 0;
  const UnitAnswer strongest = is_intact ? intact : intact_->stretch(gaps(strongest_.gaps));
  if (strongest_.force != 0.0 && !(is_intact && intact_->stress_is_known()))
    simulation.energy_defect = energy_defect(strongest, strongest_.gaps);
  simulation.rounding_error = missed_at_strength(strongest);
  const auto part_of = [](double value, double whole) { return whole > 0.0 ? value / whole : 0.0; };
  simulation.residual_to_strength =
      worse(worse(intact.residual, strongest.residual), part_of(strongest_.residual, scale));
  simulation.worst_residual =
      worse(worse(simulation.residual_to_strength, last.residual),
            worse(part_of(worst_residual_, scale),
                  bears() ? std::abs(last.force - force_) / intact.force : 0.0));
  simulation.iterations = iterations_;
  simulation.events_without_contact = without_contact_;
}

}  // namespace havers::sim
