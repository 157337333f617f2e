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
#include "sim/structure/disjoint_sets.hpp"

namespace havers::sim {

/// How the contact of an event is solved.
enum class Care : char {
  little,     ///< Digits as they come. From an event on that little effort does not solve: digits.
  digits,     ///< Every answer is refined: influences of joints on each other have few digits where
              ///< cracks are wide. All effort, at last without contact.
  all_effort  ///< Digits as they come, all effort, at last without contact.
};

/// The structure as it is between two events, at one strain. Its answer is proportional to that: it
/// is known from ε = 1.
class BreakingRun {
 public:
  /// The intact specimen, at strain 0.
  BreakingRun(const Scene& scene, std::shared_ptr<const IntactStructure> intact, Care care,
              const StopAsked& stop_asked = {});
  BreakingRun(const BreakingRun&) = delete;  // its parts know each other
  BreakingRun& operator=(const BreakingRun&) = delete;
  ~BreakingRun() = default;

  /// Takes away the joints that are missing from the start; false when no answer without them was
  /// found, or the search was stopped.
  bool take_missing();
  /// Joints that meet their cones together, and the strain at which they do.
  struct Event {
    double strain;  ///< It may be less than the present one; infinite when no joint ever will.
    std::vector<std::size_t> joints;
  };
  /// From what joints bear now: of all in single precision, of those that may be next exactly (S8).
  [[nodiscard]] Event next_event();
  /// Stretches on to a strain, never back; joints that slide rub while it grows.
  void stretch(double strain);
  /// Breaks joints, at the strain there is, and settles what is left; false when its contact has no
  /// solution that is found, or the search was stopped: then none has broken.
  bool break_joints(const std::vector<std::size_t>& breaking);

  /// Whether it takes a force to stretch it.
  [[nodiscard]] bool bears() const { return force_ != 0.0; }
  /// The row at the strain there is.
  [[nodiscard]] CurvePoint point() const;
  /// The joints, with what they bear and how far they are open by now.
  [[nodiscard]] std::vector<JointOutcome> outcomes() const;
  /// Of every node, x and y. A solve of the whole structure. [m]
  [[nodiscard]] Eigen::VectorXd displacements() const;
  /// Events so far whose contact found no solution.
  [[nodiscard]] int without_contact() const { return without_contact_; }
  /// That the specimen is the strongest so far where it is stretched to this event.
  void take_note_of_strength(const Event& event);
  /// Fills in the last row's joints and displacements, and the checks.
  void finish(Simulation& simulation);

