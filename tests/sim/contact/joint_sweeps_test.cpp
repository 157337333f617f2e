#include "sim/contact/joint_sweeps.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

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

// S = diag(2, 1), c = 1, μ = 1/2: each answer by hand.
SingleJoint one_joint(const Local& free) {
  return solve_single_joint(Eigen::Vector2d(2.0, 1.0).asDiagonal(), free, {1.0, 0.5});
}

TEST(SingleJoint, SticksInsideItsCone) {
  const SingleJoint joint = one_joint({1.0, 0.9});
  EXPECT_EQ(joint.state, JointState::stick);
  EXPECT_EQ(joint.reaction, Local(1.0, 0.9));
}

TEST(SingleJoint, OpensWhenPulledBeyondItsTip) {
  const SingleJoint joint = one_joint({-3.0, 0.4});
  EXPECT_EQ(joint.state, JointState::open);
  EXPECT_EQ(joint.reaction, Local(-1.0, 0.0));
}

TEST(SingleJoint, SlipsAgainstTheForce) {
  const SingleJoint forward = one_joint({0.0, -2.0}), backward = one_joint({0.0, 2.0});
  EXPECT_EQ(forward.state, JointState::slip_forward);
  EXPECT_LT((forward.reaction - Local(0.0, -0.5)).norm(), 1e-15);
  EXPECT_EQ(backward.state, JointState::slip_backward);
  EXPECT_LT((backward.reaction - Local(0.0, 0.5)).norm(), 1e-15);
}

// Gaps u = S⁻¹ (r − f) of joints whose directions act on each other keep the law.
TEST(SingleJoint, KeepsTheLawWhereDirectionsActOnEachOther) {
  Eigen::Matrix2d S;
  S << 2.0, 0.7, 0.7, 1.0;
  const JointLaw law{1.0, 0.5};
  for (int i = 0; i < 360; ++i) {
    const double angle = i * test::degree;
    const Local free = 3.0 * Local(std::cos(angle), std::sin(angle));
    const auto [reaction, state] = solve_single_joint(S, free, law);
    const Local gap = S.inverse() * (reaction - free);
    EXPECT_LT(law_residual(reaction, gap, law, 1.0).norm(), 1e-14) << i;
    EXPECT_EQ(state_of(reaction, gap, state, law, 1.0), state) << i;
  }
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
