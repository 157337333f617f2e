// The T3 triangle of linear elasticity, per unit thickness.
#pragma once

#include <Eigen/Core>
#include <array>

#include "sim/scene.hpp"

namespace havers::sim {

using Corners = std::array<Eigen::Vector2d, 3>;  ///< Anticlockwise. [m]

/// D / E of σ = D ε with ε = (ε_xx, ε_yy, γ_xy). [-]
Eigen::Matrix3d plane_elasticity(const Material& material);

double triangle_area(const Corners& corners);  ///< [m²]

/// ∫ BᵀDB over the triangle; degrees of freedom (x, y) of each corner. Same unit as D.
Eigen::Matrix<double, 6, 6> triangle_stiffness(const Corners& corners, const Eigen::Matrix3d& D);

}  // namespace havers::sim
