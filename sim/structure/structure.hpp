// The bodies held together by their bonded joints, solved directly whatever the step size.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/structure/bodies.hpp"
#include "sim/structure/cholesky.hpp"

namespace havers::sim {

/// What acts on a structure. Vectors over degrees of freedom, and over joints (normal, tangential
/// of each).
struct StructureLoads {
  Eigen::VectorXd forces;  ///< g, at every degree of freedom. [N/m]
  Eigen::VectorXd
      prescribed;            ///< Displacements of the held degrees of freedom, zero elsewhere. [m]
  Eigen::VectorXd jumps;     ///< u_b − u_a imposed at every joint that is not detached. [m]
  double force_scale = 0.0;  ///< Port forces below 1e-12 of this norm are rounding. [N/m]
};

struct StructureResponse {
  Eigen::VectorXd displacements;  ///< δ. [m]
  Eigen::VectorXd reactions;      ///< r of every joint: R_N, R_T; zero where detached. [N/m]
  Eigen::VectorXd tie_forces;     ///< Of every tie, pushing its top point up. [N/m]
  int solves = 0;                 ///< Triangular solves spent.
  double residual = 0.0;          ///< Relative size of the last correction of the port forces. [-]
};

/// Answers of all joints to unit jumps at one joint: a column for the normal, one for the
/// tangential jump.
struct JumpResponse {
  Eigen::MatrixX2d reactions;  ///< [N/m²]
  Eigen::MatrixX2d gaps;       ///< u_b − u_a; those of detached joints follow the structure. [-]
};

/// Factor of the structure in which all joints hold but the detached ones (S5)-(S7),
/// sim/README.md. Unknowns are the joints' own displacements; what an even ring of ports
/// cannot do is imposed by multipliers, so that no digits are lost at large steps (M10).
class Structure {
 public:
  /// @param detached  1 for a joint that holds nothing, one per joint; empty: all hold.
  explicit Structure(const Bodies& bodies, std::vector<char> detached = {});

  [[nodiscard]] bool ok() const { return factor_.has_value() && factor_->ok(); }
  [[nodiscard]] const Bodies& bodies() const { return *bodies_; }
  [[nodiscard]] bool detached(int joint) const {
    return detached_[static_cast<std::size_t>(joint)] != 0;
  }
  [[nodiscard]] Eigen::Index joints() const { return static_cast<Eigen::Index>(detached_.size()); }
  [[nodiscard]] const Cholesky& factor() const { return *factor_; }

  [[nodiscard]] StructureResponse solve(const StructureLoads& loads) const;

  [[nodiscard]] JumpResponse respond_to_jump(int joint) const;

 private:
  struct PortState;
  [[nodiscard]] PortState solve_ports(const Eigen::MatrixXd& port_loads,
                                      const Eigen::MatrixXd& offsets, double force_scale) const;
  [[nodiscard]] Eigen::MatrixXd unknowns_to_ports(const Eigen::MatrixXd& unknowns) const;
  [[nodiscard]] Eigen::MatrixXd ports_to_unknowns(const Eigen::MatrixXd& forces) const;
  [[nodiscard]] Eigen::MatrixXd reactions_of(const Eigen::MatrixXd& port_forces) const;
  void assemble();

  const Bodies* bodies_;
  std::vector<char> detached_;
  std::vector<int> unknown_of_port_;
  std::vector<char> tie_top_;  // 1 for a port that also moves with the common distance of the ties
  Eigen::Index unknowns_ = 0;
  double penalty_ = 0.0;  // ρ of the compatibility term [N/m²]
  std::optional<Cholesky> factor_;
};

}  // namespace havers::sim
