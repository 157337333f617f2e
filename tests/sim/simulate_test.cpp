#include "sim/simulate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/dynamics/time_stepping.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/simulation.hpp"
#include "tests/support/broken_joints.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

using testing::HasSubstr;

// (M12): a specimen of 1 m with c = 1000 m/s, torn at E/100.
Scene unit_scene(double rate) {
  Scene scene;
  scene.assembly.fibre_length = 0.1;
  scene.assembly.fibre_height = 0.01;
  scene.assembly.fibres = 10;
  scene.material.young = 1e9;
  scene.material.density = 1000.0;
  scene.joints.head_tail = 1e7;
  scene.loading.strain_rate = rate;
  return scene;
}

TEST(ChooseRegime, FollowsTheInertiaNumber) {
  const RegimeChoice slow = choose_regime(unit_scene(0.0019)),
                     fast = choose_regime(unit_scene(0.0021));
  EXPECT_NEAR(slow.inertia_number, 1.9e-4, 1e-12);
  EXPECT_EQ(slow.regime, Regime::quasi_static);
  EXPECT_EQ(fast.regime, Regime::dynamic);
  EXPECT_THAT(slow.ground, HasSubstr("inertia number 0.00019 is below 0.0002; waves"));
  EXPECT_THAT(fast.ground, HasSubstr("inertia number 0.00021 is not below 0.0002"));
}

TEST(ChooseRegime, GoesByTheWavesOfTheSoftestLayers) {
  Scene scene = unit_scene(0.0019);
  scene.material.layer_contrast = 0.25;
  EXPECT_NEAR(choose_regime(scene).inertia_number, 3.8e-4, 1e-12);
}

TEST(ChooseRegime, GoesByTheThresholdsThatAreGiven) {
  Scene scene = unit_scene(0.0019);
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  scene.joints.thresholds = draw_thresholds(scene, assembly);
  EXPECT_NEAR(choose_regime(scene).inertia_number, 1.9e-4, 0.05e-4);
  for (Threshold& threshold : scene.joints.thresholds) threshold.normal *= 0.01;
  EXPECT_NEAR(choose_regime(scene).inertia_number, 1.9e-2, 0.05e-2);
  EXPECT_EQ(choose_regime(scene).regime, Regime::dynamic);
}

TEST(ChooseRegime, KeepsTimeForWhatNeedsIt) {
  Scene viscous = unit_scene(1e-3), shock = viscous, stepped = viscous, swept = viscous;
  viscous.material.viscosity = 1e-6;
  shock.loading.start = Start::rest;
  stepped.solver.step = 1e-6;
  swept.solver.contact = ContactMethod::gauss_seidel;
  for (const Scene& scene : {viscous, shock, stepped, swept}) {
    const RegimeChoice choice = choose_regime(scene);
    EXPECT_EQ(choice.regime, Regime::dynamic);
    EXPECT_THAT(choice.ground, HasSubstr("needs time"));
  }
}

TEST(ChooseRegime, DoesWhatTheSceneAsksFor) {
  Scene scene = unit_scene(1e3);
  scene.solver.regime = Regime::quasi_static;
  EXPECT_EQ(choose_regime(scene).regime, Regime::quasi_static);
  EXPECT_THAT(choose_regime(scene).ground, HasSubstr("while auto runs in time from 0.0002 on"));
  scene = unit_scene(1e-9);
  EXPECT_THAT(choose_regime(scene).ground, testing::Not(HasSubstr("while auto")));
  scene.solver.regime = Regime::dynamic;
  EXPECT_EQ(choose_regime(scene).regime, Regime::dynamic);
  EXPECT_THAT(choose_regime(scene).ground, HasSubstr("asked for"));
}

TEST(Simulate, EndsWhenTheSpecimenIsBroken) {
  for (const Scene& scene : {test::small_scene(0.0, 12, 8), test::dynamic_scene()}) {
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.status, SimulationStatus::broken);
    EXPECT_TRUE(simulation.trusted());
    const bool in_time = simulation.regime == Regime::dynamic;
    const double part = in_time ? 0.3 : 0.995 - 25.0 / 96.0 - 0.002;  // of 96 fibres, d = 0.2
    EXPECT_NEAR(simulation.end_fraction_used, part, 1e-12);
    EXPECT_LT(simulation.curve.back().stress_right, part * simulation.strength);
    EXPECT_LT(simulation.curve.back().stress_left, part * simulation.strength);
    EXPECT_GT(simulation.broken_joints, 0);
  }
}

TEST(Simulate, EndsAtTheStrainLimit) {
  for (Scene scene : {test::small_scene(), test::dynamic_scene()}) {
    scene.loading.max_strain = 1e-3;
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.status, SimulationStatus::strain_limit);
    EXPECT_TRUE(simulation.trusted());
    EXPECT_NEAR(simulation.curve.back().strain, 1e-3, 1e-12);
    EXPECT_EQ(simulation.broken_joints, 0);
  }
}

