// A known specimen whose gauge is lost, or jumps ahead: it must be brought back, or be doubted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/experiment/lost_gauge.hpp"
#include "calib/experiment/measured_test.hpp"
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

const TensileTruth gauged{.strain_rate = 2e-5};

// Past its range the gauge shows its last value, or what a torn wire gives.
RawTest saturated(double at_part, double jump) {
  RawTest raw = record(gauged);
  for (std::size_t i = 0; i < raw.rows(); ++i)
    if (raw.strain[i] > at_part * gauged.failure_strain())
      raw.strain[i] = at_part * gauged.failure_strain() + jump;
  return raw;
}

TEST(GaugeLoss, GoesOnWithTheCrossheadWhereTheGaugeIsSaturated) {
  for (const double part : {0.3, 0.6, 0.9}) {
    RawTest raw = saturated(part, 0.0);
    const MeasuredTest test = reduced(raw);
    expect_the_truth(test, gauged, 0.001);
    EXPECT_NE(detail_of(test, "gauge stood still").find("of the strength"), std::string::npos);
    EXPECT_NE(test.warnings.at(0).find("rests on the crosshead"), std::string::npos);
    raw.extension.clear();
    EXPECT_NE(reduce_test(raw).problems.at(0).find("the gauge stood still"), std::string::npos);
  }
  const MeasuredTest torn = reduced(saturated(0.6, 0.05));
  expect_the_truth(torn, gauged, 0.001);
  EXPECT_NE(detail_of(torn, "gauge fell off"), "");
}

// What a torn gauge shows, or an amplifier without one, is thousands of times its range.
TEST(GaugeLoss, GoesOnWithTheCrossheadWhereTheGaugeShowsAnotherNumberFromThenOn) {
  for (const double shown : {0.05, 0.5, 99.99}) {
    RawTest raw = saturated(0.6, shown);
    const MeasuredTest test = reduced(raw);
    expect_the_truth(test, gauged, 0.001);
    EXPECT_NE(detail_of(test, "gauge fell off"), "") << shown;
    raw.extension.clear();
    EXPECT_NE(reduce_test(raw).problems.at(0).find("the gauge fell off"), std::string::npos);
  }
}

// A bar that takes but a fiftieth more load on the last quarter of its strain.
RawTest yielding(unsigned seed) {
  RawTest raw =
      record({.force_noise = 0.1, .strain_noise = 2e-6, .strain_rate = 2e-5, .seed = seed});
  for (std::size_t i = 0; i < raw.rows(); ++i) {
    const double stress = gauged.young * raw.extension[i] / gauged.gauge_length;
    raw.force[i] -= 0.92 * std::max(0.0, stress - 0.75 * gauged.strength) * gauged.area();
  }
  return raw;
}

TEST(GaugeLoss, KnowsTheEndOfARangeWhileTheSpecimenYields) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    RawTest raw = yielding(seed);
    EXPECT_EQ(detail_of(reduced(raw), "gauge stood still"), "") << seed;
    for (double& strain : raw.strain) strain = std::min(strain, 0.8 * gauged.failure_strain());
    const MeasuredTest test = reduced(raw);
    EXPECT_NE(detail_of(test, "gauge stood still"), "") << seed;
    EXPECT_NEAR(test.failure_strain, gauged.failure_strain(), 0.02 * gauged.failure_strain());
  }
}

// Readings from one part of the failure strain to another, and nothing beside them.
RawTest with_readings(double from, double to) {
  RawTest raw = record(gauged);
  for (double& strain : raw.strain)
    if (strain < from * gauged.failure_strain() || strain > to * gauged.failure_strain())
      strain = std::numeric_limits<double>::quiet_NaN();
  return raw;
}

