// The joints' problem of whole small walls against an independent solver: dense matrices, and every
// combination of states tried (stick, slip either way, open). Status for status.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "sim/contact/active_set.hpp"
#include "sim/contact/gauss_seidel.hpp"
#include "tests/sim/contact/enumerated_contact.hpp"
#include "tests/sim/structure/dense_structure.hpp"
#include "tests/support/bonded_wall.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// r = S (u − u_free), S = (C A⁻¹ Cᵀ)⁻¹ without the ties, which hold whatever the joints do.
LocalContact dense_problem(const test::WallStep& wall, const Material& material, double h) {
  const test::DenseStructure dense(wall.assembly, material, {1.0 / (h * h), 1.0});
  std::vector<Index> free;
  for (std::size_t i = 0; i < dense.held.size(); ++i)
    if (dense.held[i] == 0) free.push_back(static_cast<Index>(i));
  const auto joints = static_cast<Index>(2 * wall.step.laws.size());
  const MatrixXd C = dense.C(Eigen::all, free);
  const Eigen::LDLT<MatrixXd> A(MatrixXd(dense.A(free, free)));
  const MatrixXd S = MatrixXd(C * A.solve(C.transpose())).inverse();  // of joints and ties
  const VectorXd r0 = -S * (C * A.solve(VectorXd(wall.step.forces(free))));
  return {S.topLeftCorner(joints, joints), r0.head(joints), VectorXd::Zero(joints), wall.step.laws};
}

// Random forces on a stretched wall, every second joint broken before.
void disturb(test::WallStep& wall, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (double& force : wall.step.forces) force += 150.0 * normal(random);
  for (std::size_t j = seed % 2; j < wall.step.laws.size(); j += 2) {
    wall.step.broken[j] = 1;
    wall.step.laws[j] = broken_law(0.3);
  }
}

enum class Status { stick, slip, open };

Status status_of(JointState state) {
  if (state == JointState::open) return Status::open;
  return state == JointState::stick ? Status::stick : Status::slip;
}

Status status_of(const Local& gap, double size) {
  if (gap.x() > 1e-9 * size) return Status::open;
  return std::abs(gap.y()) > 1e-9 * size ? Status::slip : Status::stick;
}

struct Wall {
  int layers, fibres;
  double degrees;
  Lateral lateral;
};

class SmallWall : public testing::TestWithParam<std::tuple<Wall, double, unsigned>> {};
INSTANTIATE_TEST_SUITE_P(
    WallStepAndLoad, SmallWall,
    testing::Combine(
        testing::Values(Wall{2, 1, 0.0, Lateral::free}, Wall{1, 4, 0.0, Lateral::free},
                        Wall{2, 1, 0.0, Lateral::periodic}, Wall{2, 2, 0.0, Lateral::periodic},
                        Wall{1, 2, 30.0, Lateral::free}, Wall{1, 2, 30.0, Lateral::periodic},
                        Wall{1, 2, 90.0, Lateral::free}, Wall{1, 2, 90.0, Lateral::periodic}),
        testing::Values(1e-2, 0.3, 1.0, 10.0), testing::Range(1U, 4U)));

// Turned fibres are short, so that few joints are left of them.
Scene scene_of(const Wall& size) {
  Scene scene = test::wall(size.layers, size.fibres, size.lateral);
  scene.assembly.orientation = size.degrees * test::degree;
  if (size.degrees != 0.0) scene.assembly.fibre_height = 0.5 * scene.assembly.fibre_length;
  return scene;
}

TEST_P(SmallWall, IsSolvedAsByEnumerationStatusForStatus) {
  const auto [size, length, seed] = GetParam();
  const Scene scene = scene_of(size);
  const double h = test::step_of(scene, length);
  test::WallStep wall(scene, 0.0042, h);
  ASSERT_LE(wall.step.laws.size(), 8U);
  disturb(wall, seed);
  LocalContact problem = dense_problem(wall, scene.material, h);
  const double force = problem.r0.lpNorm<Eigen::Infinity>();
  const double gap = force / problem.S.diagonal().maxCoeff();
  problem.S *= gap / force;  // in units of 1, as the enumeration expects
  problem.r0 /= force;
  for (JointLaw& law : problem.laws) law.cohesion /= force;
  const std::vector<VectorXd> solutions = test::all_solutions(problem);
  ASSERT_FALSE(solutions.empty());

  ActiveSetSolver active_set(wall.bodies);
  GaussSeidelSolver gauss_seidel(wall.bodies, 1e-10, 100000);
  for (JointSolver* solver : std::initializer_list<JointSolver*>{&active_set, &gauss_seidel}) {
    if (solver == &gauss_seidel && length > 1.0) continue;  // it is for short steps
    const JointStepResult result = solver->solve(wall.step);
    ASSERT_TRUE(result.converged);
    const VectorXd found = result.gaps / gap;
    const auto nearest = std::min_element(solutions.begin(), solutions.end(),
                                          [&](const VectorXd& a, const VectorXd& b) {
                                            return (a - found).norm() < (b - found).norm();
                                          });
    EXPECT_LT((*nearest - found).norm(), 1e-6 * (1.0 + found.norm()));
    if (solver != &active_set) continue;
    for (std::size_t j = 0; j < wall.step.laws.size(); ++j)
      EXPECT_EQ(status_of(result.states[j]),
                status_of(nearest->segment<2>(static_cast<Index>(2 * j)), 1.0))
          << "joint " << j;
  }
}

}  // namespace
}  // namespace havers::sim