// In one step there is but one point of the curve, whatever the strength it shows.
TEST(Simulate, IsNotTrustedWhereAStepLeadsToFailure) {
  Scene scene = test::dynamic_scene(45.0);
  const double time = simulate(scene).failure_strain / scene.loading.strain_rate;
  scene.solver.step = 0.05 * time;
  EXPECT_TRUE(simulate(scene).trusted());
  scene.solver.step = 0.25 * time;
  EXPECT_THAT(simulate(scene).why_not_trusted(), HasSubstr("time step"));
  scene.loading.max_strain = 2e-4;  // nothing breaks, and a bonded specimen's step is exact
  EXPECT_TRUE(simulate(scene).trusted());
}

TEST(Simulate, SaysWhenAStepDidNotConverge) {
  Scene scene = test::dynamic_scene(0.0, 1e-6);
  scene.solver.contact = ContactMethod::gauss_seidel;
  scene.solver.max_iterations = 3;
  scene.loading.start = Start::rest;
  const Simulation simulation = simulate(scene);
  EXPECT_EQ(simulation.status, SimulationStatus::not_converged);
  EXPECT_FALSE(simulation.trusted());
  EXPECT_GT(simulation.worst_residual, scene.solver.tolerance);
  EXPECT_THAT(simulation.why_not_trusted(), HasSubstr("; more max_iterations, contact"));
  EXPECT_EQ(simulation.curve.size(), 1U);  // from rest; what has no answer is no row
  EXPECT_EQ(simulation.displacements.norm(), 0.0);
  for (const double number : {simulation.strength, simulation.failure_strain, simulation.modulus})
    EXPECT_TRUE(std::isnan(number));
}

// Where nearly every fibre reaches from end to end, many layers can bear forces between their
// joints that no load asks for.
TEST(Simulate, SaysWhenForcesAreNotDetermined) {
  for (const Regime regime : {Regime::quasi_static, Regime::dynamic}) {
    Scene scene = test::small_scene(5.0, 300, 1);
    scene.solver.regime = regime;
    scene.solver.step = 2e-8;
    scene.loading.strain_rate = 1000.0;
    ASSERT_TRUE(scene.problems().empty());
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.status, SimulationStatus::not_determined);
    EXPECT_FALSE(simulation.trusted());
  }
}

// Such a scene has problems, and is not given to simulate.
TEST(RunInSteps, SaysWhenANumberLeftItsRange) {
  Scene scene = test::dynamic_scene();
  scene.loading.strain_rate = 1e150;
  scene.material.young = 1e300;
  const Simulation simulation = run_in_steps(scene, {.step = 4e-152}, {});
  EXPECT_EQ(simulation.status, SimulationStatus::not_finite);
  EXPECT_FALSE(simulation.trusted());
}

// Wherever it is: between two rows or, where sets and paths are looked for, within one.
TEST(Simulate, StopsWhenAskedToWithTheRowsItHas) {
  HAVERS_SLOW;
  Scene jammed = test::small_scene(2.0, 4, 3);
  jammed.joints.scatter = 1.0;
  jammed.joints.seed = 8;
  Scene swept = test::dynamic_scene();
  swept.solver.contact = ContactMethod::gauss_seidel;
  swept.solver.tolerance = 1e-3;
  for (const Scene& scene : {jammed, test::dynamic_scene(), swept}) {
    int asked = 0;
    const Simulation whole = simulate(scene, {}, [&asked] { return ++asked < 0; });
    ASSERT_GT(asked, whole.steps);
    const int times = asked;
    for (int stop = 1; stop <= times; stop += 1 + times / 12) {
      asked = 0;
      std::size_t rows = 1;  // and a row at the strain of the next break, in the limit
      const Simulation run = simulate(
          scene, [&rows](const Progress& progress) { rows = progress.row + 1; },
          [&] { return ++asked >= stop; });
      EXPECT_EQ(run.status, SimulationStatus::cancelled) << stop;
      EXPECT_FALSE(run.trusted());
      EXPECT_LE(asked, stop + 20);
      ASSERT_LE(rows, run.curve.size());
      EXPECT_LE(run.curve.size(), rows + 1);
      EXPECT_NEAR(run.curve.back().stress_right, whole.curve[run.curve.size() - 1].stress_right,
                  1e-9 * whole.strength);
      EXPECT_EQ(test::broken_joints(run.joints).size(),
                static_cast<std::size_t>(run.curve.back().broken_joints));
      EXPECT_TRUE(run.displacements.allFinite());
    }
  }
}

