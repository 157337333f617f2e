#include "sim/dynamics/step_control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/bench/watched_run.hpp"
#include "sim/dynamics/time_stepping.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/outcome.hpp"
#include "sim/simulate.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

Scene without_step(double orientation_deg) {
  Scene scene = test::dynamic_scene(orientation_deg);
  scene.solver.step.reset();
  return scene;
}

class StepControl : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Orientation, StepControl, testing::Values(0.0, 45.0, 90.0));

// The bonded specimen's stress is uniform, so the first break is known in closed form.
TEST_P(StepControl, LeapsToTheFirstBreakAndNotPastIt) {
  const Scene scene = without_step(GetParam());
  const double first = first_break_by_uniform_stress(scene);
  const Simulation run = run_in_steps(scene, {.step = 1e-9, .leap = true}, {});
  EXPECT_NEAR(run.first_break_strain / first, 1.0, 1e-7);
  EXPECT_GT(run.leapt_strain, 0.9 * first);
  EXPECT_NEAR(run.modulus / scene.material.young, 1.0, 1e-9);
  EXPECT_LE(run.energy_defect, 1e-10);
}

TEST(StepLimit, EndsARunThatDoesNotBreakAndIsNotToBeTrusted) {
  const Scene scene = without_step(0.0);
  const Simulation run = run_in_steps(scene, {.step = 1e-9, .leap = true, .most = 7}, {});
  EXPECT_EQ(run.status, SimulationStatus::step_limit);
  EXPECT_EQ(run.steps, 7);
  EXPECT_THAT(run.why_not_trusted(), testing::HasSubstr("time steps were taken"));
}

// At 0 degrees the strength goes up and down with every halving, and no end is seen: what is said
// of that is right within a factor of three.
TEST_P(StepControl, FindsTheAnswerOfMuchSmallerSteps) {
  HAVERS_SLOW;
  const Scene scene = without_step(GetParam());
  const Simulation run = run_in_chosen_steps(scene, {});
  const StepError said = run.step_error.value();
  const Simulation finer = run_in_steps(scene, {.step = run.step / 4.0, .leap = true}, {});
  const bool settles = GetParam() != 0.0;
  ASSERT_LT(said.failure_strain, settles ? 0.5e-3 : 2e-3);
  ASSERT_LT(said.strength, settles ? 0.5e-3 : 3e-2);
  EXPECT_NEAR(run.failure_strain / finer.failure_strain, 1.0,
              settles ? 2e-3 : 3.0 * said.failure_strain);
  EXPECT_NEAR(run.strength / finer.strength, 1.0, settles ? 2e-3 : 3.0 * said.strength);
  EXPECT_NEAR(run.strength_without_ringing() / finer.strength_without_ringing(), 1.0, 3e-3);
}

// Halvings once changed little by chance, far from the limit.
TEST(StepChosen, FindsTheLimitOfAViscousWall) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(0.0, 4, 3);
  scene.material.viscosity = 1e-8;
  scene.joints.head_tail = 50e6;
  scene.joints.flank = 10e6;
  scene.loading.strain_rate = 1e3;
  scene.loading.max_strain = 0.02;
  scene.solver.regime = Regime::dynamic;
  const Simulation run = run_in_chosen_steps(scene, {});
  const Simulation finer = run_in_steps(scene, {.step = 3e-11, .leap = true}, {});
  EXPECT_LT(run.step_error.value().largest(), 2e-3);
  EXPECT_NEAR(run.failure_strain / finer.failure_strain, 1.0, 1e-3);
  EXPECT_NEAR(run.strength / finer.strength, 1.0, 3e-3);
}

// The stress has its peak at nearly the same strain whatever the step, and is another there.
TEST(StepChosen, StandsForTheStrengthToo) {
  HAVERS_SLOW;
  Scene scene = without_step(0.0);
  const Simulation run = run_in_chosen_steps(scene, {});
  const Simulation twice = run_in_steps(scene, {.step = 2.0 * run.step, .leap = true}, {});
  EXPECT_NEAR(run.step_error.value().strength, std::abs(1.0 - twice.strength / run.strength),
              1e-12);
  EXPECT_LT(std::abs(1.0 - twice.failure_strain / run.failure_strain),
            0.1 * run.step_error->strength);
}

