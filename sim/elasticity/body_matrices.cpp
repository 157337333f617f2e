// Assembles T3 triangles into a body's dense matrices; a third of a triangle's mass at each of its
// corners is the row sum of its consistent mass.
#include "sim/elasticity/body_matrices.hpp"

#include <array>

#include "sim/elasticity/triangle.hpp"

namespace havers::sim {
namespace {

// Two translations and the turn about the nodes' mean.
Eigen::MatrixX3d own_motions(const Assembly& assembly, const Body& body) {
  const auto node = [&](int i) {
    const int index = body.first_node + i;
    return assembly.nodes[static_cast<std::size_t>(index)];
  };
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int i = 0; i < body.nodes; ++i) mean += node(i) / body.nodes;
  Eigen::MatrixX3d motions(2 * body.nodes, 3);
  for (int i = 0; i < body.nodes; ++i) {
    const Eigen::Vector2d arm = node(i) - mean;
    motions.row(2 * i) << 1.0, 0.0, -arm.y();
    motions.row(2 * i + 1) << 0.0, 1.0, arm.x();
  }
  // About the mean the turn is orthogonal to the translations already.
  motions.colwise().normalize();
  return motions;
}

}  // namespace

BodyMatrices body_matrices(const Assembly& assembly, const Body& body, const Material& material) {
  const Eigen::Matrix3d D = young_of_layer(material, body.layer) * plane_elasticity(material);
  BodyMatrices matrices{Eigen::MatrixXd::Zero(2 * body.nodes, 2 * body.nodes),
                        Eigen::VectorXd::Zero(2 * body.nodes), own_motions(assembly, body)};
  for (int t = body.first_triangle; t < body.first_triangle + body.triangles; ++t) {
    const std::array<int, 3>& nodes = assembly.triangles[static_cast<std::size_t>(t)];
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = assembly.nodes[static_cast<std::size_t>(nodes[i])];
    const Eigen::Matrix<double, 6, 6> element = triangle_stiffness(corners, D);
    const double third = material.density * triangle_area(corners) / 3.0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Index row = 2 * (nodes[static_cast<std::size_t>(i)] - body.first_node);
      matrices.mass.segment<2>(row).array() += third;
      for (Eigen::Index j = 0; j < 3; ++j) {
        const Eigen::Index column = 2 * (nodes[static_cast<std::size_t>(j)] - body.first_node);
        matrices.stiffness.block<2, 2>(row, column) += element.block<2, 2>(2 * i, 2 * j);
      }
    }
  }
  return matrices;
}

}  // namespace havers::sim
