#include "calib/fit/bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "calib/fit/specimen_effect.hpp"
#include "tests/support/slow.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

TEST(Bound, IsHalfTheTimeBrokenAtItsOwnStrength) {
  EXPECT_NEAR(residual_of_bound(0.0), -std::sqrt(2.0 * std::numbers::ln2), 1e-15);
  EXPECT_EQ(square_of_bound(0.0), 0.0);
}

TEST(Bound, TellsNothingFarAboveAndAllThatABreakDoesFarBelow) {
  for (const double z : {50.0, 1e4}) {
    EXPECT_EQ(residual_of_bound(z), 0.0);
    EXPECT_EQ(slope_of_bound(z), 0.0);
    EXPECT_EQ(square_of_bound(z), 0.0);
    // log Φ(−z) = −z²/2 − log(z √2π) and less than 1/z².
    const double far = std::sqrt(z * z + 2.0 * std::log(z * std::sqrt(2.0 * std::numbers::pi)));
    EXPECT_NEAR(residual_of_bound(-z), -far, 1e-3 / z);
    EXPECT_NEAR(slope_of_bound(-z), 1.0, 1e-2);
    EXPECT_NEAR(square_of_bound(-z) / (z * z), -1.0, 1e-3);
  }
}

TEST(Bound, ChangesByItsSlope) {
  constexpr double step = 1e-4;
  for (double z = -30.0; z < 5.0; z += 0.37) {
    const double slope = (residual_of_bound(z + step) - residual_of_bound(z - step)) / (2.0 * step);
    EXPECT_NEAR(slope_of_bound(z), slope, 1e-6) << z;
  }
}

// Strengths of a known spread of which those above their mean are only known to be so.
TEST(Bound, LeavesTheSpreadOfStrengthsThatWereStoppedAtTheirMean) {
  constexpr double spread = 0.1, machine = 0.02;
  constexpr int count = 20000;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0.0, std::hypot(spread, machine));
  Sample sample;
  for (int i = 0; i < count; ++i) {
    const double strength = normal(random);
    (strength < 0.0 ? sample.difference : sample.above).push_back(std::min(strength, 0.0));
    (strength < 0.0 ? sample.variance : sample.variance_above).push_back(machine * machine);
  }
  const auto broken = static_cast<double>(sample.difference.size());
  EXPECT_NEAR(std::sqrt(variance_between(sample, broken)), spread, 0.02 * spread);
}

/// Bars 10 % apart, tested up to their mean strength: half of them break.
Study stopped_at_the_mean(const std::vector<double>& degrees, unsigned draw) {
  const test::Truth truth{.specimen_effect = 0.1};
  Study study = test::synthetic_study(degrees, truth, draw, {.noise = 0.0});
  study.calibrate.terms = {"strength"};
  for (Specimen& specimen : study.specimens) {
    sim::Scene scene;
    scene.assembly.orientation = specimen.orientation;
    apply(scene, "ratio", truth.ratio);
    const double mean = truth.head_tail_MPa * 1e6 * (1.0 - 0.5 * truth.scatter) *
                        test::ClosedForm::orientation_factor(scene);
    specimen.broke = specimen.test.strength < mean;
    if (!specimen.broke) specimen.test = test::straight_test(specimen.test.modulus, mean);
  }
  return study;
}

TEST(Bound, FindsTheThresholdOfBarsThatWereStoppedAtTheirMeanStrength) {
  HAVERS_SLOW;
  constexpr int studies = 31, bars = 12;
  constexpr double truth = test::Truth{}.head_tail_MPa;
  std::vector<double> errors;
  int held = 0;
  for (unsigned draw = 1; draw <= studies; ++draw) {
    Study study = stopped_at_the_mean(std::vector<double>(bars / 2, 0.0), draw);
    study.calibrate.parameters = {"head_tail_MPa"};
    const auto threshold = test::parameter_of(test::fit(study, {.noise = 0.0}), "head_tail_MPa");
    errors.push_back(std::log(threshold.value / truth));
    held += threshold.slopes_95[0] <= truth && truth <= threshold.slopes_95[1] ? 1 : 0;
  }
  std::ranges::sort(errors);
  RecordProperty("median error", std::to_string(errors[studies / 2]));
  EXPECT_NEAR(errors[studies / 2], 0.0, 0.02);
  EXPECT_GE(held, 27);
}

// Those that broke are the weaker half.
TEST(Bound, LeavesNoCheckToSpecimensThatBroke) {
  Study study = stopped_at_the_mean({0.0, 0.0, 0.0, 45.0, 45.0, 45.0, 90.0, 90.0, 90.0}, 1);
  study.calibrate.parameters = {"head_tail_MPa", "ratio"};
  const auto result = test::fit(study, {.noise = 0.0});
  int seen = 0;
  for (const Check& check : result.verdict) {
    if (check.check != "residuals unstructured" && check.check != "better than a plain law")
      continue;
    ++seen;
    EXPECT_FALSE(check.done);
    EXPECT_NE(check.text.find("at most the weaker specimens broke"), std::string::npos)
        << check.text;
  }
  EXPECT_EQ(seen, 2);
  EXPECT_TRUE(result.trusted());
}

TEST(Bound, SaysWhichStrengthsChiSquaredIsWithout) {
  Study study = stopped_at_the_mean({0.0, 0.0, 0.0, 90.0, 90.0, 90.0}, 1);
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  study.calibrate.terms = {"modulus", "strength"};
  const auto check = test::check_of(test::fit(study, {.noise = 0.0}), "spread between specimens");
  EXPECT_TRUE(test::says(check, "; strengths at 0, 90 deg are left out of it, as tests were"))
      << check.text;
}

// Nothing bounds the thresholds from above; those of an answer that breaks earlier are wrong.
TEST(Bound, SaysThatStoppedTestsBoundThresholdsFromBelowOnly) {
  Study study = test::synthetic_study({0.0, 90.0});
  EXPECT_TRUE(test::says(test::check_of(test::fit(study), "tests broke"), "4 of 4 fitted tests"));
  for (Specimen& specimen : study.specimens) specimen.broke = false;
  const Check open = test::check_of(test::fit(study), "tests broke");
  EXPECT_EQ(open.outcome, Outcome::warn);
  EXPECT_TRUE(
      test::says(open, "joints' thresholds from below only. Those of the answer are among"));
  study.calibrate.parameters = {"young_GPa"};
  study.model.joints.head_tail = 20e6;
  const Check weak = test::check_of(test::fit(study), "tests broke");
  EXPECT_EQ(weak.outcome, Outcome::fail);
  EXPECT_TRUE(test::says(weak, "are too low: S1, S2, S3, S4 bore more")) << weak.text;
}

}  // namespace
}  // namespace havers::calib
