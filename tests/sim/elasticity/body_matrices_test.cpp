#include "sim/elasticity/body_matrices.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

TEST(BodyMatrices, WeighWhatTheBodiesWeigh) {
  const AssemblyOptions options{.layers = 4, .fibres = 3, .orientation = 30 * test::degree};
  const Assembly assembly = build_assembly(options, Lateral::free);
  const Material material;
  double mass = 0.0;
  for (const Body& body : assembly.bodies)
    mass += body_matrices(assembly, body, material).mass.sum();
  const double area = options.width() * options.height();
  EXPECT_NEAR(mass / (2.0 * material.density * area), 1.0, 1e-10);  // x and y
}

TEST(BodyMatrices, ResistAllButRigidMotions) {
  const Assembly assembly = build_assembly({.layers = 2, .fibres = 2}, Lateral::free);
  for (const Body& body : assembly.bodies) {
    const Eigen::MatrixXd K = body_matrices(assembly, body, {}).stiffness;
    Eigen::MatrixXd rigid(K.rows(), 3);
    for (int i = 0; i < body.nodes; ++i) {
      const Eigen::Vector2d p =
          assembly.nodes[static_cast<std::size_t>(body.first_node + i)] / 1e-4;
      rigid.block<2, 3>(2 * i, 0) << 1.0, 0.0, -p.y(), 0.0, 1.0, p.x();
    }
    EXPECT_LT((K * rigid).norm(), 1e-12 * K.norm());
    EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
    const Eigen::VectorXd values = K.selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_GT(values(3), 1e-6 * values(values.size() - 1));
  }
}

}  // namespace
}  // namespace havers::sim