TEST(Simulate, IsTheSameWatchedOrNot) {
  for (Scene scene : {test::small_scene(0.0, 12, 8), test::dynamic_scene()}) {
    const Simulation alone = simulate(scene);
    std::vector<std::size_t> rows;
    const Simulation watched = simulate(scene, [&](const Progress& progress) {
      EXPECT_TRUE(progress.displacements().allFinite());
      rows.push_back(progress.row);
    });
    ASSERT_EQ(alone.curve.size(), watched.curve.size());
    EXPECT_EQ(alone.strength, watched.strength);
    EXPECT_EQ(alone.failure_strain, watched.failure_strain);
    EXPECT_EQ(alone.worst_residual, watched.worst_residual);
    EXPECT_EQ(alone.energy_defect, watched.energy_defect);
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(watched.steps));
    EXPECT_EQ(rows.back(), watched.curve.size() - 1);
  }
}

// Snapshots are made of what the observer sees.
TEST(Simulate, ShowsTheObserverDisplacementsOfEveryNode) {
  for (const Scene& scene : {test::small_scene(), test::dynamic_scene()}) {
    const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
    const auto dofs = static_cast<Eigen::Index>(2 * assembly.nodes.size());
    const Simulation simulation = simulate(scene, [&](const Progress& progress) {
      const Eigen::VectorXd displacements = progress.displacements();
      EXPECT_EQ(displacements.size(), dofs);
      EXPECT_EQ(progress.joints().size(), assembly.joints.size());
      if (displacements.size() != dofs) return;
      EXPECT_NEAR(displacements(2 * assembly.right.front()), progress.point.strain * assembly.width,
                  1e-12 * assembly.width);
    });
    ASSERT_EQ(simulation.displacements.size(), dofs);
    for (const int node : assembly.right)  // of the last row too
      EXPECT_NEAR(simulation.displacements(2 * node),
                  simulation.curve.back().strain * assembly.width, 1e-12 * assembly.width);
  }
}

TEST(Simulate, SaysWhatItLeftOut) {
  const auto words = [](const Simulation& simulation) {
    std::string all;
    for (const LeftOut& part : simulation.left_out) all += part.what + ": " + part.why + "\n";
    return all;
  };
  Scene scene = test::small_scene();
  EXPECT_THAT(words(simulate(scene)), HasSubstr("inertia and time steps"));
  EXPECT_THAT(words(simulate(scene)), HasSubstr("rounding in the joint forces"));
  EXPECT_THAT(words(simulate(scene)), HasSubstr("joints inside their cone"));
  scene.loading.lateral = Lateral::free;
  EXPECT_THAT(words(simulate(scene)), HasSubstr("periodic ties"));
  EXPECT_THAT(words(simulate(scene)), HasSubstr("viscosity: viscosity_s is 0"));
  EXPECT_THAT(words(simulate(scene)), testing::Not(HasSubstr("friction below")));
  scene.joints.friction = 0.0;
  EXPECT_THAT(words(simulate(scene)), HasSubstr("friction below 0.001"));
  scene.material.viscosity = 1e-6;  // and all the same the limit is asked for
  scene.loading.start = Start::rest;
  scene.solver.step = 1e-8;
  EXPECT_THAT(words(simulate(scene)),
              testing::AllOf(HasSubstr("viscosity: the quasi-static limit"),
                             HasSubstr("start from rest"), HasSubstr("step_s")));
  scene = test::dynamic_scene();
  scene.loading.max_strain = 1e-3;
  EXPECT_THAT(words(simulate(scene)), HasSubstr("viscosity"));
  EXPECT_THAT(words(simulate(scene)), HasSubstr("contact of joints that opened"));
  scene.solver.leave_out = false;
  EXPECT_THAT(words(simulate(scene)), testing::Not(HasSubstr("contact of joints that opened")));
  EXPECT_THAT(words(simulate(scene)), HasSubstr("joints inside their cone"));
  EXPECT_THAT(words(simulate(scene)), testing::Not(HasSubstr("half fibres")));
  for (const double degrees : {35.0, 58.0}) {
    scene = test::small_scene(degrees, 1, 5);
    EXPECT_THAT(words(simulate(scene)),
                HasSubstr(degrees == 35.0 ? "1 half fibre " : "2 half fibres "));
  }
}

TEST(Simulate, EndsWhereNothingIsLeftToBear) {
  Scene scene = test::small_scene(45.0, 2, 2);
  scene.joints.scatter = 0.0;
  scene.loading.end_fraction = 0.0;
  const Simulation simulation = simulate(scene);
  EXPECT_EQ(simulation.status, SimulationStatus::broken);
  EXPECT_TRUE(simulation.trusted()) << simulation.why_not_trusted();
}

TEST(Simulate, SaysThatTheErrorOfAGivenStepIsNotKnown) {
  Scene scene;
  scene.assembly.layers = scene.assembly.fibres = 2;
  scene.loading.strain_rate = 1000.0;
  scene.solver.step = 1e-8;
  const Simulation run = simulate(scene);
  EXPECT_FALSE(run.step_error.has_value());
  EXPECT_THAT(run.regime_ground, HasSubstr("its error is not known"));
  scene.solver.step.reset();
  scene.solver.regime = Regime::quasi_static;
  EXPECT_EQ(simulate(scene).step_error.value().largest(), 0.0);
}

}  // namespace
}  // namespace havers::sim
