// Recovery of a known specimen from what a machine would record of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/reduction.hpp"

namespace havers::calib {
namespace {

using test::detail_of;
using test::record;
using test::reduced;
using test::TensileTruth;

TEST(ReduceTest, IsExactWithoutNoise) {
  const TensileTruth truth;
  const MeasuredTest test = reduced(record(truth));
  EXPECT_NEAR(test.modulus, truth.young, 1e-9 * truth.young);
  EXPECT_NEAR(test.strength, truth.strength, 1e-9 * truth.strength);
  EXPECT_NEAR(test.failure_strain, truth.failure_strain(), 1e-12);
  EXPECT_NEAR(test.strain_rate, truth.strain_rate, 0.02 * truth.strain_rate);
  EXPECT_NEAR(test.linearity, 1.0, 1e-9);
  EXPECT_NEAR(test.area, truth.area(), 1e-18);
  EXPECT_NEAR(test.max_force, truth.strength * truth.area(), 1e-6);
  EXPECT_NEAR(test.window_low * truth.young, 0.1 * truth.strength, 0.02 * truth.strength);
  EXPECT_NEAR(test.window_high * truth.young, 0.4 * truth.strength, 0.02 * truth.strength);
  EXPECT_EQ(test.strain.size(), test.stress.size());
  EXPECT_EQ(test.strain.size(), test.time.size());
  EXPECT_TRUE(test.warnings.empty());
}

// Slack and preload shift the recorded strain; the line through the origin brings both back.
TEST(ReduceTest, RemovesToeAndPreload) {
  const TensileTruth truth{.toe = 1e-4, .preload = 10.0};
  const MeasuredTest test = reduced(record(truth));
  EXPECT_NEAR(test.modulus, truth.young, 0.003 * truth.young);
  EXPECT_NEAR(test.failure_strain, truth.failure_strain(), 0.003 * truth.failure_strain());
  EXPECT_NEAR(test.linearity, 1.0, 0.003);
  EXPECT_EQ(detail_of(test, "preload"),
            "1.25 MPa on the specimen at the first row; kept in the stress");
  EXPECT_NE(detail_of(test, "toe").find("so that the modulus line passes through zero"),
            std::string::npos);
  EXPECT_GE(test.strain.front(), 0.0);
  // The window is given in the strain without the toe, whose line passes through zero.
  EXPECT_NEAR(test.window_low * truth.young, 0.1 * truth.strength, 0.004 * truth.strength);
  EXPECT_NEAR(test.window_high * truth.young, 0.4 * truth.strength, 0.004 * truth.strength);

  const MeasuredTest kept = reduced(record(truth), {.remove_toe = false});
  EXPECT_GT(std::abs(kept.failure_strain - truth.failure_strain()), 1e-6);
  EXPECT_TRUE(detail_of(kept, "toe").empty());
}

TEST(ReduceTest, MovesTheWindowOutOfALongToe) {
  const TensileTruth truth{.toe = 4e-4};
  const MeasuredTest test = reduced(record(truth));
  EXPECT_NE(detail_of(test, "modulus window").find("where the curve is straight"),
            std::string::npos);
  EXPECT_GT(test.window_low * truth.young, 0.12 * truth.strength);
  EXPECT_NEAR(test.modulus, truth.young, 0.03 * truth.young);
}

// Bilinear: a tenth of the modulus above 0.25 of the strength.
RawTest yielding(const TensileTruth& truth) {
  RawTest raw = record(truth);
  const double yield = 0.25 * truth.strength;
  for (std::size_t i = 0; i < raw.rows(); ++i) {
    const double stress = raw.force[i] / truth.area();
    if (stress > yield)
      raw.strain[i] = yield / truth.young + (stress - yield) / (0.1 * truth.young);
    raw.stress[i] = stress;
  }
  return raw;
}

TEST(ReduceTest, MovesTheWindowBelowYielding) {
  const TensileTruth truth{.strain_rate = 2e-5};
  const MeasuredTest test = reduced(yielding(truth));
  EXPECT_LT(test.window_high * truth.young, 0.3 * truth.strength);
  EXPECT_NEAR(test.modulus, truth.young, 0.02 * truth.young);
  EXPECT_LT(test.linearity, 0.3);
}

TEST(ReduceTest, StaysWithinOnePercentOfASpecimenAsALaboratoryRecordsIt) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TensileTruth truth{.strength = 45e6,
                             .toe = 1e-4,
                             .preload = 10.0,
                             .force_noise = 0.5,
                             .strain_noise = 2e-6,
                             .strain_rate = 2e-5,
                             .seed = seed};
    const MeasuredTest test = reduced(record(truth));
    EXPECT_NEAR(test.modulus, truth.young, 0.01 * truth.young) << "seed " << seed;
  }
}

