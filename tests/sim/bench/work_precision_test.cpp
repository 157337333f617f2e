#include "sim/bench/work_precision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/simulate.hpp"
#include "tests/sim/bench/tiny_scene.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

TEST(WorkPrecision, FindsTheReferenceWithoutErrorAndTheDirectSolverExactBeforeTheFirstBreak) {
  HAVERS_SLOW;
  const WorkPrecision study = compare_settings(test::tiny(Regime::dynamic), {.seeds = 2});
  EXPECT_TRUE(study.complete);
  EXPECT_EQ(study.rows.size(), bench_settings(test::tiny(Regime::dynamic)).size() + 2);
  const BenchRow& reference = study.rows.front();
  EXPECT_LT(reference.errors.bonded_forces.high, 1e-9);  // against the closed form
  EXPECT_TRUE(study.closed_form);
  EXPECT_EQ(reference.errors.failure_strain.high, 0.0);
  EXPECT_TRUE(reference_is_trusted(study));
  for (const BenchRow& row : study.rows) {
    EXPECT_EQ(row.runs, 2);
    if (row.setting.contact == ContactMethod::active_set) {
      EXPECT_LT(row.errors.bonded_forces.high, 1e-9) << to_string(row.setting);
    } else if (row.setting.tolerance == 1e-4) {
      EXPECT_GT(row.errors.bonded_forces.low, 1e-9) << to_string(row.setting);
    }
    EXPECT_GT(row.steps.low, 0.0);
  }
}

class BenchOmissions : public testing::TestWithParam<Regime> {};
INSTANTIATE_TEST_SUITE_P(Regime, BenchOmissions,
                         testing::Values(Regime::dynamic, Regime::quasi_static));

TEST_P(BenchOmissions, ChangeNothingAndHaveACost) {
  HAVERS_SLOW;
  const WorkPrecision study = compare_settings(test::tiny(GetParam()), {.seeds = 2});
  ASSERT_TRUE(study.omissions);
  EXPECT_EQ(study.omissions->setting.regime, GetParam());
  EXPECT_TRUE(study.omissions->setting.leave_out);
  EXPECT_LT(study.omissions->change, 1e-9);
  EXPECT_GT(study.omissions->cpu_ratio, 0.0);
  const auto whole =
      std::ranges::count_if(study.rows, [](const BenchRow& row) { return !row.setting.leave_out; });
  EXPECT_EQ(whole, 1);
}

// The rest of an avalanche that is left out is no small part of the cost.
TEST(WorkPrecision, TakesTheCostOfOmissionsFromRunsNotFromSteps) {
  HAVERS_SLOW;
  const WorkPrecision study = compare_settings(test::small_scene(0.0, 8, 5), {.seeds = 1});
  ASSERT_TRUE(study.omissions);
  const BenchRow &whole = study.rows[0], &row = study.rows[1];
  EXPECT_GT(whole.steps.median, row.steps.median);
  EXPECT_DOUBLE_EQ(study.omissions->cpu_ratio, whole.cpu.median / row.cpu.median);
}

TEST(WorkPrecision, NamesSettingsThatReachTheirTargetsForEverySeed) {
  HAVERS_SLOW;
  const WorkPrecision study = compare_settings(test::tiny(Regime::quasi_static), {.seeds = 3});
  ASSERT_EQ(study.cheapest.size(), 15U);
  for (const CheapestSetting& cheapest : study.cheapest) {
    if (!cheapest.row) continue;
    const BenchRow& row = study.rows[*cheapest.row];
    EXPECT_GT(*cheapest.row, 0U) << "the reference itself";
    EXPECT_EQ(row.setting.refinement, study.reference.refinement);
    EXPECT_EQ(row.trusted, row.runs);
    const BenchSpread& error = cheapest.quantity == "strength" ? row.errors.strength
                               : cheapest.quantity.starts_with("strength")
                                   ? row.errors.strength_without_ringing
                               : cheapest.quantity == "failure strain" ? row.errors.failure_strain
                               : cheapest.quantity == "curve"          ? row.errors.curve
                                                                       : row.errors.bonded_forces;
    EXPECT_LE(error.high, cheapest.target) << "for every seed";
  }
  EXPECT_TRUE(reference_is_trusted(study));
  for (const BenchRow& row : study.rows)
    if (row.setting.regime == Regime::quasi_static) {
      EXPECT_LT(row.errors.bonded_forces.high, 1e-9);
    }
  // The limit itself is exact.
  const auto strength =
      std::find_if(study.cheapest.begin(), study.cheapest.end(),
                   [](const auto& c) { return c.quantity == "strength" && c.target == 1e-4; });
  ASSERT_TRUE(strength->row);
}

