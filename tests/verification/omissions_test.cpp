// What a run leaves out and how closely its solver is held change its cost, not its answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "sim/simulation.hpp"
#include "tests/support/broken_joints.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

// Curves as far as both go.
void expect_same_curve(const Simulation& one, const Simulation& other) {
  for (std::size_t i = 0; i < std::min(one.curve.size(), other.curve.size()); ++i) {
    const CurvePoint &a = one.curve[i], &b = other.curve[i];
    EXPECT_NEAR(a.strain, b.strain, 1e-9 * one.failure_strain) << "row " << i;
    EXPECT_NEAR(a.stress_right, b.stress_right, 1e-9 * one.strength) << "row " << i;
    EXPECT_NEAR(a.stress_left, b.stress_left, 1e-9 * one.strength) << "row " << i;
    EXPECT_EQ(a.broken_joints, b.broken_joints) << "row " << i;
  }
  EXPECT_NEAR(one.strength / other.strength, 1.0, 1e-9);
  EXPECT_NEAR(one.failure_strain / other.failure_strain, 1.0, 1e-9);
}

class SameRun : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Orientation, SameRun, testing::Values(0.0, 45.0));

TEST_P(SameRun, InTimeWhenNothingIsLeftOut) {
  for (const double step : {2e-9, 2e-8}) {
    Scene scene = test::dynamic_scene(GetParam(), step);
    const Simulation quick = simulate(scene);
    scene.solver.leave_out = false;
    const Simulation all = simulate(scene);
    EXPECT_GT(quick.broken_joints, 0);
    EXPECT_EQ(quick.curve.size(), all.curve.size());
    EXPECT_EQ(test::broken_joints(quick.joints), test::broken_joints(all.joints));
    expect_same_curve(quick, all);
  }
}

// Steps to the first break are taken or leapt over, and halved as often.
TEST_P(SameRun, InChosenStepsWhenNothingIsLeftOut) {
  HAVERS_SLOW;
  Scene scene = test::small_scene(GetParam(), 4, 3);
  scene.solver.regime = Regime::dynamic;
  scene.loading.strain_rate = 1e4;
  scene.solver.step_accuracy = 0.02;
  const Simulation quick = simulate(scene);
  scene.solver.leave_out = false;
  const Simulation all = simulate(scene);
  EXPECT_GT(quick.leapt_strain, 0.0);
  EXPECT_GT(all.steps, 2 * quick.steps);
  EXPECT_EQ(quick.step, all.step);
  EXPECT_EQ(test::broken_joints(quick.joints), test::broken_joints(all.joints));
  EXPECT_NEAR(quick.step_error->strength, all.step_error->strength, 1e-9);
  EXPECT_NEAR(quick.step_error->failure_strain, all.step_error->failure_strain, 1e-9);
  for (const auto value : {&Simulation::strength, &Simulation::failure_strain,
                           &Simulation::first_break_strain, &Simulation::modulus})
    EXPECT_NEAR(quick.*value / all.*value, 1.0, 1e-9);
  EXPECT_NEAR(quick.strength_without_ringing() / all.strength_without_ringing(), 1.0, 1e-9);
  for (std::size_t j = 0; j < quick.joints.size(); ++j)
    if (quick.joints[j].broken) {
      EXPECT_NEAR(quick.joints[j].broken_at_strain / all.joints[j].broken_at_strain, 1.0, 1e-9);
    }
}

// A run that leaves out the end of its avalanche has broken what the whole one had by then.
TEST_P(SameRun, InTheQuasiStaticLimitAsFarAsItGoes) {
  for (const double scatter : {0.2, 1.0}) {
    Scene scene = test::small_scene(GetParam(), 14, 10);
    scene.joints.scatter = scatter;
    const Simulation quick = simulate(scene);
    scene.solver.leave_out = false;
    std::vector<std::size_t> by_then;
    const Simulation all = simulate(scene, [&](const Progress& progress) {
      if (progress.row < quick.curve.size()) by_then = test::broken_joints(progress.joints());
    });
    EXPECT_LT(quick.curve.size(), all.curve.size());
    EXPECT_EQ(test::broken_joints(quick.joints), by_then);
    expect_same_curve(quick, all);
  }
}

