#include "sim/dynamics/time_stepping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/outcome.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

TEST(SimulateDynamic, TakesTheStepOfTheScene) {
  Scene scene = test::dynamic_scene(0.0, 3e-8);
  scene.loading.max_strain = 3e-4;
  const Simulation simulation = simulate_dynamic(scene, {});
  EXPECT_EQ(simulation.step, 3e-8);
  EXPECT_EQ(simulation.leapt_strain, 0.0);
  EXPECT_EQ(simulation.steps, 10);
  ASSERT_EQ(simulation.curve.size(), 11U);
  EXPECT_DOUBLE_EQ(simulation.curve[10].time, 3e-7);
  EXPECT_DOUBLE_EQ(simulation.curve[10].strain, 3e-4);
}

// In uniform motion implicit Euler takes ½ (hε̇)² E of a volume each step, here of the few that are
// taken, and the loss is relative to all work, that of viscosity during the leap too.
TEST(RunInSteps, CountsTheViscousWorkOfALeap) {
  Scene scene = test::small_scene();
  scene.material.viscosity = 1e-6;
  scene.loading.strain_rate = 1000.0;
  scene.loading.max_strain = 1e-3;
  const Simulation run = run_in_steps(scene, {.step = 2e-8, .leap = true});
  ASSERT_GT(run.leapt_strain, 5e-4);
  const double stretch = run.step * scene.loading.strain_rate;
  const double numerical = run.steps * 0.5 * stretch * stretch * scene.material.young *
                           scene.assembly.width() * scene.assembly.height();
  const CurvePoint& end = run.curve.back();
  const double all = end.kinetic + end.elastic + end.dissipated + numerical;
  EXPECT_NEAR(run.numerical_loss * all / numerical, 1.0, 1e-6);
}

// 0.0123 % is a hundred steps of this rate, but for rounding, whatever the units.
TEST(SimulateDynamic, EndsWithTheStepThatReachesTheStrainLimit) {
  for (const double unit : {1.0, 3e-7, 7.7, 1.1e5}) {
    Scene scene = test::small_scene(0.0, 2, 2);
    scene.solver.regime = Regime::dynamic;
    scene.loading.strain_rate = 123.0 * unit;
    scene.loading.max_strain = 1.23e-4;
    scene.solver.step = 1e-8 / unit;
    scene.material.density *= 1.0 / (unit * unit);
    EXPECT_EQ(simulate(scene).steps, 100) << unit;
  }
}

// The joints' answer does not depend on the method that found it.
TEST(SimulateDynamic, GivesTheSameRunByGaussSeidelAsByTheActiveSet) {
  Scene scene = test::small_scene(0.0, 4, 3);
  scene.solver.step = 5e-9;
  scene.loading.strain_rate = 2e4;
  scene.loading.max_strain = 0.008;
  scene.solver.tolerance = 1e-10;
  scene.solver.max_iterations = 100000;
  const Simulation one = simulate_dynamic(scene, {});
  scene.solver.contact = ContactMethod::gauss_seidel;
  const Simulation other = simulate_dynamic(scene, {});
  EXPECT_EQ(to_string(one.status), to_string(other.status));
  EXPECT_GT(one.curve.back().broken_joints, 0);
  ASSERT_EQ(one.curve.size(), other.curve.size());
  for (std::size_t i = 0; i < one.curve.size(); ++i) {
    EXPECT_EQ(one.curve[i].broken_joints, other.curve[i].broken_joints);
    EXPECT_NEAR(one.curve[i].stress_right, other.curve[i].stress_right, 1e-5 * 50e6);
  }
}

// Sweeps leave the ties apart by their tolerance, and what ties do on the way is work (M4).
TEST(SimulateDynamic, CountsTheWorkOfTiesThatSweepsLeaveApart) {
  Scene scene = test::small_scene(0.0, 3, 3);
  scene.loading.lateral = Lateral::periodic;
  scene.solver.step = 2e-8;
  scene.solver.tolerance = 1e-6;
  scene.solver.contact = ContactMethod::gauss_seidel;
  scene.solver.regime = Regime::dynamic;
  const Simulation run = simulate(scene);
  EXPECT_EQ(run.status, SimulationStatus::broken);
  EXPECT_LE(run.energy_defect, 1e-12);
  EXPECT_TRUE(run.trusted()) << run.why_not_trusted();
}