TEST(ReduceTest, TakesRoundingBeforeTheOriginForNoSlack) {
  const TensileTruth truth;
  for (const double shift : {-1e-18, 1e-18}) {
    RawTest raw = record(truth);
    for (double& strain : raw.strain) strain += shift;
    raw.strain.front() = -1e-18;
    EXPECT_EQ(reduced(raw, {.cut_after_break = false}).stress.size(), raw.rows()) << shift;
  }
}

TEST(ReduceTest, CutsWhatFollowsTheBreak) {
  const TensileTruth truth;
  const RawTest raw = record(truth);
  const MeasuredTest test = reduced(raw);
  EXPECT_EQ(test.stress.size(), raw.rows() - 5);
  EXPECT_EQ(test.stress.back(), test.strength);
  EXPECT_NE(detail_of(test, "cut after break").find("5 of "), std::string::npos);
  EXPECT_EQ(reduced(raw, {.cut_after_break = false}).stress.size(), raw.rows());
}

TEST(ReduceTest, UsesTheCrossheadWhereThereIsNoGaugeAndWarns) {
  const TensileTruth truth;
  RawTest raw = record(truth);
  raw.strain.clear();
  const MeasuredTest test = reduced(raw);
  EXPECT_NEAR(test.modulus, truth.young, 1e-6 * truth.young);
  EXPECT_NE(test.warnings.at(0).find("compliance of the machine"), std::string::npos);
  EXPECT_TRUE(test.machine_in_strain);
  EXPECT_FALSE(reduced(raw, {.machine_compliance = 1e-9}).machine_in_strain);
  EXPECT_FALSE(reduced(record(truth)).machine_in_strain);
}

// A column of it holds no more than the extension: the machine is taken off it, or said to be in
// it.
TEST(ReduceTest, TakesTheMachineOffTheStrainOfACrosshead) {
  const TensileTruth truth;
  RawTest raw = record(truth);
  const double compliance = 2e-7;  // [m/N]
  for (std::size_t i = 0; i < raw.rows(); ++i) {
    raw.extension[i] = raw.strain[i] * *raw.gauge_length + compliance * raw.force[i];
    raw.strain[i] = raw.extension[i] / *raw.gauge_length;
  }
  raw.crosshead_strain = true;
  EXPECT_TRUE(reduced(raw).machine_in_strain);
  EXPECT_LT(reduced(raw).modulus, 0.9 * truth.young);
  for (const bool has_extension : {true, false}) {
    if (!has_extension) raw.extension.clear();
    const MeasuredTest test = reduced(raw, {.machine_compliance = compliance});
    EXPECT_FALSE(test.machine_in_strain);
    EXPECT_NEAR(test.modulus, truth.young, 1e-6 * truth.young);
  }
}

// A machine divides by a length of its own, as the whole between the grips.
TEST(ReduceTest, KnowsTheStrainOfACrossheadByItsNameAlone) {
  RawTest raw = record({});
  for (double& moved : raw.extension) moved *= 2.0;
  EXPECT_FALSE(reduced(raw).machine_in_strain);
  raw.crosshead_strain = true;
  EXPECT_TRUE(reduced(raw).machine_in_strain);
}