// τε̇ more stress from the first moment on, and no other motion.
TEST_P(StepControl, LeapsWithViscosityToo) {
  HAVERS_SLOW;
  Scene scene = without_step(GetParam());
  scene.material.viscosity = 1e-8;
  scene.loading.strain_rate = 1e4;
  const double first = first_break_by_uniform_stress(scene) - 1e-4;
  const Simulation run = run_in_steps(scene, {.step = 1e-10, .leap = true}, {});
  EXPECT_NEAR(run.first_break_strain / first, 1.0, 1e-6);
  EXPECT_LE(run.energy_defect, 1e-10);
}

// The ends that its only joint sets free ring before a wave can have come to the end of the fibre.
TEST(StepChosen, RingsAfterABreakButLittleInTheMeanOverAWave) {
  Scene scene = test::small_scene(0.0, 1, 2);
  scene.joints.scatter = 0.0;
  scene.loading.strain_rate = 10.0;
  scene.solver.step_accuracy = 0.05;
  scene.solver.regime = Regime::quasi_static;
  const double limit = simulate(scene).strength;
  scene.solver.regime = Regime::dynamic;
  const Simulation run = simulate(scene);
  EXPECT_GT(run.strength / limit, 1.05);
  EXPECT_NEAR(run.strength_over_a_wave / limit, 1.0, 0.01);
  EXPECT_NEAR(run.ringing, run.strength / run.strength_over_a_wave - 1.0, 1e-3);
}

// Single waves after the break, which every step changes by tenths, are no strength; without them
// the run bears what it bears in the limit.
TEST(StepChosen, KnowsTheStrengthWithoutWavesWhereStepsChangeThePeak) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(60.0, 5, 4);
  scene.joints.head_tail = 50e6;
  scene.joints.flank = 10e6;
  scene.joints.friction = 0.3;
  scene.joints.scatter = 1.0;
  scene.joints.seed = 134;
  const double limit = simulate(scene).strength;
  scene.loading.strain_rate *= 2e-4 / choose_regime(scene).inertia_number;
  scene.solver.regime = Regime::dynamic;
  const Simulation run = simulate(scene);
  ASSERT_GT(run.step_error.value().strength, 0.03);
  EXPECT_GT(run.strength / limit, 1.1);
  EXPECT_LT(run.step_error->over_a_wave, 1e-3);
  EXPECT_NEAR(run.strength_without_ringing() / limit, 1.0, 1e-3);
  EXPECT_TRUE(run.trusted()) << run.why_not_trusted();
  EXPECT_THAT(run.reservation(), testing::HasSubstr("waves that ring"));
}

// So fast that the stress rises by a fifth while a wave runs through.
TEST(StepGiven, DoesNotTakeTheRiseOfALoadForRinging) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(0.0, 10, 20);
  scene.solver.regime = Regime::dynamic;
  scene.loading.strain_rate = 1000.0;
  scene.solver.step = 2e-8;
  const Simulation run = simulate(scene);
  EXPECT_GT(run.strength / run.strength_over_a_wave, 1.05);
  EXPECT_NEAR(run.strength_without_ringing() / run.strength, 1.0, 0.02);
}

TEST(StepChosen, IsNotLeaptOverWhereTheMotionIsNotUniform) {
  HAVERS_SLOW;
  Scene scene = without_step(0.0);
  scene.loading.start = Start::rest;
  EXPECT_EQ(run_in_steps(scene, {.step = 1e-8, .leap = true}, {}).leapt_strain, 0.0);
}

TEST(StepChosen, SaysWhatItsLastHalvingChanged) {
  HAVERS_SLOW;
  Scene scene = without_step(0.0);
  scene.solver.step_accuracy = 0.5;
  const Simulation run = simulate(scene);
  EXPECT_EQ(run.step, first_step(scene) / 4.0) << "two halvings agree to a quarter";
  EXPECT_NE(run.regime_ground.find("two at most, changed the failure strain by up to"),
            std::string::npos);
  EXPECT_TRUE(std::any_of(run.left_out.begin(), run.left_out.end(), [](const LeftOut& left_out) {
    return left_out.what.starts_with("time steps up to a strain of");
  }));
}

