// The structure of a breaking sequence as it changes from event to event.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sim/contact/local_contact.hpp"
#include "sim/contact/loose_joints.hpp"
#include "sim/contact/state_system.hpp"
#include "sim/quasi_static/intact_structure.hpp"
#include "sim/simulation.hpp"

namespace havers::sim {

/// The structure as it is between two events. Its answer is proportional to the strain: it is known
/// from ε = 1.
class BreakingRun {
 public:
  /// @param careful  refines every answer: influences of joints on each other have few digits
  /// where cracks are wide
  BreakingRun(const Scene& scene, std::shared_ptr<const IntactStructure> intact, bool careful);

  /// Strain at which the next joints meet their cones; infinite when none ever will.
  [[nodiscard]] double next_event() const;
  /// Breaks all joints that have met their cones at `event`; `strain` is that of the specimen by
  /// then.
  void break_joints(double event, double strain);
  /// Takes away the joints that are missing from the start; whether there are any.
  bool take_missing();
  /// Solves the changed structure for ε = 1, broken joints pressed together included (M7).
  bool settle();

  /// Accounts for the friction of joints that slide while the strain grows.
  void stretch(double from, double to);
  [[nodiscard]] CurvePoint point(double strain) const;
  /// The joints, with what they bear and how far they are open by now.
  [[nodiscard]] std::vector<JointOutcome> outcomes(double strain) const;
  [[nodiscard]] Eigen::VectorXd displacements(double strain) const;
  /// Fills in the last row's joints and displacements, and the checks.
  void finish(double strain, double energy_scale, Simulation& simulation);

 private:
  void take_note_of_penetration(double strain);
  [[nodiscard]] double meets_cone_at(std::size_t joint) const;
  void loosen(const std::vector<std::size_t>& breaking);
  [[nodiscard]] std::vector<char> apart() const;
  [[nodiscard]] Eigen::VectorXd gaps() const;
  [[nodiscard]] Eigen::VectorXd reactions_to(const Eigen::VectorXd& y) const;
  [[nodiscard]] Eigen::VectorXd of_loose(const Eigen::VectorXd& of_all) const;
  [[nodiscard]] Eigen::VectorXd lacking(const Eigen::VectorXd& reactions) const;
  void refine();
  LocalContactResult or_better(LocalContactResult result);

  const Scene& scene_;
  bool careful_;
  std::shared_ptr<const IntactStructure> intact_;
  LooseJoints loose_;
  std::vector<IntactStructure::Column> columns_;  // of the loose joints; none where they are many
  LocalContact contact_;                          // of the loose joints
  StateSystem system_{contact_};
  Eigen::VectorXd extra_;  // cohesion that lets those just broken bear what they bore [N/m]
  Eigen::VectorXd y_;      // gaps of the loose joints [m per unit strain]
  // The intact structure, or the last refined answer: what changes is reckoned from it.
  UnitAnswer reference_;
  Eigen::VectorXd y_at_reference_;
  Eigen::VectorXd reactions_;       // for E = 1 and ε = 1 [N/m]
  double force_;                    // likewise
  double joint_work_ = 0.0;         // r·u of the loose joints, likewise [N]
  double worst_residual_ = 0.0;     // of the law, over all answers, for E = 1 [N/m]
  double worst_penetration_ = 0.0;  // likewise, of the specimen [m]
  double noise_;                    // what rounding leaves on an unloaded joint is not a load

 public:
  std::vector<JointOutcome> joints;
  double dissipated = 0.0;  // [J/m]
  long iterations = 0;
  int broken = 0;
  int without_contact = 0;  // events whose contact found no solution
};

}  // namespace havers::sim
