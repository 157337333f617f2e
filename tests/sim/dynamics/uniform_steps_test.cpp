// Steps of uniform motion before the first break, which runs leap over or take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/bench/watched_run.hpp"
#include "sim/dynamics/step_control.hpp"
#include "sim/dynamics/time_stepping.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

// What is no whole step goes at once.
TEST(UniformSteps, AreTakenWhereNothingIsLeftOut) {
  Scene scene = test::dynamic_scene();
  scene.solver.step.reset();
  scene.solver.leave_out = false;
  const double step = first_step(scene), of_one = scene.loading.strain_rate * step;
  const Simulation run = run_in_steps(scene, {.step = step, .leap = true}, {});
  EXPECT_EQ(run.leapt_strain, 0.0);
  for (std::size_t i = 1; i < run.curve.size(); ++i)
    EXPECT_LT(run.curve[i].strain - run.curve[i - 1].strain, 2.0 * of_one) << i;
  EXPECT_GT(run.steps, run.first_break_strain / of_one);
  const double first = first_break_by_uniform_stress(scene);
  EXPECT_NEAR(run.first_break_strain / first, 1.0, 1e-8);
  EXPECT_NEAR(static_cast<double>(run.uniform_steps) * of_one, first - 3.0 * of_one, of_one)
      << "after two steps, to one before";
  for (const LeftOut& left_out : run.left_out)
    EXPECT_THAT(left_out.what, testing::Not(testing::HasSubstr("time steps")));
}

// 380 000 steps of the last run are more than the quarter of a million that end a halving.
TEST(UniformSteps, DoNotCountWhereAStepIsHalved) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(0.0, 1, 2);
  scene.joints.scatter = 0.0;
  scene.solver.regime = Regime::dynamic;
  scene.loading.strain_rate = 1000.0;
  scene.solver.step_accuracy = 0.02;
  const Simulation quick = run_in_chosen_steps(scene);
  scene.solver.leave_out = false;
  const Simulation all = run_in_chosen_steps(scene);
  EXPECT_GT(all.steps, 250'000);
  EXPECT_EQ(quick.step, all.step);
  EXPECT_EQ(quick.uniform_steps, all.uniform_steps);
  EXPECT_NEAR(quick.strength / all.strength, 1.0, 1e-9);
}

// Missing joints set waves free from the start; viscosity does not; and a limit of strain may come
// before the first break.
TEST(UniformSteps, AreTheSameWhereNothingIsLeftOut) {
  struct Case {
    const char* name;
    bool uniform;
    void (*change)(Scene&);
  };
  for (const Case& wall :
       {Case{"missing", false, [](Scene& s) { s.joints.missing = 0.05; }},
        Case{"from rest", false, [](Scene& s) { s.loading.start = Start::rest; }},
        Case{"viscous", true, [](Scene& s) { s.material.viscosity = 1e-7; }},
        Case{"strain limit", true, [](Scene& s) { s.loading.max_strain = 1e-3; }}}) {
    Scene scene = test::small_scene(0.0, 3, 3);
    scene.solver.regime = Regime::dynamic;
    scene.loading.strain_rate = 1e4;
    wall.change(scene);
    const double step = first_step(scene);
    const Simulation quick = run_in_steps(scene, {.step = step, .leap = true});
    scene.solver.leave_out = false;
    const Simulation all = run_in_steps(scene, {.step = step, .leap = true});
    EXPECT_EQ(quick.uniform_steps > 0, wall.uniform) << wall.name;
    EXPECT_EQ(quick.uniform_steps, all.uniform_steps) << wall.name;
    EXPECT_EQ(quick.status, all.status) << wall.name;
    EXPECT_EQ(quick.broken_joints, all.broken_joints) << wall.name;
    EXPECT_EQ(std::isnan(quick.crossings), std::isnan(all.crossings)) << wall.name;
    EXPECT_NEAR(quick.strength / all.strength, 1.0, 1e-9) << wall.name;
    EXPECT_NEAR(quick.modulus / all.modulus, 1.0, 1e-9) << wall.name;
  }
}

}  // namespace
}  // namespace havers::sim