// Waves in one fibre whose sides are tied: there is no joint that sweeps could ask.
TEST(SimulateDynamic, TiesAFibreAloneByGaussSeidelToo) {
  Scene scene = test::dynamic_scene();
  scene.assembly.layers = scene.assembly.fibres = 1;
  scene.loading.start = Start::rest;
  scene.loading.strain_rate = 1e4;
  scene.loading.max_strain = 5e-3;
  const Simulation direct = simulate(scene);
  scene.solver.contact = ContactMethod::gauss_seidel;
  const Simulation swept = simulate(scene);
  ASSERT_EQ(swept.curve.size(), direct.curve.size());
  for (std::size_t i = 0; i < swept.curve.size(); ++i)
    EXPECT_NEAR(swept.curve[i].stress_left, direct.curve[i].stress_left, 1e-6 * direct.strength);
}

// Before a wave has come across, a thin bar bears ρ c v at the side that is pulled.
Scene bar_from_rest(double step, int refinement) {
  Scene scene = test::dynamic_scene(0.0, step);
  scene.assembly.layers = scene.assembly.fibres = 1;
  scene.assembly.refinement = refinement;
  scene.loading.lateral = Lateral::free;
  scene.loading.start = Start::rest;
  scene.loading.strain_rate = 1e4;
  scene.loading.max_strain = 2e-4;
  return scene;
}

TEST(SimulateDynamic, StartsFromRestWithTheStressOfAWave) {
  const Scene scene = bar_from_rest(1e-9, 4);
  const double c = std::sqrt(scene.material.young / scene.material.density);
  const double v = scene.loading.strain_rate * scene.assembly.fibre_length;
  EXPECT_NEAR(simulate(scene).strength / (scene.material.density * c * v), 1.0, 0.03);
}

// What gives the held nodes their velocity at once is no stress, however short the step.
TEST(SimulateDynamic, FromRestBearsTheSameInEveryShortStep) {
  const double strength = simulate(bar_from_rest(1e-10, 1)).strength;
  EXPECT_NEAR(simulate(bar_from_rest(1e-12, 1)).strength / strength, 1.0, 0.1);
}

// A bar of joints that do not break, stretched from rest: the modulus is measured over 0.4 of its
// strain, while a wave crosses it by the speed of its softer layers.
TEST(SimulateDynamic, CountsCrossingsByTheSlowestLayers) {
  for (const double contrast : {1.0, 0.25}) {
    Scene scene = test::small_scene(0.0, 2, 2);
    scene.solver.regime = Regime::dynamic;
    scene.solver.step = 1e-8;
    scene.joints.head_tail = scene.joints.flank = 1e12;
    scene.loading.start = Start::rest;
    scene.loading.strain_rate = 1e4;
    scene.loading.max_strain = 5e-3;
    scene.material.layer_contrast = contrast;
    const double speed = std::sqrt(contrast * scene.material.young / scene.material.density);
    const double crossing = scene.assembly.width() / speed;
    EXPECT_NEAR(simulate(scene).crossings, 0.4 * 5e-3 / (1e4 * crossing), 1e-9) << contrast;
  }
}

// By the root of its modulus: of density there is as much as ever.
TEST(SimulateDynamic, CountsFewerCrossingsWhereMissingJointsMakeItSoft) {
  Scene scene = test::small_scene(0.0, 4, 3);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 1e-8;
  scene.joints.head_tail = scene.joints.flank = 1e12;
  scene.joints.missing = 0.3;
  scene.joints.seed = 3;
  scene.loading.strain_rate = 1e3;
  scene.loading.max_strain = 1e-3;
  const Simulation run = simulate(scene);
  const double crossing = scene.assembly.width() / wave_speed(scene.material);
  const double part = run.modulus / scene.material.young;
  EXPECT_GT(part, 0.1);
  EXPECT_LT(part, 0.9);
  EXPECT_NEAR(run.crossings, 0.4 * 1e-3 / (1e3 * crossing) * std::sqrt(part), 1e-9);
}

// A joint breaks near the right side while the wave is on its way: neither side bears much then, of
// a wall that is whole but for that.
TEST(SimulateDynamic, FromRestIsNotBrokenBeforeAWaveHasComeAcross) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(0.0, 10, 8);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 1e-9;
  scene.loading.start = Start::rest;
  scene.loading.strain_rate = 1e4;
  const double across = scene.assembly.width() / wave_speed(scene.material);
  Simulation run = simulate(scene);
  EXPECT_EQ(run.status, SimulationStatus::broken);
  EXPECT_GE(run.curve.back().time, across);
  scene.loading.max_strain = 0.9 * across * scene.loading.strain_rate;
  run = simulate(scene);
  EXPECT_GT(run.broken_joints, 0);
  EXPECT_EQ(run.status, SimulationStatus::strain_limit);
}