TEST(GaugeLoss, GoesOnWithTheCrossheadWhereTheGaugeHasNoReadings) {
  for (const auto& [from, to] : {std::pair(0.0, 0.5), {0.2, 2.0}, {0.15, 0.7}}) {
    RawTest raw = with_readings(from, to), lone = raw;
    EXPECT_EQ(mend_lost_gauge(raw), "");
    expect_the_truth(reduced(raw), gauged, 0.001);
    EXPECT_EQ(raw.corrections.size(), raw.warnings.size());
    lone.extension.clear();
    EXPECT_NE(mend_lost_gauge(lone).find("no crosshead tells the strain there"), std::string::npos);
  }
  RawTest raw = with_readings(0.0, 0.5);
  mend_lost_gauge(raw);
  EXPECT_EQ(raw.warnings, std::vector<std::string>{"the gauge has no readings from 50 % of the "
                                                   "largest load on: the failure strain rests on "
                                                   "the crosshead"});
}

TEST(GaugeLoss, AfterTheBreakIsNotSaid) {
  for (const bool crosshead : {true, false}) {
    RawTest raw = with_readings(0.0, 1.0 + 1e-9);
    if (!crosshead) raw.extension.clear();
    EXPECT_EQ(mend_lost_gauge(raw), "");
    EXPECT_TRUE(raw.warnings.empty());
    expect_the_truth(reduced(raw), gauged, 0.001);
  }
}

TEST(GaugeLoss, LeavesAnEmptyColumnAway) {
  RawTest raw = with_readings(3.0, 4.0);
  EXPECT_EQ(mend_lost_gauge(raw), "");
  EXPECT_TRUE(raw.strain.empty());
  EXPECT_EQ(raw.warnings.size(), 1U);
}

TEST(GaugeLoss, IsSaidBesideTheSlipsBeforeIt) {
  RawTest raw = saturated(0.6, 0.01);
  for (std::size_t i = 0; i < raw.rows(); ++i)
    if (raw.force[i] > 0.3 * gauged.strength * gauged.area()) raw.strain[i] -= 5e-4;
  const MeasuredTest test = reduced(raw);
  EXPECT_NE(detail_of(test, "gauge slip"), "");
  EXPECT_NE(detail_of(test, "gauge fell off"), "");
  ASSERT_EQ(test.warnings.size(), 2U);
  EXPECT_EQ(test.warnings[0],
            "the gauge slipped (1 jump): strains after that are uncertain by as much");
  EXPECT_NE(test.warnings[1].find("the gauge fell off"), std::string::npos);
}

TEST(GaugeLoss, TakesNoNoiseForAGaugeThatStandsStill) {
  HAVERS_SLOW;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    RawTest raw = record(
        {.toe = 3e-4, .force_noise = 2.0, .strain_noise = 1e-5, .strain_rate = 2e-6, .seed = seed});
    EXPECT_TRUE(reduced(raw).warnings.empty()) << seed << reduced(raw).warnings.front();
    for (double& strain : raw.strain) strain = 5e-5 * std::round(strain / 5e-5);  // few digits
    EXPECT_EQ(detail_of(reduced(raw), "gauge stood still"), "") << seed;
  }
}

// A curve that is flat at its end: there the stress rises by its noise only.
TEST(GaugeLoss, TakesNoYieldingForAGaugeThatStandsStill) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RawTest raw =
        record({.force_noise = 2.0, .strain_noise = 2e-6, .strain_rate = 2e-5, .seed = seed});
    for (std::size_t i = 0; i < raw.rows(); ++i) {
      const double stress = gauged.young * raw.extension[i] / gauged.gauge_length;
      raw.force[i] -= 0.99 * std::max(0.0, stress - 0.5 * gauged.strength) * gauged.area();
    }
    EXPECT_EQ(detail_of(reduced(raw), "gauge stood still"), "") << seed;
    EXPECT_EQ(detail_of(reduced(raw), "gauge slip"), "") << seed;
  }
}

RawTest jumping(double at_part, double jump) {
  RawTest raw = record(gauged);
  for (std::size_t i = 0; i < raw.rows(); ++i)
    if (raw.force[i] > at_part * gauged.strength * gauged.area() || i + 5 >= raw.rows())
      raw.strain[i] += jump;
  return raw;
}

