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
  JointStepResult solve(const JointStep& step) override;
  [[nodiscard]] bool determined() const override { return structure_.ok(); }

 private:
  void detach_opened(const JointStep& step);
  void rebuild(std::vector<Held> held);
  [[nodiscard]] bool detached(int joint) const {
    return structure_.held()[static_cast<std::size_t>(joint)] == Held::not_at_all;
  }
  JointStepResult search(const JointStep& step, bool nearest);
  JointStepResult solve_loose(const JointStep& step, Effort effort, std::size_t most_leave);
  [[nodiscard]] Eigen::VectorXd jumps(const JointStep& step) const;
  bool settle_loose(const JointStep& step, const Eigen::VectorXd& bonded_reactions, Effort effort,
                    JointStepResult& result, Eigen::VectorXd& y) const;
  std::vector<int> violated(const JointStep& step, const Eigen::VectorXd& reactions,
                            JointStepResult& result) const;
  bool reattach_closed(const JointStepResult& result);

  bool detach_open_;
  bool sweeps_are_quick_;
  bool may_search_;      // sweeps lead nowhere where inertia is but a trace
  Structure structure_;  // holds all but the joints that have opened
  LooseJoints loose_;
  SetSearch search_;
  Eigen::VectorXd stiffness_;
};

}  // namespace havers::sim
