// Stiffness and mass (M2) of one body, per unit thickness.
#pragma once

#include <Eigen/Core>

#include "sim/assembly/assembly.hpp"

namespace havers::sim {

/// Degrees of freedom: x and y of each node of the body, in order.
struct BodyMatrices {
  Eigen::MatrixXd stiffness;  ///< K, symmetric ≥ 0. [N/m²]
  Eigen::VectorXd mass;       ///< M, row-lumped. [kg/m]
  Eigen::MatrixX3d motions;   ///< Orthonormal: of the body as a whole, without strain. [-]
};

/// The sums over the body's triangles, with the modulus of its layer. Dense: bodies are small, and
/// equal ones share what is made of them.
BodyMatrices body_matrices(const Assembly& assembly, const Body& body, const Material& material);

}  // namespace havers::sim
