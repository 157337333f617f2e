// Steps to which sweeps, or one of several ways, find no good answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/dynamics/step_control.hpp"
#include "sim/dynamics/time_stepping.hpp"
#include "sim/simulate.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

// So many sweeps are enough for some steps: at 440 of seed 10 for the first one alone, at 481 for
// the first two and the fourth.
Scene short_of_sweeps(std::uint64_t seed, int sweeps) {
  Scene scene = test::small_scene(45.0, 4, 3);
  scene.joints.seed = seed;
  scene.loading.strain_rate = 1e4;
  scene.solver.regime = Regime::dynamic;
  scene.solver.contact = ContactMethod::gauss_seidel;
  scene.solver.tolerance = 1e-4;
  scene.solver.max_iterations = sweeps;
  return scene;
}

TEST(StepChosen, KeepsTheAnswerOfALongerStepWhereTwoShorterHaveNone) {
  HAVERS_SLOW;
  const Scene scene = short_of_sweeps(10, 481);
  double seen = 0.0;
  const Simulation run =
      run_in_chosen_steps(scene, [&](const Progress& progress) { seen = progress.point.time; });
  EXPECT_EQ(run.status, SimulationStatus::broken);
  EXPECT_EQ(run.step, first_step(scene) / 8.0);
  std::vector<double> strengths;  // of the steps that have an answer, by their halvings
  for (const int halvings : {0, 1, 2, 3, 4, 5}) {
    const Simulation one = run_in_steps(scene, {std::ldexp(first_step(scene), -halvings), true});
    EXPECT_EQ(one.status == SimulationStatus::not_converged, halvings == 2 || halvings > 3);
    if (one.status == SimulationStatus::broken) strengths.push_back(one.strength);
  }
  ASSERT_EQ(strengths.size(), 3U);
  EXPECT_EQ(strengths[2], run.strength);
  EXPECT_NEAR(run.step_error.value().strength,
              std::max(std::abs(1.0 - strengths[0] / strengths[1]),
                       std::abs(1.0 - strengths[1] / strengths[2])),
              1e-12);
  EXPECT_THAT(run.regime_ground, testing::HasSubstr("two at most, changed"));
  EXPECT_THAT(run.regime_ground,
              testing::HasSubstr("; runs of shorter ones have no answer: a step"));
  EXPECT_EQ(seen, run.curve.back().time) << "who watches sees the answer last";
}

// From rest 100 sweeps are enough for short steps alone: the first takes more than 150, half of it
// fewer than 90.
TEST(StepChosen, IsShorterThanThoseWithoutAnAnswer) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(0.0, 3, 3);
  scene.solver.regime = Regime::dynamic;
  scene.loading.strain_rate = 1e4;
  scene.loading.start = Start::rest;
  scene.solver.contact = ContactMethod::gauss_seidel;
  scene.solver.tolerance = 1e-5;
  scene.solver.max_iterations = 100;
  const Simulation longest = run_in_steps(scene, {.step = first_step(scene)}, {});
  ASSERT_EQ(longest.status, SimulationStatus::not_converged);
  const Simulation run = simulate(scene);
  EXPECT_EQ(run.status, SimulationStatus::broken);
  EXPECT_LT(run.step, first_step(scene));
  EXPECT_FALSE(std::isnan(run.step_error->strength));
}

TEST(StepChosen, IsNotTrustedWhereNoShorterStepHasAnAnswer) {
  HAVERS_SLOW;
  const Scene scene = short_of_sweeps(10, 440);
  const Simulation run = simulate(scene);
  EXPECT_EQ(run.step, first_step(scene));
  EXPECT_EQ(run.status, SimulationStatus::broken);
  EXPECT_TRUE(std::isnan(run.step_error.value().strength));
  EXPECT_THAT(run.why_not_trusted(), testing::HasSubstr("no run of half of it has an answer"));
}

// Two sweeps are enough for none.
TEST(StepChosen, IsHalvedTenTimesWhereNoneHasAnAnswer) {
  Scene scene = test::small_scene(0.0, 3, 3);
  scene.solver.regime = Regime::dynamic;
  scene.loading.strain_rate = 1e4;
  scene.solver.contact = ContactMethod::gauss_seidel;
  scene.solver.tolerance = 1e-5;
  scene.solver.max_iterations = 2;
  const Simulation run = run_in_chosen_steps(scene, {});
  EXPECT_EQ(run.status, SimulationStatus::not_converged);
  EXPECT_EQ(run.step, first_step(scene) / 1024.0);
  EXPECT_TRUE(std::isnan(run.step_error.value().failure_strain));
}

// Of one step among thousands the first way has an answer with a residual of 2e-8, and another one
// of 1e-13: layers a hundred times as soft as their neighbours, strong friction.
TEST(SimulateDynamic, TakesABetterAnswerWhereAnotherWayHasOne) {
  HAVERS_SLOW;
  Scene scene = test::dynamic_scene(-74.27466580391854, 3.360110374154835e-10);
  scene.assembly = {.layers = 2,
                    .fibres = 4,
                    .fibre_length = 20e-6,
                    .fibre_height = 10e-6,
                    .orientation = scene.assembly.orientation,
                    .refinement = 2};
  scene.material.plane = Plane::strain;
  scene.material.layer_contrast = 0.0044345562558848845;
  scene.joints.head_tail = 34.99251693866912e6;
  scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, 2.716425092626798);
  scene.joints.head_tail_shear = 21.551355691177417e6;
  scene.joints.flank_tension = 47.078409685503544e6;
  scene.joints.scatter = 0.0;
  scene.joints.missing = 0.3;
  scene.joints.friction = 5.0;
  scene.joints.seed = 6209475799514598909U;
  scene.loading = {.strain_rate = 26702.814019736532,
                   .lateral = Lateral::free,
                   .start = Start::rest,
                   .max_strain = 0.00807519621661595,
                   .end_fraction = 0.05};
  EXPECT_LE(simulate(scene).worst_residual, 1e-9);
}

}  // namespace
}  // namespace havers::sim
