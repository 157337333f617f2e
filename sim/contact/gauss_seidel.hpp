// Non-smooth Gauss-Seidel over all joints, bonded or not: what other codes do, for comparison and
// for small steps.
#pragma once

#include <array>

#include "sim/contact/joint_step.hpp"

namespace havers::sim {

/// One joint at a time, the others held [Jean99]. Wins below h c/L = 0.1; needs very many sweeps
/// above 1 (M10). The ties are n − 1 equations between neighbouring ones, solved in turn like the
/// joints.
class GaussSeidelSolver : public JointSolver {
 public:
  GaussSeidelSolver(const Bodies& bodies, double tolerance, int max_sweeps);
  JointStepResult solve(const JointStep& step) override;

 private:
  /// What one joint needs: its ports (side a: normal, tangential; side b likewise) and 1/W.
  struct Contact {
    std::array<Eigen::Index, 4> ports{};
    int body_a = 0, body_b = 0;
    Eigen::Matrix2d stiffness;  ///< (W_aa + W_bb)⁻¹. [N/m²]
  };
  /// Two neighbouring ties: top and bottom port of either.
  struct TieEquation {
    std::array<Eigen::Index, 4> ports{};
    std::array<int, 4> bodies{};
    double compliance = 0.0;  ///< [m²/N]
  };

  void find_contacts();
  void sweep(const JointStep& step, Eigen::VectorXd& p);
  void push(int body, Eigen::Index port, double force, Eigen::VectorXd& p) const;
  [[nodiscard]] Eigen::VectorXd displacements(const JointStep& step,
                                              const Eigen::VectorXd& port_forces) const;
  [[nodiscard]] Eigen::VectorXd port_forces() const;
  [[nodiscard]] double tie_error(const Eigen::VectorXd& p) const;

  const Bodies* bodies_;
  double tolerance_;
  int max_sweeps_;
  std::vector<Eigen::MatrixXd> inverses_;      // Ā⁻¹ of each class, zero where held
  std::vector<Eigen::MatrixXd> port_answers_;  // B Ā⁻¹ Bᵀ of each class
  std::vector<std::size_t> class_of_;          // of each body
  std::vector<Contact> contacts_;
  std::vector<TieEquation> ties_;
  Eigen::VectorXd reactions_, tie_forces_;  // of the last step, where the next one starts
  Eigen::VectorXd stiffness_;
};

}  // namespace havers::sim