// Where head-tail joints are far weaker than flanks, those bear when these have gone, and more.
TEST_P(SameRun, WhateverBearsOnceTheWeakerJointsHaveGone) {
  for (const double ratio : {0.03, 0.05, 0.1, 0.3}) {
    Scene scene = test::small_scene(GetParam(), 6, 7);
    scene.loading.lateral = Lateral::free;
    scene.loading.max_strain = 1.0;
    scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, ratio);
    scene.joints.scatter = 0.3;
    // Friction leaves several answers where a piece hangs on next to nothing, and rounding one of
    // them: so in 2 of the first 160 walls.
    for (const std::uint64_t seed : {2U, 3U}) {
      scene.joints.seed = seed;
      scene.solver.leave_out = true;
      const Simulation quick = simulate(scene);
      scene.solver.leave_out = false;
      const Simulation all = simulate(scene);
      EXPECT_NEAR(quick.strength / all.strength, 1.0, 1e-9) << ratio << ", " << seed;
      EXPECT_NEAR(quick.failure_strain / all.failure_strain, 1.0, 1e-9) << ratio;
    }
  }
}

// The direct solver is as exact whatever is asked for; sweeps end at the tolerance.
TEST_P(SameRun, HoweverTightTheTolerance) {
  struct Way {
    ContactMethod method;
    double step, rate, loosest;
  };
  for (const Way& way : {Way{ContactMethod::active_set, 2e-9, 1e4, 1e-5},
                         Way{ContactMethod::active_set, 2e-8, 1e3, 1e-5},
                         Way{ContactMethod::gauss_seidel, 2e-9, 1e4, 1e-8}}) {
    Scene scene = test::dynamic_scene(GetParam(), way.step);
    scene.assembly.layers = 4;
    scene.assembly.fibres = 3;
    scene.loading.strain_rate = way.rate;
    scene.solver.contact = way.method;
    scene.solver.max_iterations = 100000;
    scene.solver.tolerance = way.loosest;
    const Simulation loose = simulate(scene);
    EXPECT_GT(loose.broken_joints, 0);
    for (const double part : {1e-3, 1e-6}) {
      scene.solver.tolerance = std::max(1e-11, part * way.loosest);
      const Simulation tight = simulate(scene);
      EXPECT_TRUE(tight.trusted()) << tight.why_not_trusted();
      EXPECT_EQ(test::broken_joints(loose.joints), test::broken_joints(tight.joints));
      EXPECT_NEAR(loose.strength / tight.strength, 1.0, 1e-5);
      EXPECT_EQ(loose.failure_strain, tight.failure_strain);
    }
  }
}

// Each is said where it is made, and nowhere else.
TEST(Omissions, AreThoseOfTheRegimeAndTheContact) {
  struct Run {
    Regime regime;
    ContactMethod contact;
  };
  for (const bool leave_out : {true, false})
    for (const Run& run : {Run{Regime::quasi_static, ContactMethod::active_set},
                           Run{Regime::quasi_static, ContactMethod::gauss_seidel},
                           Run{Regime::dynamic, ContactMethod::active_set},
                           Run{Regime::dynamic, ContactMethod::gauss_seidel}}) {
      Scene scene = test::dynamic_scene(0.0, 2e-9);
      scene.solver.regime = run.regime;
      scene.solver.contact = run.contact;
      scene.solver.leave_out = leave_out;
      scene.loading.strain_rate = 1e4;
      scene.loading.max_strain = 1e-4;
      const bool limit = run.regime == Regime::quasi_static;
      const bool swept = !limit && run.contact == ContactMethod::gauss_seidel;
      const std::vector<LeftOut> list = simulate(scene).left_out;
      for (const auto& [what, is_left_out] :
           {std::pair{"inertia and time steps", limit},
            {"the friction problem of joints inside their cone", !swept},
            {"one operator for each body", leave_out},
            {"parts of the intact specimen's factor that repeat others", leave_out && !swept},
            {"contact of joints that opened", leave_out && !limit && !swept},
            {"contact of pieces that no bonded joint connects to an end", limit},
            {"digits beyond single precision in the forces of joints that are not next to break",
             leave_out && limit},
            {"rounding in the joint forces of the intact specimen", leave_out && limit}})
        EXPECT_EQ(std::ranges::count(list, what, &LeftOut::what), is_left_out ? 1 : 0)
            << what << (limit ? ", limit" : ", in time") << (swept ? ", swept" : "")
            << (leave_out ? "" : ", nothing left out");
    }
}

}  // namespace
}  // namespace havers::sim
