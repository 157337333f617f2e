// The few joints that may move, after everything bonded has been condensed: a small dense contact
// problem.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "sim/joint/cohesive_cone.hpp"
#include "sim/stop_asked.hpp"

namespace havers::sim {

/// What a joint does in the solution of a step.
enum class JointState { stick, slip_forward, slip_backward, open };

/// Sign of the slip; 0 where there is none, or no friction. The friction is −sign μ (R_N + c).
inline double slip_sign(JointState state) {
  if (state == JointState::slip_forward) return 1.0;
  return state == JointState::slip_backward ? -1.0 : 0.0;
}

/// Find y with r = r₀ + S y and the joint law at every joint, gaps being u = u₀ + y (C1),
/// sim/README.md.
struct LocalContact {
  Eigen::MatrixXd S;           ///< Reactions to unit gaps, 2n × 2n, symmetric ≥ 0. [N/m²]
  Eigen::VectorXd r0;          ///< Reactions at y = 0, 2n. [N/m]
  Eigen::VectorXd u0;          ///< Gap, and slip since the last step (the start, in the
                               ///< limit), at y = 0, 2n. [m]
  std::vector<JointLaw> laws;  ///< n.
  std::vector<char>
      apart{};  ///< 1 for a joint that stays open whatever its gap; n, or empty for none.
  /// A piece that hangs on nothing leaves equations singular: this part of the largest stiffness
  /// holds it. A long strip beside a crack bends as softly as 1e-8 of that, so it has to be less.
  /// In long steps inertia holds pieces by 1e-11, and has to be what decides. [-]
  double trace = 1e-11;
  /// What forces err by is compared to r₀, but to no less than this: where nothing bears, r₀ is
  /// rounding. [N/m]
  double force_scale = 0.0;
  /// Asked on every path; a search that is stopped has not converged.
  StopAsked stop_asked{};

  /// Of a gap; that of a body that hangs on one joint costs nothing, but for rounding. [N/m²]
  [[nodiscard]] double stiffness(Eigen::Index row) const {
    return std::max(S(row, row), std::numeric_limits<double>::min());
  }
  [[nodiscard]] bool is_apart(std::size_t joint) const {
    return !apart.empty() && apart[joint] != 0;
  }
};

/// An answer where it is converged; else what was looked at last.
struct LocalContactResult {
  bool converged = false;
  Eigen::VectorXd y;               ///< 2n. [m]
  std::vector<JointState> states;  ///< n.
  int iterations = 0;              ///< Sets tried, and branches of paths.
};

/// Norm of the law's natural map (M11) over the joints that are not apart, for reactions [N/m] and
/// gaps [m]. [N/m]
double law_missed(const LocalContact& problem, const Eigen::VectorXd& reactions,
                  const Eigen::VectorXd& gaps);

/// That of an answer, relative to the free reactions, and below what the law counts as met. [-]
double law_residual_of(const LocalContact& problem, const Eigen::VectorXd& y);
constexpr double law_is_met = 1e-10;

/// Which state a joint belongs in.
/// @param gap  times a stiffness, so that it is a force as well
/// @param scale  a force: less than 1e-12 of it is rounding. [N/m]
JointState state_of(const Local& reaction, const Local& gap, JointState now, const JointLaw& law,
                    double scale);

/// What is done before a problem counts as not solved.
enum class Effort : char {
  little,  ///< Two paths: where another solver may be quicker than more of them.
  all
};

/// Active set started from `states`: each set is one linear solve (C2). Where sets do not lead to
/// each other, homotopies (C4), at last with springs (C7).
LocalContactResult solve_local_contact(const LocalContact& problem,
                                       const std::vector<JointState>& states,
                                       Effort effort = Effort::all);

}  // namespace havers::sim
