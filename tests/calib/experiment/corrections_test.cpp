// A known specimen, recorded with a known fault: the correction must bring the specimen back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/experiment/clean_channels.hpp"
#include "calib/experiment/measured_test.hpp"
#include "calib/experiment/quality.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/reduction.hpp"
#include "tests/support/slow.hpp"

namespace havers::calib {
namespace {

using test::detail_of;
using test::expect_the_truth;
using test::record;
using test::reduced;
using test::TensileTruth;

const TensileTruth fine{.strain_rate = 2e-5};

TEST(Corrections, EnergyToFailureIsThatOfTheTriangle) {
  const MeasuredTest test = reduced(record(fine));
  EXPECT_NEAR(test.energy_to_failure, 0.5 * fine.strength * fine.strength / fine.young,
              1e-9 * test.energy_to_failure);
}

TEST(Corrections, EnergyToFailureContainsThePreload) {
  const MeasuredTest test = reduced(record({.preload = 50.0}));
  EXPECT_NEAR(test.energy_to_failure, 0.5 * 60e6 * 60e6 / 13e9, 1e-6 * test.energy_to_failure);
}

TEST(Corrections, RemovesSpikes) {
  RawTest raw = record(fine);
  raw.force[2000] += 200.0;  // above the strength
  raw.strain[60] -= 1e-3;
  expect_the_truth(reduced(raw), fine, 1e-6);
  EXPECT_TRUE(detail_of(reduced(raw), "spikes").starts_with("1 row of force stood out of its "));
  const MeasuredTest kept = reduced(raw, {.remove_spikes = false});
  EXPECT_GT(kept.strength, 1.2 * fine.strength);
  EXPECT_EQ(detail_of(kept, "spikes"), "");
}

// The last row before the break stands alone above the next, a steep test has few rows.
TEST(Corrections, TakesNoPeakForASpike) {
  for (const double rate : {1e-2, 1e-3, 1e-4}) {
    std::vector<double> force = record({.strain_rate = rate}).force;
    EXPECT_EQ(remove_spikes(force), 0U) << rate;
  }
  std::vector<double> roof{0, 10, 20, 30, 40, 50, 40, 30, 20, 10, 0};
  EXPECT_EQ(remove_spikes(roof), 0U);
}

TEST(Corrections, TakesNoNoiseForASpike) {
  std::size_t removed = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    RawTest raw = record({.force_noise = 1.0, .strain_rate = 2e-5, .seed = seed});
    removed += remove_spikes(raw.force);
  }
  EXPECT_EQ(removed, 0U);
}

TEST(Corrections, SpreadsRepeatedTimes) {
  std::vector<double> time{0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0};
  EXPECT_EQ(spread_repeated_times(time), 5U);
  EXPECT_EQ(time, (std::vector{0.0, 0.5, 1.0, 1.25, 1.5, 1.75, 2.0, 2.25}));
  std::vector<double> stopped{3.0, 3.0, 3.0};
  EXPECT_EQ(spread_repeated_times(stopped), 2U);
  EXPECT_EQ(stopped, (std::vector{3.0, 3.0, 3.0}));
}

TEST(Corrections, RateSurvivesACoarseClock) {
  RawTest raw = record(fine);
  for (double& time : raw.time) time = std::floor(time);
  const MeasuredTest test = reduced(raw);
  EXPECT_NEAR(test.strain_rate, fine.strain_rate, 0.05 * fine.strain_rate);
  EXPECT_NE(detail_of(test, "repeated times").find("spread evenly"), std::string::npos);
  EXPECT_EQ(detail_of(reduced(raw, {.spread_repeated_times = false}), "repeated times"), "");
}

TEST(Corrections, TakesATimeThatStandsStillAsNotRecorded) {
  RawTest raw = record(fine);
  std::ranges::fill(raw.time, 0.5);
  const MeasuredTest test = reduced(raw);
  EXPECT_TRUE(test.time.empty());
  EXPECT_EQ(test.strain_rate, 0.0);
  EXPECT_EQ(detail_of(test, "repeated times"), "");
  ASSERT_EQ(test.warnings.size(), 1U);
  EXPECT_EQ(test.warnings[0], "the time is the same in all rows: it is taken as not recorded");
}

TEST(Corrections, TakesTheMachinesComplianceOffTheCrosshead) {
  constexpr double compliance = 20e-9;  // m/N
  RawTest raw = record(fine);
  raw.strain.clear();
  for (std::size_t i = 0; i < raw.rows(); ++i) raw.extension[i] += compliance * raw.force[i];
  EXPECT_LT(reduced(raw).modulus, 0.95 * fine.young);
  const MeasuredTest test = reduced(raw, {.machine_compliance = compliance});
  expect_the_truth(test, fine, 1e-6);
  EXPECT_EQ(detail_of(test, "machine compliance"),
            "0.02 mm per kN of force taken off the crosshead's extension");
  EXPECT_TRUE(test.warnings.empty());
}

RawTest slipping(double at_part, double jump) {
  RawTest raw = record(fine);
  for (std::size_t i = 0; i < raw.rows(); ++i)
    if (raw.force[i] > at_part * fine.strength * fine.area() || i + 5 >= raw.rows())
      raw.strain[i] -= jump;
  return raw;
}

TEST(Corrections, TakesBackTheJumpsOfASlippingGauge) {
  for (const double part : {0.2, 0.6, 0.95}) {
    const RawTest raw = slipping(part, 5e-4);
    const MeasuredTest test = reduced(raw);
    expect_the_truth(test, fine, 0.001);
    EXPECT_NE(detail_of(test, "gauge slip").find("the strain jumped back by 0.05000 %"),
              std::string::npos)
        << detail_of(test, "gauge slip");
    EXPECT_EQ(test.warnings.size(), 1U);
    const MeasuredTest kept = reduced(raw, {.mend_slips = false, .quality_control = false});
    EXPECT_LT(kept.strain.back(), (part > 0.5 ? 0.95 : 1.01) * fine.failure_strain());
    EXPECT_EQ(detail_of(kept, "gauge slip"), "");
  }
}

// Two recorders do not sample at the same instants: one of them sees the break first.
TEST(Corrections, KnowsABreakThatTheGaugeSawFirst) {
  RawTest raw = record(fine);
  for (std::size_t i = raw.rows() - 6; i < raw.rows(); ++i)
    raw.strain[i] = 0.0;  // from the strength on
  const MeasuredTest test = reduced(raw);
  expect_the_truth(test, fine, 1e-3);
  EXPECT_EQ(detail_of(test, "gauge slip"), "");
  EXPECT_NE(detail_of(test, "gauge at the break").find("a row before the load did"),
            std::string::npos);
  EXPECT_TRUE(test.warnings.empty());
}

// A second logger's strain is interpolated between its rows: at the strength it has part of the
// fall, of as few as three of the steps that a record of 50 rows has.
TEST(Corrections, KnowsPartOfTheBreakThatALoggerSawFirst) {
  TensileTruth truth = fine;
  truth.strain_rate = fine.failure_strain() / (50 * fine.sampling);
  for (const double part : {0.05, 0.07, 0.1}) {
    RawTest raw = record(truth);
    raw.extension.clear();
    const std::size_t peak = raw.rows() - 6;
    raw.strain[peak] *= 1.0 - part;
    for (std::size_t i = peak + 1; i < raw.rows(); ++i) raw.strain[i] = 0.0;
    const MeasuredTest test = reduced(raw);
    expect_the_truth(test, truth, 1e-3);
    EXPECT_NE(detail_of(test, "gauge at the break"), "") << part;
    EXPECT_TRUE(test.warnings.empty()) << part;
  }
}

TEST(Corrections, TakesNoNoiseForASlip) {
  HAVERS_SLOW;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const RawTest raw =
        record({.force_noise = 0.5, .strain_noise = 5e-6, .strain_rate = 2e-5, .seed = seed});
    EXPECT_EQ(detail_of(reduced(raw), "gauge slip"), "") << seed;
  }
}

