#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "calib/sweep/sweep.hpp"
#include "sim/simulate.hpp"
#include "tests/support/memory_store.hpp"

namespace havers::calib {
namespace {

Sweep small_sweep() {
  Sweep sweep;
  sweep.plan = {.keys = {{"joints.scatter", {"0.2", "0.8"}}}, .seeds = 6};
  for (const double d : {0.2, 0.8}) {
    SweepPoint point;
    point.values = {std::to_string(d)};
    point.numbers = {d};
    point.scene.assembly.layers = 5;
    point.scene.assembly.fibres = 4;
    point.scene.joints.scatter = d;
    point.scene.solver.regime = sim::Regime::quasi_static;
    sweep.points.push_back(point);
  }
  return sweep;
}

TEST(RunSweep, AnswersTheSameForAnyNumberOfThreads) {
  const SweepResult one = run_sweep(small_sweep(), nullptr, 1, {});
  const SweepResult two = run_sweep(small_sweep(), nullptr, 2, {});
  ASSERT_EQ(one.runs.size(), 12U);
  for (std::size_t i = 0; i < one.runs.size(); ++i)
    EXPECT_EQ(one.runs[i][Measure::strength], two.runs[i][Measure::strength]);
  EXPECT_EQ(one.summaries[0][Measure::strength].n, 6);
}

TEST(RunSweep, GivesEveryRunASeedOfItsOwn) {
  const SweepResult result = run_sweep(small_sweep(), nullptr, 1, {});
  for (std::size_t i = 0; i < result.runs.size(); ++i) EXPECT_EQ(result.runs[i].seed, i + 1);
}

TEST(RunSweep, KeepsTheCurveOfTheFirstRunThatHasNotFailed) {
  Sweep sweep = small_sweep();
  sweep.points.back().scene.joints.missing = 0.6;  // which severs some
  const SweepResult result = run_sweep(sweep, nullptr, 1, {});
  const auto first = std::ranges::find_if(
      result.runs, [](const SweepRun& run) { return run.point == 1 && !run.failed; });
  ASSERT_NE(first, result.runs.end());
  ASSERT_TRUE(result.runs[6].failed);
  for (std::size_t i = 6; i < result.runs.size(); ++i)
    EXPECT_EQ(result.runs[i].strain.empty(), &result.runs[i] != &*first) << i;
  EXPECT_FALSE(result.runs.front().strain.empty());
}

TEST(RunSweep, GoesOnWithWhatTheStoreKeeps) {
  test::MemoryStore store;
  EXPECT_TRUE(run_sweep(small_sweep(), &store, 1, [](auto, auto) { return false; }).cancelled);
  const SweepResult again = run_sweep(small_sweep(), &store, 1, {});
  EXPECT_FALSE(again.cancelled);
  EXPECT_EQ(again.simulated, 0);
}

TEST(RunSweep, StopsInsideASimulationAndKeepsThoseBefore) {
  for (const bool patterns : {false, true}) {
    Sweep sweep = small_sweep();
    sweep.patterns = patterns;
    test::MemoryStore store;
    int asked = 0;
    const SweepResult stopped = run_sweep(sweep, &store, 1, {}, [&] { return ++asked >= 400; });
    EXPECT_TRUE(stopped.cancelled);
    EXPECT_LT(asked, 415);
    EXPECT_EQ(stopped.failed, 0);
    EXPECT_GT(stopped.simulated, 0);
    const SweepResult again = run_sweep(sweep, &store, 1, {});
    EXPECT_EQ(again.failed, 0);
    EXPECT_EQ(again.simulated, patterns ? 12 : 12 - stopped.simulated);
  }
}

TEST(RunSweep, TellsTheObserverHowFarItIs) {
  std::size_t last = 0;
  run_sweep(small_sweep(), nullptr, 1, [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 12U);
    last = done;
    return true;
  });
  EXPECT_EQ(last, 12U);
}

TEST(RunSweep, SeesThePatternsOfBrokenJointsWhenAsked) {
  Sweep sweep = small_sweep();
  EXPECT_TRUE(std::isnan(run_sweep(sweep, nullptr, 1, {}).runs[0][Measure::crack_span]));
  sweep.patterns = true;
  const SweepResult result = run_sweep(sweep, nullptr, 1, {});
  for (const SweepRun& run : result.runs)
    EXPECT_GT(run[Measure::head_tail_broken] + run[Measure::flank_broken], 0.0);
}

// In the limit a run goes on to its break, and is cut at the strain limit afterwards.
TEST(RunSweep, SeesNoJointsThatBreakBeyondTheStrainLimit) {
  Sweep sweep = small_sweep();
  sweep.patterns = true;
  sweep.points.back().scene.loading.max_strain = 0.001;
  const SweepResult result = run_sweep(sweep, nullptr, 1, {});
  for (const SweepRun& run : result.runs) {
    EXPECT_EQ(run.unbroken(), run.point == 1);
    EXPECT_EQ(std::isnan(run[Measure::head_tail_broken]), run.unbroken());
    EXPECT_EQ(std::isnan(run[Measure::crack_span]), run.unbroken());
  }
}

// One whose forces are not determined ends before it has joints.
TEST(RunSweep, SeesNoPatternOfARunWithoutJoints) {
  Sweep sweep = small_sweep();
  sweep.patterns = true;
  sweep.plan.seeds = 1;
  sim::AssemblyOptions& wall = sweep.points.back().scene.assembly;
  wall.orientation = 5.0 * std::numbers::pi / 180.0;
  wall.layers = 300;
  wall.fibres = 1;
  const SweepResult result = run_sweep(sweep, nullptr, 1, {});
  EXPECT_EQ(result.failed, 1);
  EXPECT_TRUE(std::isnan(result.runs.back()[Measure::crack_span]));
  EXPECT_FALSE(std::isnan(result.runs.front()[Measure::crack_span]));
}

// Viscous fibres in uniform motion carry a constant stress more from the start on.
TEST(RunSweep, TakesTheViscousStressFromTheLinearPart) {
  Sweep sweep = small_sweep();
  sweep.plan.seeds = 1;
  for (SweepPoint& point : sweep.points) {
    point.scene.joints.scatter = 0.2;
    point.scene.assembly.orientation = 0.25 * std::numbers::pi;
    point.scene.solver.regime = sim::Regime::dynamic;
    point.scene.solver.step = 5e-9;
  }
  sweep.points.back().scene.material.viscosity = 1e-7;
  const SweepResult result = run_sweep(sweep, nullptr, 1, {});
  for (const SweepRun& run : result.runs) {
    EXPECT_FALSE(run.failed) << run.why;
    EXPECT_GT(run[Measure::linear_part], 0.9);
  }
  EXPECT_EQ(result.summaries.front().reserved, 1);
  EXPECT_THAT(result.most_reserved_because,
              testing::StartsWith("the time step: 5 ns was given, and its error is not known"));
  EXPECT_THAT(result.runs.front().why, testing::StartsWith("the time step: 5 ns was given"));
}

TEST(RunSweep, TakesNoStrengthFromRunsThatDidNotBreak) {
  Sweep sweep = small_sweep();
  sweep.levels = 2;
  sweep.points.back().scene.loading.max_strain = 0.001;
  const SweepResult result = run_sweep(sweep, nullptr, 1, {});
  EXPECT_EQ(result.points.size(), 3U);  // no scale above the last
  EXPECT_EQ(result.summaries[1].unbroken, 6);
  EXPECT_EQ(result.summaries[1][Measure::strength].n, 0);
  EXPECT_EQ(result.summaries[1][Measure::modulus].n, 6);
  EXPECT_EQ(result.strengths[1].runs, 0);
  EXPECT_GT(result.runs[6][Measure::strength], 0.0);
  EXPECT_FALSE(result.trusted());
  EXPECT_TRUE(run_sweep(small_sweep(), nullptr, 1, {}).trusted());
}

TEST(RunSweep, TheScaleAboveHasTheStrengthsAsThresholds) {
  Sweep sweep = small_sweep();
  sweep.levels = 2;
  const SweepResult result = run_sweep(sweep, nullptr, 1, {});
  ASSERT_EQ(result.points.size(), 4U);
  const Statistics& below = result.summaries[1][Measure::strength];
  const sim::JointOptions& above = result.points[3].scene.joints;
  EXPECT_EQ(result.points[3].level, 2);
  EXPECT_EQ(above.head_tail, below.mean);
  EXPECT_EQ(above.distribution, sim::Distribution::weibull);
  EXPECT_NEAR(above.scatter / std::sqrt(12.0), below.sd / below.mean, 1e-12);
  EXPECT_NEAR(sim::ratio(result.points[3].scene.assembly, above),
              sim::ratio(sweep.points[1].scene.assembly, sweep.points[1].scene.joints), 1e-12);
}

// (W7) A d of 2 or more would ask for strengths below 0.
TEST(RunSweep, TheScaleAboveHasItsScatterHeldBelowTwo) {
  PointSummary below;
  Statistics& strength = below.measures.front();
  strength = {.n = 5, .mean = 10e6, .sd = 5e6};
  const sim::Scene scene;
  EXPECT_NEAR(scale_above(scene, below).joints.scatter, 0.5 * std::sqrt(12.0), 1e-12);
  strength.sd = 6e6;
  EXPECT_EQ(scale_above(scene, below).joints.scatter, 1.99);
}

// Stronger joints give waves more time: I = ε̇ (W/c) / (σ₁/E).
TEST(RunSweep, TheScaleAboveHasAnInertiaNumberOfItsOwn) {
  Sweep sweep = small_sweep();
  sweep.levels = 2;
  for (SweepPoint& point : sweep.points) {
    point.scene.solver.regime = sim::Regime::automatic;
    point.scene.loading.strain_rate = 1e-3;
    point.inertia_number = inertia_of(point.scene);
  }
  const SweepResult result = run_sweep(sweep, nullptr, 1, {});
  const SweepPoint &below = result.points.at(1), &above = result.points.at(3);
  EXPECT_NEAR(above.inertia_number * above.scene.joints.head_tail,
              below.inertia_number * below.scene.joints.head_tail,
              1e-12 * below.inertia_number * below.scene.joints.head_tail);
  EXPECT_NE(above.inertia_number, below.inertia_number);
}

TEST(RunSweep, HasNoInertiaNumberWhereTheSceneAsksForTheQuasiStaticLimit) {
  sim::Scene scene = small_sweep().points.front().scene;
  EXPECT_TRUE(std::isnan(inertia_of(scene)));
  scene.solver.regime = sim::Regime::dynamic;
  EXPECT_EQ(inertia_of(scene), sim::choose_regime(scene).inertia_number);
}

}  // namespace
}  // namespace havers::calib
