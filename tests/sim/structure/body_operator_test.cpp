#include "sim/structure/body_operator.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "sim/structure/bodies.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// All kinds of bodies of a clipped specimen, at a small and a large step.
class EveryBody : public testing::TestWithParam<std::tuple<double, double>> {
 protected:
  Scene scene = test::small_scene(std::get<0>(GetParam()), 4, 3);
  Assembly assembly = build_assembly(scene.assembly, Lateral::periodic);
  double h = std::get<1>(GetParam());
  Bodies bodies{assembly, scene.material, {1.0 / (h * h), 1.2}};

  [[nodiscard]] std::vector<Index> free_dofs(const BodyClass& group) const {
    const Index first = bodies.first_dof(group.bodies.front());
    std::vector<Index> free;
    for (Index i = 0; i < group.op.ports.cols(); ++i)
      if (bodies.held()[static_cast<std::size_t>(first + i)] == 0) free.push_back(i);
    return free;
  }
};
INSTANTIATE_TEST_SUITE_P(, EveryBody,
                         testing::Combine(testing::Values(0.0, 33.0, 90.0),
                                          testing::Values(5e-9, 1e-6)));

// δ = G g + T p for any load and any possible port displacements, and Z p − Tᵀ g are the port
// forces, up to those that no displacement can feel (S1)-(S4).
TEST_P(EveryBody, IsCondensedExactly) {
  for (const BodyClass& group : bodies.classes()) {
    const BodyOperator& op = group.op;
    const std::vector<Index> free = free_dofs(group);
    VectorXd possible = VectorXd::Zero(op.ports.cols()), g = possible;
    possible(free) = VectorXd::Random(static_cast<Index>(free.size()));
    g(free) = op.shifted.norm() * VectorXd::Random(static_cast<Index>(free.size()));
    const VectorXd p = op.ports * possible;
    const VectorXd displacements = op.compliance * g + op.recovery * p;
    EXPECT_LT((op.ports * displacements - p).norm(), 1e-10 * (1.0 + p.norm()));

    const VectorXd port_forces = op.impedance * p - op.recovery.transpose() * g;
    const VectorXd missing = op.shifted * displacements - g - op.ports.transpose() * port_forces;
    EXPECT_LT(missing(free).norm(), 1e-10 * op.shifted.norm() * (1.0 + displacements.norm()));
  }
}

// Where inertia is a trace only, next to nothing pushes a body that moves as a whole, however far.
TEST_P(EveryBody, BearsNoForceWhereItMovesAsAWhole) {
  for (const double step : {h, 1.0}) {
    const Bodies slow(assembly, scene.material, {1.0 / (step * step), 1.0});
    for (const BodyClass& group : slow.classes()) {
      const BodyOperator& op = group.op;
      const MatrixXd direct = op.impedance * op.rigid;
      EXPECT_LE((op.inertia - direct).norm(), 1e-12 * op.impedance.norm());
      if (step == 1.0) {
        EXPECT_LE(op.inertia.norm(), 4.0 * op.matrices.mass.sum());
        EXPECT_LE((op.at_once * op.rigid - op.inertia).norm(), 1e-15 * op.impedance.norm());
      }
    }
  }
}

TEST_P(EveryBody, KnowsWhatItsPortsCannotDo) {
  for (const BodyClass& group : bodies.classes()) {
    const BodyOperator& op = group.op;
    const MatrixXd& N = op.compatibility;
    const std::vector<Index> free = free_dofs(group);
    const MatrixXd B = op.ports(Eigen::all, free);
    EXPECT_EQ(N.rows(), B.rows() - B.fullPivLu().rank());
    if (N.rows() == 0) continue;
    EXPECT_LT((N * B).norm(), 1e-12);
    EXPECT_LT((N * N.transpose() - MatrixXd::Identity(N.rows(), N.rows())).norm(), 1e-12);
  }
}

TEST_P(EveryBody, HasSymmetricOperators) {
  for (const BodyClass& group : bodies.classes()) {
    const BodyOperator& op = group.op;
    EXPECT_EQ(op.compliance, op.compliance.transpose());
    EXPECT_EQ(op.impedance, op.impedance.transpose());
    const VectorXd shifted = 1.2 * op.matrices.stiffness.diagonal() + op.matrices.mass / (h * h);
    EXPECT_LT((op.shifted.diagonal() - shifted).norm(), 1e-13 * shifted.norm());
  }
}

}  // namespace
}  // namespace havers::sim