// From 60 % of the strength the gauge hangs loose.
RawTest fallen() {
  RawTest raw = record(fine);
  for (std::size_t i = 0; i < raw.rows(); ++i)
    if (raw.force[i] > 0.6 * fine.strength * fine.area() || i + 5 >= raw.rows())
      raw.strain[i] = 1e-3;
  return raw;
}

TEST(Corrections, GoesOnWithTheCrossheadWhereTheGaugeFellOff) {
  const MeasuredTest test = reduced(fallen());
  expect_the_truth(test, fine, 0.001);
  EXPECT_NE(detail_of(test, "gauge fell off").find("60 % of the strength"), std::string::npos);
  EXPECT_NE(test.warnings.at(0).find("rests on the crosshead"), std::string::npos);
}

TEST(Corrections, RejectsAGaugeThatFellOffWithoutACrosshead) {
  RawTest raw = fallen();
  raw.extension.clear();
  const Reduction reduction = reduce_test(raw);
  ASSERT_EQ(reduction.problems.size(), 1U);
  EXPECT_NE(reduction.problems[0].find("no crosshead tells the strain after it"),
            std::string::npos);
}

TEST(Corrections, QualityControlSaysWhyItRejects) {
  const RawTest noisy = record({.force_noise = 0.5, .strain_noise = 1e-6});
  const ReductionOptions strict{.largest_modulus_error = 1e-4, .largest_noise = 1e-4};
  const Reduction reduction = reduce_test(noisy, strict);
  ASSERT_EQ(reduction.problems.size(), 2U);
  EXPECT_TRUE(
      reduction.problems[0].starts_with("rejected: the standard error of the modulus is 0."));
  EXPECT_TRUE(reduction.problems[1].starts_with("rejected: the noise of the stress is 0."));
  EXPECT_GT(reduction.test.strength, 0.0);  // still shown
  ReductionOptions off = strict;
  off.quality_control = false;
  EXPECT_TRUE(reduce_test(noisy, off).problems.empty());
}

TEST(Corrections, QualityControlRejectsAFailureWithoutStretch) {
  MeasuredTest test;
  test.modulus = 1e9;
  test.strength = 1e6;
  test.failure_strain = -1e-4;
  EXPECT_EQ(
      rejections(test, {}),
      std::vector<std::string>{"rejected: the failure strain is -0.01 %, which is no stretch"});
}

TEST(Corrections, ListsWhatWasDoneBeforeTheReduction) {
  RawTest raw = record(fine);
  raw.corrections = {{"clocks", "the logger's clock was set"}};
  EXPECT_EQ(detail_of(reduced(raw), "clocks"), "the logger's clock was set");
}

}  // namespace
}  // namespace havers::calib