// The stress climbs a stair, whose slope is that of uniform motion but for a part of a step.
TEST(SimulateDynamic, FromRestHasAModulusToHalfOfWhatAWaveAdds) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(0.0, 4, 3);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 1e-9;
  scene.joints.head_tail = scene.joints.flank = 1e12;
  scene.loading.strain_rate = 1e3;
  const double across = scene.assembly.width() / wave_speed(scene.material);
  for (const double crossings : {3.0, 5.0, 10.0, 20.0}) {
    scene.loading.max_strain = crossings / modulus_stretch * across * scene.loading.strain_rate;
    scene.loading.start = Start::uniform;
    const double modulus = simulate(scene).modulus;
    scene.loading.start = Start::rest;
    const Simulation run = simulate(scene);
    EXPECT_NEAR(run.crossings, crossings, 0.01 * crossings);
    EXPECT_NEAR(run.modulus / modulus, 1.0, 0.5 / crossings) << crossings;
  }
}

// Where joints are missing uniform motion is none of equilibrium: before its waves have crossed the
// specimen, and after the last break, there is neither a modulus nor a mean strength.
TEST(SimulateDynamic, InUniformMotionHasTheModulusOfAShockWhereJointsAreMissing) {
  Scene scene = test::small_scene(45.0, 6, 4);
  scene.joints.scatter = 0.4;
  scene.joints.missing = 0.08;
  scene.joints.seed = 3;
  scene.loading.strain_rate = 1e4;
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 1e-9;
  const Simulation run = simulate(scene);
  EXPECT_TRUE(run.has_modulus_of_a_shock());
  EXPECT_TRUE(std::isnan(run.strength_over_a_wave));
  EXPECT_EQ(run.strength_without_ringing(), run.strength);
  scene.joints.missing = 0.0;
  EXPECT_FALSE(simulate(scene).has_modulus_of_a_shock());
  scene.material.layer_contrast = 0.5;
  EXPECT_TRUE(simulate(scene).has_modulus_of_a_shock());
  scene.assembly.orientation = 0.0;  // side by side
  EXPECT_FALSE(simulate(scene).has_modulus_of_a_shock());
}

// The path of joints that break together goes up beyond λ = 1000 before it comes back.
TEST(SimulateDynamic, FollowsAPathThatTurnsBackLate) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(15.0, 14, 14);
  scene.joints.scatter = 0.02;
  scene.loading.strain_rate = 1000.0;
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 3e-9;
  scene.loading.end_fraction = 0.8;
  EXPECT_EQ(simulate(scene).why_not_trusted(), "");
}

// Joints between layers have nearly the same threshold. Paths of so many lead nowhere, and sweeps
// end one joint from the answer.
TEST(SimulateDynamic, BreaksHundredsOfJointsInAFewSteps) {
  HAVERS_SLOW;
  struct Wall {
    double degrees, scatter, step;
    int size;
  };
  for (const Wall& wall : {Wall{30.0, 0.0, 1e-9, 14}, Wall{15.0, 0.05, 3e-9, 17}}) {
    Scene scene = test::small_scene(wall.degrees, wall.size, wall.size);
    scene.joints.scatter = wall.scatter;
    scene.loading.strain_rate = 1000.0;
    scene.solver.regime = Regime::dynamic;
    scene.solver.step = wall.step;
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.why_not_trusted(), "") << wall.degrees;
    int most = 0;  // that break in ten steps
    for (std::size_t i = 10; i < simulation.curve.size(); ++i)
      most = std::max(most,
                      simulation.curve[i].broken_joints - simulation.curve[i - 10].broken_joints);
    EXPECT_GT(most, 200) << wall.degrees;
    EXPECT_LT(simulation.iterations, 10 * simulation.steps) << wall.degrees;
  }
}

// Strong cohesive friction, oblique fibres: a step may have several answers that keep the law.
TEST(SimulateDynamic, TakesTheAnswerOfSweepsWhereFrictionLeavesSeveral) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(45.0, 8, 5);
  scene.joints.seed = 4;
  scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, 0.5);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 10e-9;
  const Simulation direct = simulate(scene);
  scene.solver.leave_out = false;
  const Simulation with_all = simulate(scene);
  scene.solver.contact = ContactMethod::gauss_seidel;
  scene.solver.tolerance = 1e-10;
  scene.solver.max_iterations = 100'000;
  const Simulation by_sweeps = simulate(scene);
  for (const Simulation* other : {&with_all, &by_sweeps}) {
    ASSERT_EQ(direct.curve.size(), other->curve.size());
    for (std::size_t i = 0; i < direct.curve.size(); ++i)
      EXPECT_EQ(direct.curve[i].broken_joints, other->curve[i].broken_joints) << i;
    EXPECT_NEAR(direct.strength / other->strength, 1.0, 1e-6);
  }
}

}  // namespace
}  // namespace havers::sim