TEST(ReduceTest, UsesTheMachinesStressWhereForceOrAreaIsUnknown) {
  const TensileTruth truth;
  RawTest raw = record(truth);
  raw.width.reset();
  const MeasuredTest no_width = reduced(raw);
  EXPECT_NEAR(no_width.strength, truth.strength, 1.0);
  EXPECT_EQ(no_width.warnings.at(0),
            "width and thickness are unknown: the machine's stress is used");
  raw.force.clear();
  const MeasuredTest no_force = reduced(raw);
  EXPECT_EQ(no_force.warnings.at(0), "no force was recorded: the machine's stress is used");
  EXPECT_EQ(no_force.max_force, 0.0);
}

TEST(ReduceTest, UsesAnAreaGivenInsteadOfWidthAndThickness) {
  const TensileTruth truth;
  RawTest raw = record(truth);
  raw.stress.clear();
  raw.width.reset();
  raw.area = truth.area();
  EXPECT_NEAR(reduced(raw).strength, truth.strength, 1.0);
}

TEST(ReduceTest, HandsOnTheReadersWarnings) {
  RawTest raw = record({});
  raw.warnings = {"column \"Load\" has no unit, taken as N"};
  EXPECT_EQ(reduced(raw).warnings, raw.warnings);
}

std::string problem_of(const RawTest& raw) {
  const Reduction reduction = reduce_test(raw);
  EXPECT_EQ(reduction.test.modulus, 0.0);
  EXPECT_TRUE(reduction.test.stress.empty());
  return reduction.problems.size() == 1 ? reduction.problems[0] : "not one problem";
}

TEST(ReduceTest, SaysWhyATestCannotBeReduced) {
  const RawTest good = record({});
  RawTest raw = good;
  raw.strain.clear();
  raw.gauge_length.reset();
  EXPECT_EQ(problem_of(raw),
            "no strain was recorded, and the gauge length that would turn extension into strain is "
            "unknown");
  raw.extension.clear();
  EXPECT_EQ(problem_of(raw), "neither strain nor crosshead extension was read");

  raw = good;
  raw.stress.clear();
  raw.width.reset();
  EXPECT_EQ(problem_of(raw), "the cross-section is unknown: give width and thickness");
  raw.force.clear();
  raw.time.clear();
  raw.strain.clear();
  raw.extension.clear();
  EXPECT_EQ(reduce_test(raw).problems.at(0), "neither force nor stress was recorded");

  raw = good;
  raw.force[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(problem_of(raw), "a number is not finite");

  raw = good;
  std::ranges::fill(raw.force, 0.0);
  EXPECT_EQ(problem_of(raw), "the specimen is never under tension");

  raw = good;
  for (double& strain : raw.strain) strain = -strain;
  EXPECT_EQ(problem_of(raw), "the stress does not grow with the strain");

  raw = good;
  std::ranges::fill(raw.strain, 0.0);
  const std::string flat = problem_of(raw);
  EXPECT_TRUE(flat.starts_with("the stress does not grow with the strain, which is 0 % in all "))
      << flat;
  EXPECT_TRUE(flat.ends_with("the gauge did not record, or another column is the strain")) << flat;
}

TEST(ReduceTest, SaysWhenThereAreTooFewRows) {
  RawTest one = record({});
  for (std::vector<double>* channel : {&one.time, &one.force, &one.extension, &one.strain})
    channel->resize(1);
  one.stress.clear();
  EXPECT_EQ(problem_of(one), "1 row is too few");
  EXPECT_EQ(problem_of(record({.strain_rate = 1e-2, .rows_after_break = 4})), "9 rows are too few");
  EXPECT_EQ(problem_of(record({.strain_rate = 1e-2})),
            "too few rows between 6 and 24 MPa for a modulus: reduction.window_low and "
            "window_high put these at 0.1 and 0.4 of the strength");
}

}  // namespace
}  // namespace havers::calib