TEST(WorkPrecision, TakesForItsReferenceTheFinestRunAndLeapsOverUniformMotion) {
  HAVERS_SLOW;
  Scene scene = test::tiny(Regime::dynamic);
  scene.solver.step.reset();
  scene.solver.step_accuracy = 1e-2;
  const double chosen = simulate(scene).step;
  ASSERT_LT(16.0 * chosen, 0.25 * scene.assembly.fibre_length / wave_speed(scene.material));
  WorkPrecision study = compare_settings(scene, {.seeds = 1});
  ASSERT_TRUE(study.reference.step);
  EXPECT_LE(*study.reference.step, chosen / 4.0);
  for (const BenchRow& row : study.rows)
    if (row.setting.step) {
      EXPECT_LE(study.reference.step, row.setting.step);
    }
  const double stepped = study.rows.front().steps.median * *study.reference.step;
  EXPECT_LT(stepped * scene.loading.strain_rate, 0.7 * study.rows.front().reached.median);
  study.rows.front().trusted = 0;
  EXPECT_FALSE(reference_is_trusted(study));
  EXPECT_EQ(summary(study), "The reference is not to be trusted: 0 of 1 runs ended well.");
}

TEST(WorkPrecision, TellsWavesThatRingFromTheStrength) {
  HAVERS_SLOW;
  Scene scene = test::tiny(Regime::dynamic);
  scene.loading.strain_rate = 1000.0;
  scene.solver.step = 2e-8;
  const WorkPrecision study = compare_settings(scene, {.seeds = 1});
  int differ = 0;
  for (const BenchRow& row : study.rows)
    if (row.errors.strength.median != row.errors.strength_without_ringing.median) ++differ;
  EXPECT_GT(differ, 5);
  EXPECT_LT(study.reference_errors.strength_without_ringing.high,
            study.reference_errors.strength.high);
  EXPECT_TRUE(study.reference.leap);
  for (const CheapestSetting& cheapest : study.cheapest)
    if (cheapest.row) {
      EXPECT_NE(study.rows[*cheapest.row].setting.step, 2.0 * *study.reference.step);
    }
}

// Of the difference of two curves up to the reference's failure, over its strength. Stresses are
// linear from row to row.
double root_mean_square(const Simulation& run, const Simulation& reference) {
  const auto stress = [](const Simulation& of, double strain) {
    std::size_t i = 1;
    while (i + 1 < of.curve.size() && of.curve[i].strain < strain) ++i;
    const CurvePoint &before = of.curve[i - 1], &after = of.curve[i];
    const double part = (strain - before.strain) / (after.strain - before.strain);
    return before.stress_right + part * (after.stress_right - before.stress_right);
  };
  constexpr int points = 2000;
  double squares = 0.0;
  for (int i = 0; i < points; ++i) {
    const double strain = reference.failure_strain * (i + 0.5) / points;
    squares += std::pow(stress(run, strain) - stress(reference, strain), 2);
  }
  return std::sqrt(squares / points) / reference.strength;
}

// A run of twice its step tells what the reference's own error is about.
TEST(WorkPrecision, NamesNothingForWhatItsReferenceIsNotKnownTo) {
  HAVERS_SLOW;
  const WorkPrecision study = compare_settings(test::tiny(Regime::dynamic), {.seeds = 1});
  const auto twice = std::ranges::find_if(study.rows, [&](const BenchRow& row) {
    return row.setting.step && *row.setting.step == 2.0 * *study.reference.step;
  });
  ASSERT_NE(twice, study.rows.end());
  EXPECT_EQ(study.reference_errors.strength.high, twice->errors.strength.high);
  const Scene scene = test::tiny(Regime::dynamic);
  EXPECT_NEAR(
      twice->errors.curve.median / root_mean_square(simulate(with_setting(twice->setting, scene)),
                                                    simulate(with_setting(study.reference, scene))),
      1.0, 0.02);
  EXPECT_EQ(study.rows.front().errors.curve.high, 0.0);
  EXPECT_GT(study.reference_errors.strength.high, 1e-4);
  for (const CheapestSetting& cheapest : study.cheapest)
    if (cheapest.reference_error > cheapest.target) {
      EXPECT_FALSE(cheapest.row) << cheapest.quantity << " " << cheapest.target;
    }
}

