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

INSTANTIATE_TEST_SUITE_P(Degrees, JointSweepsAt, testing::Values(0.0, 30.0));

}  // namespace
}  // namespace havers::sim
