// Non-smooth Gauss-Seidel over all joints, bonded or not: what other codes do, for comparison and
// for small steps.
#pragma once

#include "sim/contact/joint_sweeps.hpp"

namespace havers::sim {

/// One joint at a time, the others held [Jean99]. Wins below h c/L = 0.1; needs very many sweeps
/// above 1 (M10).
class GaussSeidelSolver : public JointSolver {
 public:
  /// @param tolerance  largest residual (M11) of an answer [-]
  /// @param max_sweeps  in one step
  GaussSeidelSolver(const Bodies& bodies, double tolerance, int max_sweeps);
  /// Starts from the last step's reactions. Not converged where `max_sweeps` do not suffice.
  JointStepResult solve(const JointStep& step) override;

 private:
  double tolerance_;
  int max_sweeps_;
  JointSweeps sweeps_;
  Eigen::VectorXd stiffness_;  // of each joint, for residuals [N/m²]
};

}  // namespace havers::sim