// A specimen that missing joints sever is answered in the limit, without steps.
TEST(WorkPrecision, TakesNoStepFromASpecimenThatIsSevered) {
  HAVERS_SLOW;
  Scene scene = test::tiny(Regime::dynamic);
  scene.solver.step.reset();
  scene.joints.missing = 0.55;
  while (simulate(scene).status != SimulationStatus::severed) ++scene.joints.seed;
  const WorkPrecision study = compare_settings(scene, {.seeds = 1});
  EXPECT_GT(study.reference.step.value(), 0.0);
}

TEST(WorkPrecision, EndsWhenAskedTo) {
  int asked = 0;
  const WorkPrecision study =
      compare_settings(test::tiny(Regime::dynamic), {}, [&](const std::string& next) {
        EXPECT_NE(next, "");
        return ++asked < 3;
      });
  EXPECT_FALSE(study.complete);
  EXPECT_EQ(summary(study), "Stopped before every setting was run.");
}

TEST(WorkPrecision, NamesNothingBeforeItKnowsItsReferencesError) {
  HAVERS_SLOW;
  bool reference_has_run = false;
  const WorkPrecision study =
      compare_settings(test::tiny(Regime::dynamic), {.seeds = 1}, [&](const std::string& next) {
        const bool whole = next.find("nothing left out") != std::string::npos;
        reference_has_run = reference_has_run || whole;
        return whole || !reference_has_run;  // before that of twice its step
      });
  EXPECT_FALSE(study.complete);
  EXPECT_GT(study.rows.size(), 1U);
  for (const CheapestSetting& cheapest : study.cheapest)
    if (cheapest.quantity == "strength") {
      EXPECT_TRUE(std::isnan(cheapest.reference_error));
      EXPECT_FALSE(cheapest.row);
    }
}

TEST(WorkPrecision, ComparesForcesBeforeAnySeedBreaks) {
  HAVERS_SLOW;
  Scene scene = test::tiny(Regime::dynamic);
  scene.joints.scatter = 1.9;
  const auto first_break = [&](std::uint64_t seed) {
    Scene seeded = scene;
    seeded.joints.seed = seed;
    return first_break_by_uniform_stress(seeded);
  };
  std::uint64_t seed = 1;  // the next of which breaks long before it
  while (seed < 100 && first_break(seed + 1) > 0.35 * first_break(seed)) ++seed;
  ASSERT_LT(seed, 100U);
  scene.joints.seed = seed;
  const WorkPrecision study = compare_settings(scene, {.seeds = 2});
  EXPECT_LT(study.bonded_strain, first_break(seed + 1));
  EXPECT_EQ(study.rows.front().errors.bonded_forces.of, 2);
}

// From rest waves run before the first break.
TEST(WorkPrecision, MeasuresForcesAgainstTheReferenceWhereTheyHaveNoClosedForm) {
  HAVERS_SLOW;
  Scene scene = test::tiny(Regime::dynamic);
  scene.loading.start = Start::rest;
  const WorkPrecision study = compare_settings(scene, {.seeds = 1});
  EXPECT_TRUE(study.complete);
  EXPECT_FALSE(study.closed_form);
  EXPECT_FALSE(study.reference.leap) << "waves run from the start";
}

TEST(WorkPrecision, StopsAtTheTimeLimitAllButTheReferenceAndLeavesTheOtherSeeds) {
  HAVERS_SLOW;
  const WorkPrecision stopped =
      compare_settings(test::tiny(Regime::dynamic), {.seeds = 2, .time_limit = 0.0});
  EXPECT_TRUE(std::isnan(stopped.rows.front().stopped_at.median)) << "the reference has no limit";
  EXPECT_EQ(stopped.rows.front().runs, 2);
  EXPECT_EQ(stopped.reference.step, 5e-10) << "a quarter of the longest, as none ended in time";
  const auto row =
      std::ranges::find_if(stopped.rows, [](const BenchRow& r) { return r.out_of_time == 1; });
  ASSERT_NE(row, stopped.rows.end());
  EXPECT_EQ(row->runs, 1);
  EXPECT_EQ(row->stopped_at.median, row->reached.median);
}

}  // namespace
}  // namespace havers::sim
