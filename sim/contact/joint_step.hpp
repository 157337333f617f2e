// The joints' problem of one time step, and what a solver answers.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/contact/local_contact.hpp"
#include "sim/structure/structure.hpp"

namespace havers::sim {

/// Find δ with Ā δ = g + Hᵀ r, the given displacements on the sides, the ties, and every joint's
/// law for the gaps H(q + h v) + H δ. Vectors over joints hold (normal, tangential) of each.
struct JointStep {
  Eigen::VectorXd forces;      ///< g. [N/m]
  Eigen::VectorXd prescribed;  ///< δ of the held degrees of freedom. [m]
  Eigen::VectorXd predicted;   ///< H(q + h v). [m]
  Eigen::VectorXd gaps;        ///< At the last step. [m]
  Eigen::VectorXd held_at;     ///< Gap and slip at which a sticking joint is held: (0, slip of the
                               ///< last step once it is broken). [m]
  std::vector<JointLaw> laws;
  std::vector<char> broken;        ///< 1 for a joint whose cohesion is gone.
  std::vector<JointState> states;  ///< Of the last step: where a solver starts.
  Eigen::VectorXd reactions;       ///< Of the last step. [N/m]
  Eigen::VectorXd tie_forces;      ///< Likewise; empty before the first. [N/m]
  double force_scale = 0.0;        ///< Largest norm of the reactions so far. [N/m]
  StopAsked stop_asked{};          ///< A solver that is stopped has not converged.
};

/// An answer, or how far a solver came.
struct JointStepResult {
  bool converged = false;
  Eigen::VectorXd displacements;  ///< δ. [m]
  Eigen::VectorXd reactions;      ///< r. [N/m]
  Eigen::VectorXd tie_forces;     ///< Of every tie, pushing its top point up. [N/m]
  Eigen::VectorXd gaps;           ///< Total, at the end of the step. [m]
  std::vector<JointState> states;
  long iterations = 0;    ///< As the solver counts them: sets, branches, sweeps, solves.
  double residual = 0.0;  ///< (M11). [-]
};

/// A way to solve the joints' problem. Keeps what it can reuse from step to step.
class JointSolver {
 public:
  JointSolver() = default;
  JointSolver(const JointSolver&) = delete;
  JointSolver& operator=(const JointSolver&) = delete;
  virtual ~JointSolver() = default;
  /// Not converged: no answer was found, or the solver was stopped.
  virtual JointStepResult solve(const JointStep& step) = 0;
  /// Whether there is but one set of reactions, as far as the method tells.
  [[nodiscard]] virtual bool determined() const { return true; }
};

/// Relative displacements u_b − u_a at the joints. [m]
Eigen::VectorXd joint_gaps(const Bodies& bodies, const Eigen::VectorXd& q);

/// Hᵀ r. [N/m]
Eigen::VectorXd joint_forces_on_nodes(const Bodies& bodies, const Eigen::VectorXd& reactions);

/// A stiffness for each joint: the force that a unit error of its gap would cause in its two
/// bodies. [N/m²]
Eigen::VectorXd joint_stiffness(const Bodies& bodies);

/// (M11): norm of the law's natural-map residual over the joints, relative to the reactions.
/// Unit-invariant, and judged by force: a gap that is wrong counts by the force it would cause. [-]
double joint_residual(const JointStep& step, const JointStepResult& result,
                      const Eigen::VectorXd& stiffness);

}  // namespace havers::sim
