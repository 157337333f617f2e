// The bodies held together by their bonded joints, solved directly whatever the step size.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "sim/structure/bodies.hpp"
#include "sim/structure/cholesky.hpp"

namespace havers::sim {

/// What of a joint a structure holds.
enum class Held : char {
  fully,
  normal,  ///< It slides: only the normal displacement is shared.
  not_at_all
};

/// What acts on a structure. Vectors over degrees of freedom, and over joints (normal, tangential
/// of each).
struct StructureLoads {
  Eigen::VectorXd forces;  ///< g, at every degree of freedom. [N/m]
  Eigen::VectorXd
      prescribed;            ///< Displacements of the held degrees of freedom, zero elsewhere. [m]
  Eigen::VectorXd jumps;     ///< u_b − u_a imposed where a joint is held. [m]
  double force_scale = 0.0;  ///< Port forces below 1e-12 of this norm are rounding. [N/m]
  Eigen::VectorXd given{};   ///< Reactions where a joint is not held; empty: none. [N/m]
  Eigen::VectorXd
      friction{};  ///< Of each sliding joint: R_T = given + friction · R_N; empty: 0. [-]
};

struct StructureResponse {
  Eigen::VectorXd displacements;  ///< δ. [m]
  Eigen::VectorXd reactions;      ///< r of every joint: R_N, R_T. [N/m]
  Eigen::VectorXd tie_forces;     ///< Of every tie, pushing its top point up. [N/m]
  int solves = 0;                 ///< Triangular solves spent.
  double residual = 0.0;          ///< Relative error of the port forces, as corrections shrink. [-]
};

/// Answers of all joints to unit jumps at one joint: a column for the normal, one for the
/// tangential jump.
struct JumpResponse {
  Eigen::MatrixX2d reactions;  ///< [N/m²]
  Eigen::MatrixX2d gaps;       ///< u_b − u_a; what is not held follows the structure. [-]
};

/// Factor of the structure in which the joints hold as given (S5)-(S7),
/// sim/README.md. Unknowns are the joints' own displacements; what an even ring of ports
/// cannot do is imposed by multipliers, so that no digits are lost at large steps (M10).
class Structure {
 public:
  /// @param held  One per joint; empty: all hold fully.
  explicit Structure(const Bodies& bodies, std::vector<Held> held = {});

  [[nodiscard]] bool ok() const { return factor_.has_value() && factor_->ok(); }
  [[nodiscard]] const Bodies& bodies() const { return *bodies_; }
  [[nodiscard]] const std::vector<Held>& held() const { return held_; }
  [[nodiscard]] Eigen::Index joints() const { return static_cast<Eigen::Index>(held_.size()); }
  [[nodiscard]] const Cholesky& factor() const { return *factor_; }
  [[nodiscard]] Eigen::Index unknowns() const { return unknowns_; }  ///< Rows of the factor.

  [[nodiscard]] StructureResponse solve(const StructureLoads& loads) const;

  [[nodiscard]] JumpResponse respond_to_jump(int joint) const;

 private:
  struct PortLoads;
  struct PortState;
  struct Correction;
  [[nodiscard]] PortState solve_ports(const PortLoads& loads) const;
  [[nodiscard]] Correction correct(const Eigen::MatrixXd& forces, const Eigen::MatrixXd& gap,
                                   const Eigen::VectorXd& friction) const;
  [[nodiscard]] Eigen::VectorXd in_forces(const Eigen::MatrixXd& forces,
                                          const Eigen::MatrixXd& gap) const;
  void rub(const Eigen::VectorXd& friction, Eigen::MatrixXd& port_forces) const;
  [[nodiscard]] bool holds(int unknown) const;
  [[nodiscard]] Eigen::MatrixXd unknowns_to_ports(const Eigen::MatrixXd& unknowns) const;
  [[nodiscard]] Eigen::MatrixXd ports_to_unknowns(const Eigen::MatrixXd& forces) const;
  [[nodiscard]] Eigen::MatrixXd reactions_of(const Eigen::MatrixXd& port_forces) const;
  void assemble();

  const Bodies* bodies_;
  std::vector<Held> held_;
  std::vector<std::array<Eigen::Index, 2>> ports_of_;  // sides a and b of each joint's component
  std::vector<int> unknown_of_port_;
  std::vector<char> tie_top_;  // 1 for a port that also moves with the common distance of the ties
  Eigen::Index unknowns_ = 0;
  double stiffness_ = 0.0;  // the largest of Z [N/m²]
  double penalty_ = 0.0;    // ρ of the compatibility term [N/m²]
  std::optional<Cholesky> factor_;
};

}  // namespace havers::sim
