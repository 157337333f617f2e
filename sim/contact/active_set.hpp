// The direct joint solver: bonded joints by one sparse factor, the few others by an active set.
#pragma once

#include <vector>

#include "sim/contact/joint_step.hpp"
#include "sim/contact/local_contact.hpp"
#include "sim/contact/loose_joints.hpp"
#include "sim/contact/set_search.hpp"

namespace havers::sim {

/// Everything bonded is one triangular solve (S5). A few joints that move are loosened one by one
/// and solved among themselves (C1); where many bear or leave the bonded state, or friction may
/// leave several answers, sets are searched with a factor each (C5). Joints that opened are
/// detached from the factor until they close: what is loose or detached changes the cost, not the
/// answer where there is but one.
class ActiveSetSolver : public JointSolver {
 public:
  /// @param detach_open  false: broken joints stay in the factor for good (section 7, for
  /// comparison).
  explicit ActiveSetSolver(const Bodies& bodies, bool detach_open = true);
  /// Several ways in turn, the cheap ones first, until one has an answer.
  JointStepResult solve(const JointStep& step) override;
  /// Whether the factor of what is bonded has its pivots (S7).
  [[nodiscard]] bool determined() const override { return structure_.ok(); }

 private:
  // A new factor without the joints that have opened, where they are many.
  void detach_opened(const JointStep& step);
  // What was known of loose joints is lost with the old factor.
  void rebuild(std::vector<Held> held);
  [[nodiscard]] bool detached(int joint) const {
    return structure_.held()[static_cast<std::size_t>(joint)] == Held::not_at_all;
  }
  // By sets (C5). Where open joints are not to be detached, solve_loose goes on from the states
  // found.
  JointStepResult search(const JointStep& step, bool nearest);
  // Solves for the loose joints among themselves (C1), and adds those that the answer overloads.
  JointStepResult solve_loose(const JointStep& step, Effort effort, std::size_t most_leave);
  // For StructureLoads: of every joint, beyond what is predicted. [m]
  [[nodiscard]] Eigen::VectorXd jumps(const JointStep& step) const;
  // y are the loose joints' gaps beyond those of the last step. [m]
  bool settle_loose(const JointStep& step, const Eigen::VectorXd& bonded_reactions, Effort effort,
                    JointStepResult& result, Eigen::VectorXd& y) const;
  std::vector<int> violated(const JointStep& step, const Eigen::VectorXd& reactions,
                            JointStepResult& result) const;
  // Whether some detached joints overlap; they are then loose ones of a new factor.
  bool reattach_closed(const JointStepResult& result);

  bool detach_open_;
  bool sweeps_are_quick_;  // inertia is more than a small part of the stiffness
  bool may_search_;        // sweeps lead nowhere where inertia is but a trace
  Structure structure_;    // holds all but the joints that have opened
  LooseJoints loose_;
  SetSearch search_;
  Eigen::VectorXd stiffness_;  // of each joint, for residuals [N/m²]
};

}  // namespace havers::sim
