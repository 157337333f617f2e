// The joints' problem of whole small walls against an independent solver: dense matrices, and every
// combination of states tried (stick, slip either way, open). Status for status.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <random>

#include "sim/contact/active_set.hpp"
#include "sim/contact/gauss_seidel.hpp"
#include "tests/sim/contact/enumerated_contact.hpp"
#include "tests/support/bonded_wall.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// r = S (u − u_free), S = W⁻¹ and W = H Ā⁻¹ Hᵀ.
LocalContact dense_problem(const test::WallStep& wall, double h) {
  const Index n = wall.bodies.dofs();
  MatrixXd A(n, n);
  for (Index i = 0; i < n; ++i) A.col(i) = wall.bodies.stiffness_times(VectorXd::Unit(n, i));
  A.diagonal() += wall.bodies.mass() / (h * h);
  std::vector<Index> free;
  for (Index i = 0; i < n; ++i)
    if (wall.bodies.held()[static_cast<std::size_t>(i)] == 0) free.push_back(i);
  const auto rows = static_cast<Index>(2 * wall.step.laws.size());
  MatrixXd H(rows, static_cast<Index>(free.size()));
  VectorXd g(H.cols());
  for (Index k = 0; k < H.cols(); ++k) {
    const Index dof = free[static_cast<std::size_t>(k)];
    H.col(k) = joint_gaps(wall.bodies, VectorXd::Unit(n, dof));
    g(k) = wall.step.forces(dof);
  }
  const MatrixXd inverse = MatrixXd(A(free, free)).inverse();
  const MatrixXd S = MatrixXd(H * inverse * H.transpose()).inverse();
  return {S, -(S * (H * (inverse * g))), VectorXd::Zero(rows), wall.step.laws};
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
};

class SmallWall : public testing::TestWithParam<std::tuple<Wall, unsigned>> {};
INSTANTIATE_TEST_SUITE_P(WallAndLoad, SmallWall,
                         testing::Combine(testing::Values(Wall{2, 1}, Wall{1, 4}, Wall{1, 7},
                                                          Wall{2, 2}),
                                          testing::Range(1U, 9U)));

TEST_P(SmallWall, IsSolvedAsByEnumerationStatusForStatus) {
  const auto [size, seed] = GetParam();
  const Scene scene = test::wall(size.layers, size.fibres, Lateral::free);
  const double h = test::step_of(scene, 0.3);
  test::WallStep wall(scene, 0.0042, h);
  disturb(wall, seed);
  LocalContact problem = dense_problem(wall, h);
  const double force = problem.r0.lpNorm<Eigen::Infinity>();
  const double gap = force / problem.S.diagonal().maxCoeff();
  problem.S *= gap / force;  // in units of 1, as the enumeration expects
  problem.r0 /= force;
  for (JointLaw& law : problem.laws) law.cohesion /= force;
  const std::vector<VectorXd> solutions = test::all_solutions(problem);
  ASSERT_FALSE(solutions.empty());

  ActiveSetSolver active_set(wall.bodies, 10000);
  GaussSeidelSolver gauss_seidel(wall.bodies, 1e-10, 100000);
  for (JointSolver* solver : std::initializer_list<JointSolver*>{&active_set, &gauss_seidel}) {
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
