// One body, reduced to the displacements of its ports: the points where joints and ties hold it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/elasticity/body_matrices.hpp"

namespace havers::sim {

/// The shifted stiffness Ā = αM + βK of a time step, α = 1/h² and β = 1 + τ/h (M3); α → 0, β = 1 in
/// the quasi-static limit.
struct Shift {
  double alpha = 0.0;  ///< [1/s²]
  double beta = 1.0;   ///< [-]
};

/// Static condensation of Ā δ = g + Bᵀ t with port displacements p = B δ (S1)-(S4),
/// sim/README.md. n degrees of freedom (those held by the boundary included), p ports.
struct BodyOperator {
  BodyMatrices matrices;
  std::vector<Eigen::Index> free;  ///< Degrees of freedom that the boundary leaves.
  double inertia_part = 0.0;       ///< αM in Ā, by their largest entries. [-]
  Eigen::MatrixXd shifted;         ///< Ā, n × n. [N/m²]
  Eigen::MatrixXd ports;           ///< B, p × n. [-]
  Eigen::MatrixXd compliance;      ///< G, n × n: answer to loads with the ports held. [m²/N]
  Eigen::MatrixXd recovery;        ///< T, n × p: answer to port displacements. [-]
  Eigen::MatrixXd impedance;       ///< Z = TᵀĀT, p × p: port forces. [N/m²]
  Eigen::MatrixXd rigid;    ///< Orthonormal columns, where inertia is a trace: motions as a whole
                            ///< that the boundary leaves to the body, at its ports. [-]
  Eigen::MatrixXd inertia;  ///< Z times these, free of rounding in K. [N/m²]
  Eigen::MatrixXd at_once;  ///< Z with that put in: one product, whose rounding is alike in all
                            ///< bodies that move alike, and adds up. [N/m²]
  Eigen::MatrixXd compatibility;  ///< N, orthonormal rows: N p = 0 for every p = B δ. [-]
  Eigen::MatrixXf nearly;         ///< at_once and Nᵀ, side by side.

  /// Whether the boundary holds some of the degrees of freedom.
  [[nodiscard]] bool held() const { return free.size() < static_cast<std::size_t>(shifted.rows()); }
  /// Whether inertia is but a trace of Ā, lost in its rounding where the body moves as a whole.
  [[nodiscard]] bool at_rest() const { return inertia_part < 1e-6; }
};

/// @param held  1 for a degree of freedom that the boundary prescribes, n values.
BodyOperator make_body_operator(BodyMatrices matrices, Eigen::MatrixXd ports,
                                const std::vector<char>& held, const Shift& shift);

}  // namespace havers::sim
