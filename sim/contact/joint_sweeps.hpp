// Sweeps over all joints of a step, each solved alone: a solver of their own, and a way to find the
// states.
#pragma once

#include <array>
#include <vector>

#include "sim/contact/joint_step.hpp"

namespace havers::sim {

/// What one joint bears and does.
struct SingleJoint {
  Local reaction;  ///< [N/m]
  JointState state;
};

/// (C3) One joint alone, exactly: r = `free` + S u and the law for the gap u.
inline SingleJoint solve_single_joint(const Eigen::Matrix2d& S, const Local& free,
                                      const JointLaw& law) {
  // Without a gap it stays inside its cone.
  if (cone_margin(free, law) >= 0.0) return {free, JointState::stick};
  const double n = free.x() + law.cohesion, t = free.y();
  // With r at the tip, S u = (−n, −t): open where this gap is not negative.
  if (S(0, 1) * t >= S(1, 1) * n) return {{-law.cohesion, 0.0}, JointState::open};
  // Closed and on the cone, r_T = −slope (r_N + c): of the two ways the one whose slip has its
  // sign.
  SingleJoint slipped{};
  for (const JointState way : {JointState::slip_forward, JointState::slip_backward}) {
    const double slope = slip_sign(way) * law.friction;
    const double slip = -(t + slope * n) / (S(1, 1) + slope * S(0, 1));
    slipped = {free + slip * S.col(1), way};
    if (slip_sign(way) * slip >= 0.0) break;
  }
  return slipped;
}

/// Keeps the bodies' answers to forces at their ports. The ties are n − 1 equations between
/// neighbouring ones, solved in turn like the joints.
class JointSweeps {
 public:
  explicit JointSweeps(const Bodies& bodies);

  /// Starts from given reactions of the joints and forces of the ties, if any. [N/m]
  void start(const JointStep& step, Eigen::VectorXd reactions, const Eigen::VectorXd& tie_forces);
  /// One sweep; returns whether a joint's state changed.
  /// @param relaxation  of a joint's change what is made, below 2; above 1: over-relaxed [-]
  /// @param negligible  changes of the forces on both its bodies, since it was solved, up to which
  /// a joint is left as it is [N/m]
  bool sweep(const JointStep& step, double relaxation = 1.0, double negligible = 0.0);

  [[nodiscard]] const Eigen::VectorXd& reactions() const { return reactions_; }  ///< [N/m]
  [[nodiscard]] const std::vector<JointState>& states() const { return states_; }
  [[nodiscard]] Eigen::VectorXd tie_forces() const;                 ///< [N/m]
  [[nodiscard]] Eigen::VectorXd gaps(const JointStep& step) const;  ///< [m]
  /// How far the ties' points are from the height that they should share, all together. [m]
  [[nodiscard]] double tie_gap() const;
  [[nodiscard]] Eigen::VectorXd displacements(const JointStep& step) const;  ///< δ. [m]

 private:
  /// What one joint needs: its ports (normal, tangential) on either side, and 1/W.
  struct Contact {
    std::array<Eigen::Index, 2> ports_a{}, ports_b{};
    int body_a = 0, body_b = 0;
    Eigen::Matrix2d stiffness;  ///< (W_aa + W_bb)⁻¹. [N/m²]
  };
  /// Two neighbouring ties: top and bottom port of either.
  struct TieEquation {
    std::array<Eigen::Index, 4> ports{};
    std::array<int, 4> bodies{};
    double compliance = 0.0;  ///< [m²/N]
  };

  // Once for all steps:
  void find_contacts();
  void pair_ties();
  // How far a unit force at one port of a body moves another one; ports are numbered over all
  // bodies. [m²/N]
  [[nodiscard]] double answer(int body, Eigen::Index row, Eigen::Index column) const;
  // Applies two forces to a body, which move all of its ports.
  void push(int body, std::array<Eigen::Index, 2> ports, const Local& force);
  // Height of a tie less that of the next one. [m]
  [[nodiscard]] double opening(const TieEquation& tie) const;
  // Of joints and ties, at all ports. [N/m]
  [[nodiscard]] Eigen::VectorXd port_forces() const;

  const Bodies* bodies_;
  std::vector<Eigen::MatrixXd> inverses_;      // Ā⁻¹ of each class, zero where held
  std::vector<Eigen::MatrixXd> port_answers_;  // B Ā⁻¹ Bᵀ of each class
  std::vector<std::size_t> class_of_;          // of each body
  std::vector<Contact> contacts_;
  std::vector<TieEquation> ties_;
  Eigen::VectorXd reactions_, between_ties_;  // forces of joints and of tie equations
  Eigen::VectorXd p_;                         // port displacements
  std::vector<JointState> states_;
  Eigen::VectorXd unrest_;   // of each body: changes of its forces that its joints have not felt
  std::vector<char> moves_;  // the bodies whose joints are solved
};

}  // namespace havers::sim