// The motion is uniform, but rounding of velocities over so short a time is an acceleration.
TEST(StepChosen, LeapsHoweverShortItIs) {
  HAVERS_SLOW;
  const Scene scene = without_step(20.0);
  EXPECT_EQ(run_in_steps(scene, {.step = 1e-12, .leap = true, .most = 3}).leapt_strain, 0.0);
  EXPECT_GT(run_in_steps(scene, {.step = 1e-12, .leap = true, .most = 1000}).leapt_strain, 1e-3);
}

TEST(StepChosen, EndsWhenAskedTo) {
  EXPECT_EQ(run_in_chosen_steps(without_step(0.0), {}, [] { return true; }).status,
            SimulationStatus::cancelled);
}

// Half a run is no second opinion on the first.
TEST(StepChosen, HasNoErrorWhereARunOfItsHalvingWasStopped) {
  double last = 0.0;
  int runs = 0;
  const auto count_runs = [&](const Progress& progress) {
    runs += progress.point.time < last || runs == 0 ? 1 : 0;
    last = progress.point.time;
  };
  const Simulation run =
      run_in_chosen_steps(without_step(0.0), count_runs, [&] { return runs == 2; });
  EXPECT_EQ(run.status, SimulationStatus::cancelled);
  EXPECT_TRUE(std::isnan(run.step_error.value().failure_strain));
  EXPECT_THAT(run.regime_ground, testing::Not(testing::HasSubstr("halving")));
}

TEST(StepChosen, IsDoubtedWhereTenMillionEndSoonAfterTheFirstBreak) {
  Scene scene = without_step(0.0);
  EXPECT_EQ(doubt_about_steps(scene), "");
  scene.loading.strain_rate = 1e-3;
  EXPECT_THAT(doubt_about_steps(scene), testing::HasSubstr("a strain of at most 0.00098 % beyond"));
  Scene given = scene, limit = scene;
  given.solver.step = 1.0;
  EXPECT_EQ(doubt_about_steps(given), "") << "refused where it is too short";
  limit.solver.regime = Regime::automatic;
  EXPECT_EQ(doubt_about_steps(limit), "");
  scene.loading.strain_rate = 1000.0;
  scene.solver.leave_out = false;
  EXPECT_THAT(doubt_about_steps(scene), testing::HasSubstr("in the first run some 3.9e+03, in"));
}

TEST(FirstStep, IsAQuarterOfTheTimeThatAWaveTakesAcrossAFibre) {
  Scene scene = without_step(0.0);
  const double wave = std::sqrt(13e9 / 2000.0);
  EXPECT_NEAR(first_step(scene), 0.25 * 10e-6 / wave, 1e-20);
  scene.loading.start = Start::rest;
  EXPECT_NEAR(first_step(scene), 0.5 * 100e-6 / wave, 1e-20);
}

// Halved so often that it is a fiftieth of the strain to failure at most. Thresholds that are read
// back are their draw's, of another median, and have the same.
TEST(FirstStep, IsHalvedToAFiftiethOfTheTimeToFailure) {
  Scene scene = without_step(0.0);
  scene.loading.start = Start::rest;
  const double whole = first_step(scene);
  scene.loading.strain_rate = 1e5;
  const double most = 0.02 * (50e6 / 13e9) / 1e5, step = first_step(scene);
  EXPECT_LE(step, most);
  EXPECT_GT(2.0 * step, most);
  const double halvings = std::log2(whole / step);
  EXPECT_EQ(halvings, std::round(halvings));
  scene.joints.thresholds =
      draw_thresholds(scene, build_assembly(scene.assembly, scene.loading.lateral));
  EXPECT_EQ(first_step(scene), step);
}

}  // namespace
}  // namespace havers::sim
