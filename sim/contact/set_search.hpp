// Steps in which many joints move: sets of states, each one sparse factor, with sweeps in between.
#pragma once

#include <optional>

#include "sim/contact/joint_sweeps.hpp"

namespace havers::sim {

/// Every set of states is a structure that holds what sticks, slides along what slips and leaves
/// what is open (S5); the friction of sliding joints comes by the corrections of (S6). Where an
/// answer breaks the law of a joint, sweeps over all joints (C5) say which set to take next. Sweeps
/// see one joint's neighbours, a factor sees all: together they are quick while h c/L is not large.
class SetSearch {
 public:
  explicit SetSearch(const Bodies& bodies);

  /// `converged` is false where a handful of sets did not do; the answer is then worthless.
  /// @param nearest  Whether to sweep longer for the answer nearest to the last step's, as friction
  /// may leave several.
  JointStepResult solve(const JointStep& step, bool nearest);

 private:
  // Lets the structure hold what a set of states holds.
  void take(const std::vector<JointState>& states);
  // The set's own answer, its forces to the accuracy; converged where it keeps every joint's law.
  void answer(const JointStep& step, double accuracy, JointStepResult& result);
  // Whether the result's states solve the step; the result is complete then.
  bool settles(const JointStep& step, JointStepResult& result);
  // @param most  changes that an answer may ask for
  bool settles_nearby(const JointStep& step, std::size_t most, JointStepResult& result);
  // The states that the law gives joints with an answer.
  [[nodiscard]] std::vector<JointState> lawful(const JointStep& step, const JointStepResult& result,
                                               double accuracy) const;
  // Sweeps until states rest or for too long, both `patience` times as long as usual; `far`:
  // over-relaxed, and without joints that hardly feel a change.
  int look_for_states(const JointStep& step, int patience, bool far,
                      std::vector<JointState>& states);

  const Bodies* bodies_;
  JointSweeps sweeps_;
  std::optional<Structure> structure_;       // of the last set
  StructureResponse last_{.residual = 1.0};  // answer, where the next one starts
  std::vector<JointState> lawful_;           // by the last answer
  Eigen::VectorXd stiffness_;                // of each joint, for residuals [N/m²]
  std::ptrdiff_t broken_ = 0;                // joints, when its set was last tried
};

}  // namespace havers::sim
