// A run in time steps as it changes from step to step.
#pragma once

#include <memory>
#include <vector>

#include "sim/contact/joint_step.hpp"
#include "sim/dynamics/energy.hpp"
#include "sim/simulation.hpp"

namespace havers::sim {

/// The specimen in motion, at the end of a step of constant length (M3).
class DynamicRun {
 public:
  /// @param assembly  of the scene; it has to outlive the run
  /// @param step  h [s]
  DynamicRun(const Scene& scene, const Assembly& assembly, double step,
             const StopAsked& stop_asked = {});
  DynamicRun(const DynamicRun&) = delete;  // its solver knows its bodies
  DynamicRun& operator=(const DynamicRun&) = delete;

  /// One step on; false when the joints' problem was not solved, or its solver was stopped.
  bool advance();
  /// After two or more steps of uniform motion, whose reactions change linearly: on to one step
  /// before the first break or, where nothing is left out, to a whole number of steps before that.
  /// Returns the time from here to that step, 0 where the motion is another. [s]
  double leap();

  /// How many steps a time holds as a whole.
  [[nodiscard]] long whole_steps(double time) const { return static_cast<long>(time / h_); }

  /// The row of the last step; before the first, the start. Stresses are the machine's forces over
  /// the specimen's height.
  [[nodiscard]] CurvePoint point() const;
  /// The joints as they are after the last step.
  [[nodiscard]] const std::vector<JointOutcome>& outcomes() const { return joints_; }
  /// q, x and y of every node. [m]
  [[nodiscard]] const Eigen::VectorXd& displacements() const { return motion_.q; }
  /// Steps taken: what was leapt over has none.
  [[nodiscard]] int steps() const { return steps_; }
  /// Whether somebody asked to stop.
  [[nodiscard]] bool is_stopped() const { return stop_is_asked(step_.stop_asked); }
  /// Whether the first step had but one answer, as far as the solver tells.
  [[nodiscard]] bool determined() const { return steps_ > 0 || solver_->determined(); }
  /// Whether all of the motion is still a number.
  [[nodiscard]] bool finite() const { return motion_.q.allFinite() && motion_.v.allFinite(); }
  /// Fills in the last row's joints and displacements, and the checks.
  void finish(Simulation& simulation) const;

 private:
  // Of one step, in this order: what acts on it, its motion, forces and energies, what breaks.
  void prepare();
  void move(const JointStepResult& result);
  [[nodiscard]] double work_of_ties(const Eigen::VectorXd& tie_forces) const;
  void account(const JointStepResult& result, const Motion& before);
  void break_joints(const JointStepResult& result);
  // Products, not sums over the steps, which would add up rounding. [s], [-]
  [[nodiscard]] double time() const { return leapt_ + steps_ * h_; }
  [[nodiscard]] double strain() const {
    const double rate = scene_.loading.strain_rate;
    return rate * leapt_ + rate * steps_ * h_;
  }
  [[nodiscard]] double time_to_first_break() const;

  const Scene& scene_;
  const Assembly& assembly_;
  double h_;       // of every step [s]
  Bodies bodies_;  // with Ā of this step (S1)
  std::unique_ptr<JointSolver> solver_;
  Motion motion_;  // at the end of the last step, as are the joints
  std::vector<JointOutcome> joints_;
  JointStep step_;  // the joints' problem: the last answer, and the loads of the next step
  EnergyBalance energy_;
  Eigen::VectorXd slope_;                        // change of the reactions in the last step [N/m]
  double acceleration_force_ = 0.0;              // norm of M dv/h in the last step [N/m]
  double leapt_ = 0.0;                           // time that passed without steps [s]
  double force_right_ = 0.0, force_left_ = 0.0;  // of the machine on the specimen, along x [N/m]
  double worst_residual_ = 0.0;                  // (M11) [-]
  double worst_penetration_ = 0.0;               // [m]
  long iterations_ = 0;
  int steps_ = 0, broken_ = 0;
};

}  // namespace havers::sim