 private:
  // Results: what is found of them on the way, and the checks at the end.
  void take_note_of_penetration();
  [[nodiscard]] double missed_at_strength(const UnitAnswer& exact) const;
  [[nodiscard]] double energy_defect(const UnitAnswer& exact, const Eigen::VectorXd& y) const;
  [[nodiscard]] double meets_cone_at(std::size_t joint, const Local& reaction) const {
    return strain_at_cone(reaction, laws_[joint], scene_.material.young, noise_);
  }
  // The search for the next event. What joints bear for E = 1 and ε = 1, and how wrong that is seen
  // to be. [N/m]
  struct Glance {
    Eigen::VectorXd reactions;
    double missed;  // as far as it is seen
  };
  [[nodiscard]] Glance glance() const;
  struct Candidate {
    double strain;  // at which it may break, not before
    std::size_t joint;
  };
  [[nodiscard]] std::vector<Candidate> may_be_next(const Eigen::VectorXd& reactions,
                                                   double missed) const;
  [[nodiscard]] Event first_of(std::vector<Candidate> candidates);
  // What one joint bears, exactly, for E = 1 and ε = 1. [N/m]
  [[nodiscard]] Local borne_at(std::size_t joint);
  // An event: joints come loose, holding at first; then all of these settle among themselves.
  void loosen(const std::vector<std::size_t>& breaking);
  bool settle();
  // Settles once more, from what was before and with more digits; or goes back to that.
  bool settle_with_care(const std::vector<JointState>& states_before,
                        const Eigen::VectorXd& gaps_before);
  void go_back_to(const Eigen::VectorXd& gaps_before);
  void take_back(const std::vector<std::size_t>& breaking, const Eigen::VectorXd& gaps_before);
  // Which bodies hang together, and which carry nothing as they hang on no end.
  [[nodiscard]] DisjointSets pieces() const;
  [[nodiscard]] bool has_detour(const Joint& broken) const;
  [[nodiscard]] std::vector<char> apart();
  [[nodiscard]] bool is_adrift(int joint) const;  // at a body that hangs on nothing
  [[nodiscard]] bool severed() const;
  [[nodiscard]] bool bears_nothing() const;
  // Of all joints: gaps, and what they bear; between these, what the loose joints' own problem
  // lacks of the whole structure's answer.
  [[nodiscard]] Eigen::VectorXd gaps(const Eigen::VectorXd& of_loose) const;
  [[nodiscard]] Eigen::VectorXd lacking() const;
  [[nodiscard]] Eigen::VectorXd all_reactions() const;
  [[nodiscard]] bool may_lose_digits() const;
  // Size of the terms in the loose joints' reactions: rounding grows with it. [N/m]
  [[nodiscard]] double summed() const;
  void follow_gaps();
  void see_all();
  void take_reference();
  void refine();
  // The contact of the loose joints, by a path or in any other way.
  LocalContactResult release(const StateSolution& known);
  LocalContactResult or_better(LocalContactResult result);

  const Scene& scene_;
  Care care_;
  bool glances_;  // else all is seen after every event
  std::shared_ptr<const IntactStructure> intact_;
  std::vector<JointOutcome> joints_;
  std::vector<JointLaw> laws_;  // of each while it is bonded; what has broken breaks no more
  double strain_ = 0.0;         // ε, the present one [-]
  double dissipated_ = 0.0;     // [J/m]
  // As it was in the row of the largest stress, to be checked at the end.
  struct Strongest {
    Event next;
    double force = 0.0;
    double residual = 0.0;  // worst_residual_ so far
    Eigen::VectorXd gaps;
  } strongest_;
  int broken_ = 0;
  bool unsolved_ = false;  // the last event was taken back
  int without_contact_ = 0;
  long iterations_ = 0;  // of the contact, in all events

  LooseJoints loose_;
  std::vector<IntactStructure::SharedColumn> columns_;  // of these, or of the first of them
  LocalContact contact_;                                // of the loose joints
  StateSystem system_{contact_};
  std::vector<char> adrift_;  // each body, when so many of the loose joints had broken:
  std::size_t joints_in_pieces_ = 0;
  Eigen::VectorXd extra_;  // cohesion that lets those just broken bear what they bore [N/m]
  Eigen::VectorXd y_;      // gaps of the loose joints [m per unit strain]
  // The intact structure, or the last one solved with its gaps: what changes is reckoned from it.
  UnitAnswer reference_;
  Eigen::VectorXd y_at_reference_;
  Eigen::VectorXd borne_;      // by the loose joints, for E = 1 and ε = 1 [N/m]
  Eigen::VectorXd reactions_;  // of all joints, likewise, with these gaps
  Eigen::VectorXd y_seen_;
  double summed_ = 0.0;             // when rounding was last looked at,
  double lacked_ = 0.0;             // and what it was [N/m]
  double force_;                    // likewise
  double joint_work_ = 0.0;         // r·u of the loose joints, likewise [N]
  double worst_residual_ = 0.0;     // of the law, over all answers, for E = 1 [N/m]
  double worst_penetration_ = 0.0;  // likewise, of the specimen [m]
  double noise_;                    // what rounding leaves on an unloaded joint is not a load
};

}  // namespace havers::sim
