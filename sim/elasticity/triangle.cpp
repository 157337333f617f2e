#include "sim/elasticity/triangle.hpp"

namespace havers::sim {

// Plane strain is plane stress with other constants (scene.hpp).
Eigen::Matrix3d plane_elasticity(const Material& material) {
  const double nu = lateral_contraction(material);
  Eigen::Matrix3d D;
  D << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  return plane_stiffening(material) / (1.0 - nu * nu) * D;
}

double triangle_area(const Corners& c) {
  const Eigen::Vector2d a = c[1] - c[0], b = c[2] - c[0];
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

Eigen::Matrix<double, 6, 6> triangle_stiffness(const Corners& c, const Eigen::Matrix3d& D) {
  const double area = triangle_area(c);
  Eigen::Matrix<double, 3, 6> B = Eigen::Matrix<double, 3, 6>::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector2d &next = c[static_cast<std::size_t>((i + 1) % 3)],
                          &last = c[static_cast<std::size_t>((i + 2) % 3)];
    // Shape functions are linear: their gradients, and so B, are constant over the triangle.
    const double dx = (next.y() - last.y()) / (2.0 * area);  // ∂N_i/∂x
    const double dy = (last.x() - next.x()) / (2.0 * area);  // ∂N_i/∂y
    B(0, 2 * i) = dx;
    B(1, 2 * i + 1) = dy;
    B(2, 2 * i) = dy;
    B(2, 2 * i + 1) = dx;
  }
  return area * B.transpose() * D * B;
}

}  // namespace havers::sim
