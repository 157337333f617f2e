#include "sim/contact/joint_sweeps.hpp"

#include <gtest/gtest.h>

#include "sim/bench/watched_run.hpp"
#include "tests/support/bonded_wall.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

constexpr double strain = 1e-4;  // no joint leaves its cone

/// Sweeps until all joints bear what they do under a uniform stress (M1); none where they never do.
int sweeps_to_uniform_stress(const Scene& scene, double relaxation) {
  constexpr int most = 5000;
  const test::WallStep wall(scene, strain, test::step_of(scene, 0.1));
  const Eigen::VectorXd exact = bonded_forces_at(scene, strain);
  JointSweeps sweeps(wall.bodies);
  sweeps.start(wall.step, wall.step.reactions, {});
  for (int sweep = 1; sweep <= most; ++sweep) {
    sweeps.sweep(wall.step, relaxation);
    if ((sweeps.reactions() - exact).norm() <= 1e-6 * exact.norm()) return sweep;
  }
  return 0;
}

class JointSweepsAt : public testing::TestWithParam<double> {};

TEST_P(JointSweepsAt, FindTheSameInFewerSweepsWhenTheyAreOverRelaxed) {
  Scene scene = test::wall(6, 5, Lateral::free);
  scene.assembly.orientation = GetParam() * test::degree;
  const int plain = sweeps_to_uniform_stress(scene, 1.0);
  const int relaxed = sweeps_to_uniform_stress(scene, 1.6);
  EXPECT_GT(relaxed, 0);
  EXPECT_LT(relaxed, plain);
}

// What some joints bear too much spreads among its neighbours, not to those far away.
TEST(JointSweeps, LeaveJointsWhoseBodiesHardlyFeelAChange) {
  constexpr double part = 1e-4;
  const Scene scene = test::wall(20, 12, Lateral::free);
  const test::WallStep wall(scene, strain, test::step_of(scene, 0.1));
  const Eigen::VectorXd exact = bonded_forces_at(scene, strain);
  const double largest = exact.lpNorm<Eigen::Infinity>();
  Eigen::VectorXd wrong = exact;
  wrong.head(40).array() += 0.01 * largest;
  JointSweeps sweeps(wall.bodies);
  sweeps.start(wall.step, wrong, {});
  sweeps.sweep(wall.step);  // each joint is solved at least once
  const Eigen::VectorXd after_one = sweeps.reactions();
  constexpr int many = 300;
  for (int sweep = 0; sweep < many; ++sweep) sweeps.sweep(wall.step, 1.0, part * largest);
  const Eigen::VectorXd left = sweeps.reactions();
  EXPECT_EQ(left.tail(exact.size() / 2), after_one.tail(exact.size() / 2));
  EXPECT_NE(left.head(2), after_one.head(2));
  EXPECT_LT((left - exact).lpNorm<Eigen::Infinity>(), 10.0 * part * largest);
  for (int sweep = 0; sweep < many; ++sweep) sweeps.sweep(wall.step);
  EXPECT_LT((sweeps.reactions() - exact).norm(), 0.1 * (left - exact).norm());
}

INSTANTIATE_TEST_SUITE_P(Degrees, JointSweepsAt, testing::Values(0.0, 30.0));

}  // namespace
}  // namespace havers::sim