TEST(GaugeLoss, TakesBackAJumpAhead) {
  for (const double part : {0.2, 0.6, 0.95}) {
    const MeasuredTest test = reduced(jumping(part, 5e-4));
    expect_the_truth(test, gauged, 0.001);
    EXPECT_NE(detail_of(test, "gauge slip").find("the strain jumped ahead by 0.05000 %"),
              std::string::npos)
        << detail_of(test, "gauge slip");
    EXPECT_EQ(test.warnings.size(), 1U);
  }
}

// Not even where a column has its strain: the specimen slid in the grips.
TEST(GaugeLoss, TakesNoJumpOfTheCrossheadForASlip) {
  RawTest raw = record(gauged);
  for (std::size_t i = raw.rows() / 2; i < raw.rows(); ++i)
    raw.extension[i] += 5e-4 * gauged.gauge_length;
  for (std::size_t i = 0; i < raw.rows(); ++i)
    raw.strain[i] = raw.extension[i] / gauged.gauge_length;
  raw.crosshead_strain = true;
  RawTest bare = raw;
  bare.strain.clear();
  for (const RawTest& recorded : {raw, bare}) {
    const MeasuredTest test = reduced(recorded);
    EXPECT_NEAR(test.failure_strain, gauged.failure_strain() + 5e-4, 1e-6);
    EXPECT_EQ(detail_of(test, "gauge slip"), "");
  }
}

// A gap in the record, and a crack that takes load with it, are the specimen's own.
TEST(GaugeLoss, TakesNoStepOfTheSpecimenForASlip) {
  RawTest gap = record(gauged);
  for (auto* channel : {&gap.time, &gap.force, &gap.strain, &gap.extension, &gap.stress})
    channel->erase(channel->begin() + 1000, channel->begin() + 1200);
  EXPECT_EQ(detail_of(reduced(gap), "gauge slip"), "");
  expect_the_truth(reduced(gap), gauged, 1e-6);

  RawTest cracking = record(gauged);
  for (std::size_t i = 1500; i < cracking.rows(); ++i) {
    cracking.strain[i] += 5e-4;
    cracking.force[i] -= 0.01 * gauged.strength * gauged.area();
  }
  EXPECT_EQ(detail_of(reduced(cracking), "gauge slip"), "");
}

TEST(GaugeLoss, KnowsAGaugeThatSawTheSpecimenPart) {
  RawTest raw = record(gauged);
  for (std::size_t i = raw.rows() - 6; i < raw.rows(); ++i) raw.strain[i] = 0.1;
  const MeasuredTest test = reduced(raw);
  expect_the_truth(test, gauged, 1e-3);
  EXPECT_NE(detail_of(test, "gauge at the break"), "");
}

// It slides so slowly that no row shows it.
TEST(GaugeLoss, DoubtsAStrainThatLagsBehindTheStress) {
  RawTest raw = record(gauged);
  for (double& strain : raw.strain)
    strain = std::min(strain, 0.25 * gauged.failure_strain() + 0.5 * strain);
  const MeasuredTest test = reduced(raw);
  EXPECT_GT(test.linearity, 1.2);
  EXPECT_NE(test.warnings.at(0).find("below what the modulus lets expect"), std::string::npos);
}

// With few rows a step is a tenth of the strain.
TEST(GaugeLoss, IsSeenInFewRowsToo) {
  const TensileTruth few{.strain_rate = 2e-3};
  for (const double part : {0.5, 0.85}) {
    RawTest raw = record(few);
    for (double& strain : raw.strain) strain = std::min(strain, part * few.failure_strain());
    expect_the_truth(reduced(raw), gauged, 0.01);
    EXPECT_NE(detail_of(reduced(raw), "gauge stood still"), "") << part;
  }
}

// What stands still has no noise, which is not that of the gauge.
TEST(GaugeLoss, IsNotMistakenForSlips) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    RawTest raw = record({.strain_noise = 1e-5, .strain_rate = 2e-5, .seed = seed});
    for (double& strain : raw.strain) strain = std::min(strain, 0.3 * gauged.failure_strain());
    EXPECT_EQ(detail_of(reduced(raw), "gauge slip"), "") << seed;
    EXPECT_NEAR(reduced(raw).failure_strain, gauged.failure_strain(),
                0.05 * gauged.failure_strain());
  }
}

}  // namespace
}  // namespace havers::calib
