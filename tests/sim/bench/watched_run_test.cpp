#include "sim/bench/watched_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

class FirstBreak : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Orientation, FirstBreak, testing::ValuesIn(test::orientations));

TEST_P(FirstBreak, IsThatOfTheUniformStress) {
  for (const Plane plane : {Plane::stress, Plane::strain}) {
    Scene scene = test::small_scene(GetParam());
    scene.material.plane = plane;
    scene.solver.leave_out = false;  // the limit would take that stress for what it has solved for
    EXPECT_NEAR(first_break_by_uniform_stress(scene) / simulate(scene).first_break_strain, 1.0,
                1e-9);
  }
}

// The first layer across is a soft one, and the last may be cut: of 50 µm three layers of five are
// soft, of 63 µm 3.3 of 6.3.
TEST(BondedModulus, CountsTheLayersThatLieAcrossTheLoad) {
  for (const double length : {40e-6, 50e-6, 47e-6, 63e-6}) {
    Scene scene = test::small_scene(90.0, 4, 1);
    scene.assembly.fibre_length = length;
    scene.material.layer_contrast = 0.01;
    scene.material.poisson = 0.0;
    scene.loading.max_strain = 1.0;
    const Simulation run = simulate(scene);
    EXPECT_NEAR(bonded_modulus(scene) / run.modulus, 1.0, 1e-9) << length;
    EXPECT_NEAR(first_break_by_uniform_stress(scene) / run.first_break_strain, 1.0, 1e-9) << length;
  }
}

TEST(WatchedRun, TakesNoMissingJointForTheFirstBreak) {
  Scene scene = test::small_scene(20.0);
  const double first = first_break_by_uniform_stress(scene);
  scene.joints.missing = 0.3;
  EXPECT_GE(first_break_by_uniform_stress(scene), first);
  EXPECT_TRUE(std::isfinite(first_break_by_uniform_stress(scene)));
}

TEST(WatchedRun, TakesTheForcesAtTheStrainAskedFor) {
  const Scene scene = test::dynamic_scene(30.0);
  const double strain = 0.4 * first_break_by_uniform_stress(scene);
  const WatchedRun run = watch(scene, {.bonded_strain = strain}, {});
  const Eigen::VectorXd expected = bonded_forces_at(scene, strain);
  ASSERT_EQ(run.bonded_forces.size(), expected.size());
  EXPECT_LT((run.bonded_forces - expected).norm(), 1e-9 * expected.norm());
}

// Steps of 20 ps would be 200 000 to the first break.
TEST(WatchedRun, TakesTheForcesOfARunThatLeapsFromTheRowsAroundTheLeap) {
  HAVERS_SLOW;
  for (const double viscosity : {0.0, 1e-7}) {
    Scene scene = test::dynamic_scene(30.0);
    scene.loading.strain_rate = 1000.0;
    scene.loading.max_strain = 1.01 * first_break_by_uniform_stress(scene);
    scene.material.viscosity = viscosity;
    scene.solver.step = 2e-11;
    scene.solver.leap = true;
    const double strain = 0.4 * first_break_by_uniform_stress(scene);
    const WatchedRun run = watch(scene, {.bonded_strain = strain}, {});
    EXPECT_GT(run.simulation.leapt_strain, strain);
    EXPECT_LT(run.simulation.steps, 10'000);
    const double late = strain + viscosity * scene.loading.strain_rate;  // K(q + τv)
    const Eigen::VectorXd expected = bonded_forces_at(scene, late);
    ASSERT_EQ(run.bonded_forces.size(), expected.size());
    // The motion counts as uniform to 1e-9 of its forces.
    EXPECT_LT((run.bonded_forces - expected).norm(), 3e-9 * expected.norm()) << viscosity;
    scene.loading.max_strain = 0.5 * strain;
    EXPECT_EQ(watch(scene, {.bonded_strain = strain}, {}).bonded_forces.size(), 0);
  }
}

TEST(WatchedRun, TakesTheForcesOfTheLimitFromTheIntactSpecimen) {
  for (const bool leave_out : {true, false}) {
    Scene scene = test::small_scene(30.0);
    scene.solver.leave_out = leave_out;
    const Eigen::VectorXd expected = bonded_forces_at(scene, 1e-3);
    const WatchedRun run = watch(scene, {.bonded_strain = 1e-3}, {});
    ASSERT_EQ(run.bonded_forces.size(), expected.size());
    EXPECT_LT((run.bonded_forces - expected).norm(), 1e-9 * expected.norm());
    scene.joints.missing = 0.1;
    EXPECT_EQ(watch(scene, {.bonded_strain = 1e-3}, {}).bonded_forces.size(), 0);
  }
}

// In the limit both runs may begin at one strain.
TEST(WatchedRun, ShowsTheBreaksOfTheRunThatCountsWhereItIsDoneAgain) {
  Scene scene = test::small_scene(0.1, 6, 5);
  scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, 3.0);
  scene.joints.scatter = 0.5;
  scene.joints.friction = 1.4;
  scene.joints.seed = 728;
  scene.loading.lateral = Lateral::free;
  std::size_t last = 0;
  int runs = 1;
  simulate(scene, [&](const Progress& progress) {
    runs += progress.row <= last ? 1 : 0;
    last = progress.row;
  });
  ASSERT_GT(runs, 1);
  const WatchedRun run = watch(scene, {}, {});
  EXPECT_EQ(run.order.size(), static_cast<std::size_t>(run.simulation.broken_joints));
}

TEST(WatchedRun, IsComparedAsFarAsItBreaksLikeItsReference) {
  WatchedRun reference;
  reference.order = {7, 3, 5};
  reference.forces_at_break = {Eigen::Vector2d(3.0, 4.0), Eigen::Vector2d(1e-12, 0.0),
                               Eigen::Vector2d(9.0, 9.0)};
  WatchedRun run = reference;
  run.order = {7, 3, 2};
  run.forces_at_break[1].x() = 0.0;
  EXPECT_EQ(same_breaks(run, reference), 2U);
  EXPECT_NEAR(force_error(run, reference), 1e-12 / 5.0, 1e-20);  // the load has gone
  run.order.front() = 1;
  EXPECT_EQ(same_breaks(run, reference), 0U);
  EXPECT_TRUE(std::isnan(force_error(run, reference)));
}

TEST(WatchedRun, ListsTheBreaksInTheirOrder) {
  const Scene scene = test::dynamic_scene();
  const WatchedRun run = watch(scene, {}, {});
  ASSERT_EQ(static_cast<int>(run.order.size()), run.simulation.broken_joints);
  EXPECT_EQ(run.order.size(), run.forces_at_break.size());
  double before = 0.0;
  for (const int joint : run.order) {
    const double strain = run.simulation.joints[static_cast<std::size_t>(joint)].broken_at_strain;
    EXPECT_GE(strain, before);
    before = strain;
  }
}

TEST(WatchedRun, StopsAtTheTimeLimitAndWhenAskedTo) {
  const WatchedRun late = watch(test::dynamic_scene(), {.time_limit = 0.0}, {});
  EXPECT_TRUE(late.out_of_time);
  EXPECT_EQ(late.simulation.status, SimulationStatus::cancelled);
  const WatchedRun stopped = watch(test::dynamic_scene(), {}, [] { return true; });
  EXPECT_FALSE(stopped.out_of_time);
  EXPECT_EQ(stopped.simulation.status, SimulationStatus::cancelled);
}

}  // namespace
}  // namespace havers::sim
