// A known specimen, and records that end otherwise than by its break or go on after it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/reduction.hpp"

namespace havers::calib {
namespace {

using test::detail_of;
using test::expect_the_truth;
using test::record;
using test::reduced;
using test::TensileTruth;

const TensileTruth the_bar{.strain_rate = 2e-5, .rows_after_break = 0};

bool warns(const MeasuredTest& test, const std::string& words) {
  return std::ranges::any_of(test.warnings, [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

// A row after the last, where the specimen is strained and loaded by these parts of the strength;
// the crosshead moves on by so many of its steps.
void add_row(RawTest& raw, double strain_part, double stress_part, double crosshead_steps) {
  const std::size_t last = raw.rows() - 1;
  raw.extension.push_back(raw.extension.back() +
                          crosshead_steps * (raw.extension[1] - raw.extension[0]));
  raw.time.push_back(raw.time[last] + (raw.time[1] - raw.time[0]));
  raw.strain.push_back(strain_part * the_bar.failure_strain());
  raw.force.push_back(stress_part * the_bar.strength * the_bar.area());
  raw.stress.push_back(stress_part * the_bar.strength);
}

// Back along the line of loading, so many times as fast as it was loaded.
RawTest unloaded(double speed, double to_part) {
  RawTest raw = record(the_bar);
  const double step = speed / static_cast<double>(raw.rows() - 1);
  for (double part = 1.0 - step; part > to_part; part -= step) add_row(raw, part, part, -speed);
  return raw;
}

void expect_the_specimen(const MeasuredTest& test, double tolerance) {
  expect_the_truth(test, the_bar, tolerance);
  EXPECT_NEAR(test.max_force, the_bar.strength * the_bar.area(),
              tolerance * the_bar.strength * the_bar.area());
}

// Zeroed with a specimen in the grips, or not at all: after the break nothing is on the cell.
TEST(RecordEnd, NamesALoadThatStaysAfterTheBreak) {
  TensileTruth truth = the_bar;
  truth.rows_after_break = 20;
  truth.force_noise = 0.2;
  EXPECT_FALSE(warns(reduced(record(truth)), "after the break the load stays"));
  for (const double offset : {0.03, -0.06}) {  // beside the 0.02 of the record
    RawTest raw = record(truth);
    raw.stress.clear();
    for (double& force : raw.force) force += offset * truth.strength * truth.area();
    const auto test = reduced(raw);
    EXPECT_TRUE(warns(test, "after the break the load stays"));
  }
}

// With noise, as all but the first have, the largest stress is seldom the last.
TEST(RecordEnd, KnowsATestThatWasStopped) {
  for (unsigned seed = 0; seed <= 20; ++seed) {
    TensileTruth truth = the_bar;
    truth.force_noise = seed > 0 ? 1.0 : 0.0;
    truth.strain_noise = seed > 0 ? 2e-6 : 0.0;
    truth.seed = seed;
    const MeasuredTest test = reduced(record(truth));
    EXPECT_FALSE(test.broke) << seed;
    EXPECT_TRUE(warns(test, "no break was seen: the record ends at "));
    EXPECT_TRUE(warns(test, "broke = true"));
  }
}

// The load cell shows no more than its range, and the specimen breaks somewhere beyond.
TEST(RecordEnd, KnowsTheEndOfALoadCellsRange) {
  for (const double noise : {0.0, 0.5}) {
    TensileTruth truth = the_bar;
    truth.rows_after_break = 20;
    truth.force_noise = noise;
    const auto clipped_at = [&](double part) {
      RawTest raw = record(truth);
      raw.stress.clear();
      for (double& force : raw.force) force = std::min(force, part * truth.strength * truth.area());
      return reduced(raw);
    };
    EXPECT_TRUE(clipped_at(2.0).broke);
    const MeasuredTest test = clipped_at(0.8);
    EXPECT_FALSE(test.broke);
    EXPECT_TRUE(warns(test, "the end of the load cell's range; strength"));
    EXPECT_NE(detail_of(test, "cut at the end of the load cell's range"), "");
    EXPECT_NEAR(test.strength / (0.8 * truth.strength), 1.0, 1e-9);
    EXPECT_NEAR(test.modulus / truth.young, 1.0, noise > 0.0 ? 0.01 : 1e-6);
  }
}

// A specimen that yields may show the end of the range in more rows than led to it.
TEST(RecordEnd, KnowsTheEndOfARangeThatMostRowsShow) {
  for (const double part : {0.1, 0.3, 0.45}) {
    RawTest raw = record(the_bar);
    for (double& force : raw.force)
      force = std::min(force, part * the_bar.strength * the_bar.area());
    const MeasuredTest test = reduced(raw);
    EXPECT_FALSE(test.broke) << part;
    EXPECT_TRUE(warns(test, "the end of the load cell's range; strength")) << part;
  }
}

// A load that is held is no end of a range: the specimen hardly stretches.
TEST(RecordEnd, TakesNoHeldLoadForTheEndOfARange) {
  RawTest raw = record(the_bar);
  for (int row = 0; row < 30; ++row) add_row(raw, 1.0, 1.0, 0.0);
  EXPECT_FALSE(warns(reduced(raw), "range"));
  // Nor where it is held for longer than the loading took.
  for (int row = 0; row < 3000; ++row) add_row(raw, 1.0, 1.0, 0.0);
  EXPECT_FALSE(warns(reduced(raw), "range"));
}

TEST(RecordEnd, KnowsATestThatWasUnloaded) {
  for (const double speed : {0.3, 1.0, 3.0, 10.0}) {
    SCOPED_TRACE(speed);
    RawTest raw = unloaded(speed, 0.02);
    const std::size_t loading = record(the_bar).rows();
    for (const char* channels : {"gauge and crosshead", "gauge", "crosshead", "no time"}) {
      SCOPED_TRACE(channels);
      if (channels == std::string("gauge")) raw.extension.clear();
      if (channels == std::string("crosshead")) {
        raw = unloaded(speed, 0.02);
        raw.strain.clear();
      }
      if (channels == std::string("no time")) raw.time.clear();
      const MeasuredTest test = reduced(raw);
      EXPECT_FALSE(test.broke);
      EXPECT_TRUE(warns(test, "no break was seen: the strain went back"));
      EXPECT_EQ(test.stress.size(), loading);
      EXPECT_NE(detail_of(test, "cut unloading"), "");
      expect_the_specimen(test, 1e-6);
    }
  }
}

// A crosshead that returns at a hundred times the speed does in a moment what a break does.
TEST(RecordEnd, KnowsAFastReturnByTheCrosshead) {
  EXPECT_FALSE(reduced(unloaded(100.0, 0.02)).broke);
}

TEST(RecordEnd, KnowsATestThatWasPartlyUnloaded) {
  const MeasuredTest test = reduced(unloaded(1.0, 0.7));
  EXPECT_FALSE(test.broke);
  EXPECT_TRUE(warns(test, "ends at 70 % of its largest stress"));
  expect_the_specimen(test, 1e-6);
}

// Sampled so finely, or filtered so much, that the load takes many rows to fall.
TEST(RecordEnd, KnowsABreakThatTakesManyRows) {
  for (const int rows : {1, 3, 10, 40}) {
    SCOPED_TRACE(rows);
    RawTest raw = record(the_bar);
    for (int i = 1; i <= 200; ++i) {
      const double part = std::max(0.0, 1.0 - static_cast<double>(i) / rows);
      add_row(raw, part, part, 1.0);
    }
    const MeasuredTest test = reduced(raw);
    EXPECT_TRUE(test.broke);
    EXPECT_TRUE(test.warnings.empty()) << test.warnings.front();
    expect_the_specimen(test, 1e-6);
  }
}

// Machines end a record where the load has fallen by a part.
TEST(RecordEnd, KnowsABreakInWhichTheRecordEnds) {
  for (const double left : {0.65, 0.55}) {
    RawTest raw = record(the_bar);
    for (double part = 0.95; part > left; part -= 0.05) add_row(raw, part, part, 1.0);
    const MeasuredTest test = reduced(raw);
    EXPECT_TRUE(test.broke);
    EXPECT_TRUE(test.warnings.empty()) << test.warnings.front();
    EXPECT_EQ(test.stress.size(), raw.rows());
    expect_the_specimen(test, 1e-6);
  }
}

TEST(RecordEnd, KnowsABreakInFewRows) {
  for (const double rate : {1e-4, 1e-3, 3e-3}) {
    const MeasuredTest test =
        reduced(record({.strain_rate = rate, .rows_after_break = 1}), {.quality_control = false});
    EXPECT_TRUE(test.broke) << rate;
    EXPECT_TRUE(test.warnings.empty()) << test.warnings.front();
  }
}

TEST(RecordEnd, KnowsASlowFailure) {
  RawTest raw = record(the_bar);
  for (int i = 1; i <= 1000; ++i) add_row(raw, 1.0 + 5e-4 * i, 1.0 - 1e-3 * i, 1.0);
  const MeasuredTest test = reduced(raw);
  EXPECT_TRUE(test.broke);
  EXPECT_NEAR(test.stress.back(), 0.5 * the_bar.strength, 0.01 * the_bar.strength);
  expect_the_specimen(test, 1e-6);
}

// Loaded to a part, unloaded, and loaded again to the break.
TEST(RecordEnd, TakesNoCycleForTheEnd) {
  const RawTest straight = record({.strain_rate = 2e-5, .rows_after_break = 400});
  RawTest raw = straight;
  const auto turn = static_cast<std::ptrdiff_t>(straight.rows() * 6 / 10);
  for (auto* channel : {&raw.force, &raw.strain, &raw.extension, &raw.stress}) {
    const std::vector<double> up(channel->begin(), channel->begin() + turn);
    channel->insert(channel->begin(), up.rbegin(), up.rend());
    channel->insert(channel->begin(), up.begin(), up.end());
  }
  raw.time.clear();
  for (std::size_t i = 0; i < raw.force.size(); ++i)
    raw.time.push_back(0.1 * static_cast<double>(i));
  const MeasuredTest test = reduced(raw);
  EXPECT_TRUE(test.broke);
  EXPECT_NEAR(test.strength, the_bar.strength, 1e-6 * the_bar.strength);
  EXPECT_NEAR(test.failure_strain, the_bar.failure_strain(), 1e-3 * the_bar.failure_strain());
}

// What rises after the break is no load of the specimen's, however high and however soon.
TEST(RecordEnd, TakesNoStrengthFromAGlitchAfterTheBreak) {
  for (const double height : {0.7, 1.3, 5.0})
    for (const int first : {1, 2, 20})
      for (const int rows : {1, 2, 8}) {
        SCOPED_TRACE(testing::Message() << height << ' ' << first << ' ' << rows);
        RawTest raw = record(the_bar);
        for (int i = 0; i < 40; ++i) {
          const bool glitch = i >= first && i < first + rows;
          add_row(raw, 0.0, glitch ? height : 0.0, 1.0);
        }
        const MeasuredTest test = reduced(raw);
        EXPECT_TRUE(test.broke);
        expect_the_specimen(test, 1e-6);
        EXPECT_TRUE(rows == 1 || warns(test, fmt::format("again in {} rows: not used", rows)));
      }
}

TEST(RecordEnd, TakesALossOfSignalForNoBreak) {
  RawTest raw = record({.strain_rate = 2e-5});
  for (std::size_t i = 1500; i < 1508; ++i) raw.force[i] = 0.0;
  const MeasuredTest test = reduced(raw);
  EXPECT_TRUE(test.broke);
  expect_the_specimen(test, 1e-6);
}

// What cannot be told from a loading is said to be a jump.
TEST(RecordEnd, WarnsOfAStressThatJumps) {
  RawTest raw = record(the_bar);
  for (int i = 0; i < 400; ++i) add_row(raw, 0.0, i < 20 ? 0.0 : 3.0, 1.0);
  EXPECT_TRUE(warns(reduce_test(raw).test, "the stress jumps from 0 to 180 MPa between two rows"));
  for (const double rate : {1e-3, 1e-4, 1e-5})
    EXPECT_FALSE(warns(
        reduced(record({.force_noise = 1.0, .strain_rate = rate}), {.quality_control = false}),
        "jumps"));
}

TEST(RecordEnd, KeepsEveryRowWhereNothingIsToBeCut) {
  const RawTest raw = unloaded(1.0, 0.02);
  const MeasuredTest test = reduced(raw, {.cut_after_break = false});
  EXPECT_EQ(test.stress.size(), raw.rows());
  EXPECT_FALSE(test.broke);
}

}  // namespace
}  // namespace havers::calib
