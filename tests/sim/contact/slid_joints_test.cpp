// A step of joints that have opened and slid before, against every combination of their states.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <random>

#include "sim/contact/active_set.hpp"
#include "sim/contact/gauss_seidel.hpp"
#include "tests/sim/contact/enumerated_contact.hpp"
#include "tests/sim/structure/dense_structure.hpp"
#include "tests/support/bonded_wall.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double usual_gap = 1e-8;  // [m]

// Every second joint is broken; of these some were open, all have slid, and the bodies move on.
void let_slide(JointStep& step, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (double& force : step.forces) force += 150.0 * normal(random);
  for (std::size_t j = seed % 2; j < step.laws.size(); j += 2) {
    const auto row = static_cast<Index>(2 * j);
    const bool open = random() % 2 == 0;
    step.broken[j] = 1;
    step.laws[j] = broken_law(0.3);
    step.states[j] = open ? JointState::open : JointState::slip_forward;
    step.gaps(row) = open ? usual_gap * std::abs(normal(random)) : 0.0;
    step.gaps(row + 1) = 10.0 * usual_gap * normal(random);
    step.held_at(row + 1) = step.gaps(row + 1);
  }
  step.predicted = step.gaps;
  for (double& gap : step.predicted) gap += 0.3 * usual_gap * normal(random);
}

// r = r₀ + S y for y = H δ, and gaps of u₀ + y from where joints are held.
LocalContact problem_of(const test::WallStep& wall, const Material& material, double h) {
  const test::DenseStructure dense(wall.assembly, material, {1.0 / (h * h), 1.0});
  std::vector<Index> free;
  for (std::size_t i = 0; i < dense.held.size(); ++i)
    if (dense.held[i] == 0) free.push_back(static_cast<Index>(i));
  const auto rows = static_cast<Index>(2 * wall.step.laws.size());
  const MatrixXd C = dense.C(Eigen::all, free);
  const Eigen::LDLT<MatrixXd> A(MatrixXd(dense.A(free, free)));
  const MatrixXd S = MatrixXd(C * A.solve(C.transpose())).inverse();
  const VectorXd r0 = -S * (C * A.solve(VectorXd(wall.step.forces(free))));
  return {S.topLeftCorner(rows, rows), r0.head(rows), wall.step.predicted - wall.step.held_at,
          wall.step.laws};
}

class SlidJoints : public testing::TestWithParam<std::tuple<double, unsigned>> {};
INSTANTIATE_TEST_SUITE_P(StepAndLoad, SlidJoints,
                         testing::Combine(testing::Values(0.1, 1.0), testing::Values(1U, 2U)));

TEST_P(SlidJoints, GoOnFromWhereTheyAre) {
  const auto [length, seed] = GetParam();
  const Scene scene = test::wall(2, 2, Lateral::free);
  const double h = test::step_of(scene, length);
  test::WallStep wall(scene, 0.002, h);
  let_slide(wall.step, seed);
  LocalContact problem = problem_of(wall, scene.material, h);
  const double force = problem.r0.lpNorm<Eigen::Infinity>();
  const double gap = force / problem.S.diagonal().maxCoeff();
  problem.S *= gap / force;  // in units of 1, as the enumeration expects
  problem.r0 /= force;
  problem.u0 /= gap;
  for (JointLaw& law : problem.laws) law.cohesion /= force;
  const std::vector<VectorXd> solutions = test::all_solutions(problem);
  ASSERT_FALSE(solutions.empty());

  ActiveSetSolver by_sets(wall.bodies);
  GaussSeidelSolver by_sweeps(wall.bodies, 1e-11, 200000);
  for (JointSolver* solver : std::initializer_list<JointSolver*>{&by_sets, &by_sweeps}) {
    const JointStepResult result = solver->solve(wall.step);
    ASSERT_TRUE(result.converged);
    const VectorXd found = (result.gaps - wall.step.predicted) / gap;
    double away = std::numeric_limits<double>::infinity();
    for (const VectorXd& solution : solutions) away = std::min(away, (solution - found).norm());
    EXPECT_LT(away, 1e-6 * (1.0 + found.norm()));
  }
}

}  // namespace
}  // namespace havers::sim
