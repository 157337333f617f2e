#include "sim/elasticity/triangle.hpp"

#include <gtest/gtest.h>

namespace havers::sim {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Corners corners{Vector2d{1.0, 0.5}, Vector2d{4.0, 1.0}, Vector2d{2.0, 3.5}};

VectorXd displacements(const Matrix2d& gradient, const Vector2d& shift) {
  VectorXd u(6);
  for (Eigen::Index i = 0; i < 3; ++i)
    u.segment<2>(2 * i) = gradient * corners[static_cast<std::size_t>(i)] + shift;
  return u;
}

TEST(PlaneElasticity, IsHookesLawOfThreeDimensions) {
  const double nu = 0.3, lambda = nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), mu = 0.5 / (1.0 + nu);
  const Eigen::Matrix3d strain = plane_elasticity({.poisson = nu, .plane = Plane::strain});
  EXPECT_NEAR(strain(0, 0), lambda + 2.0 * mu, 1e-14);
  EXPECT_NEAR(strain(0, 1), lambda, 1e-14);
  EXPECT_NEAR(strain(2, 2), mu, 1e-14);
  // Plane stress: stretched along x and free to contract by ν, the stress is E ε.
  const Vector3d stress = plane_elasticity({.poisson = nu}) * Vector3d(1.0, -nu, 0.0);
  EXPECT_LT((stress - Vector3d(1.0, 0.0, 0.0)).norm(), 1e-14);
  EXPECT_NEAR(plane_elasticity({.poisson = nu})(2, 2), mu, 1e-14);
}

// A linear field has a uniform stress; its traction on an edge goes to the edge's ends by halves.
TEST(TriangleStiffness, AnswersALinearFieldByItsTractions) {
  const Eigen::Matrix3d D = plane_elasticity({});
  Matrix2d gradient;
  gradient << 0.2, 0.5, -0.1, 0.4;
  const Vector3d s = D * Vector3d(0.2, 0.4, 0.4);
  Matrix2d stress;
  stress << s(0), s(2), s(2), s(1);
  VectorXd forces = VectorXd::Zero(6);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index j = (i + 1) % 3;
    const Vector2d edge =
        corners[static_cast<std::size_t>(j)] - corners[static_cast<std::size_t>(i)];
    const Vector2d pull = stress * Vector2d(edge.y(), -edge.x());
    forces.segment<2>(2 * i) += 0.5 * pull;
    forces.segment<2>(2 * j) += 0.5 * pull;
  }
  EXPECT_LT((triangle_stiffness(corners, D) * displacements(gradient, {1.0, 2.0}) - forces).norm(),
            1e-13);
}

TEST(TriangleArea, IsThatOfHalfAParallelogram) {
  EXPECT_DOUBLE_EQ(triangle_area(corners), 0.5 * (3.0 * 3.0 - 0.5 * 1.0));
}

}  // namespace
}  // namespace havers::sim
