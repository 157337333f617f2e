// The clocks of two recorders of one specimen.
#include "calib/experiment/clocks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "calib/experiment/signal_rates.hpp"
#include "tests/support/slow.hpp"
#include "tests/support/two_recorders.hpp"

namespace havers::calib {
namespace {

using test::area;
using test::Clocks;
using test::logger_record;
using test::machine_record;
using test::strain_at;
using test::young;
using testing::HasSubstr;

ClockFit fitted(const RawTest& machine, const RawTest& logger) {
  return fit_clocks({machine.time, machine.force}, {logger.time, logger.strain});
}

TEST(Clocks, RecoversOffsetAndRateWithinTheErrorItStates) {
  HAVERS_SLOW;
  const Clocks truth;
  int within_two = 0, rate_within_two = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const ClockFit fit = fitted(machine_record(seed), logger_record(truth, seed));
    ASSERT_EQ(fit.problem, "");
    ASSERT_TRUE(fit.rate_fitted);
    const double expected = truth.offset + truth.rate * fit.reference;
    EXPECT_NEAR(fit.offset, expected, 0.5 * (0.1 + 0.073)) << seed;  // the rows around the break
    EXPECT_NEAR(fit.rate, truth.rate, 0.005) << seed;
    EXPECT_GT(fit.correlation, 0.8);
    within_two += std::abs(fit.offset - expected) < 2.0 * fit.offset_standard_error ? 1 : 0;
    rate_within_two += std::abs(fit.rate - truth.rate) < 2.0 * fit.rate_standard_error ? 1 : 0;
  }
  EXPECT_GE(within_two, 34);
  EXPECT_GE(rate_within_two, 34);
}

TEST(Clocks, GivesTheFigureItsCurves) {
  const RawTest machine = machine_record(1), logger = logger_record({}, 1);
  const ClockFit fit = fitted(machine, logger);
  EXPECT_EQ(fit.machine.time, machine.time);
  EXPECT_EQ(fit.logger.time, logger.time);
  EXPECT_EQ(std::ranges::min(fit.logger.part), 0.0);
  EXPECT_EQ(std::ranges::max(fit.machine.part), 1.0);
  EXPECT_GT(fit.aligned.time.size(), 600U);
  // What is left is the noise of the two records: 2e-6 of 4.5e-3 and 0.3 of 468 N.
  double squares = 0.0;
  for (const double part : fit.residual.part) squares += part * part;
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(fit.residual.part.size())), 7.5e-4, 2e-4);
}

// Only the break is in both records: it sets the offset, not the rate.
TEST(Clocks, TakesTheRatesAsEqualWhereOnlyTheBreakIsSeen) {
  const Clocks truth{.offset = -3.0, .rate = 1.0};
  const ClockFit fit = fitted(machine_record(1), logger_record(truth, 1, 52.0, 68.0));
  ASSERT_EQ(fit.problem, "");
  EXPECT_FALSE(fit.rate_fitted);
  EXPECT_EQ(fit.rate, 1.0);
  EXPECT_NEAR(fit.offset, truth.offset + fit.reference, 3.0 * fit.offset_standard_error);
  EXPECT_LT(fit.offset_standard_error, 0.5);
}

TEST(Clocks, RefusesSignalsThatDoNotDetermineThem) {
  const RawTest machine = machine_record(1);
  const auto problem = [&](const RawTest& logger) { return fitted(machine, logger).problem; };
  EXPECT_THAT(
      problem(logger_record({}, 1, 36.0, 58.0)),
      HasSubstr(
          "do not determine the two clocks"));  // steady loading, from any time as from any other
  RawTest noise = logger_record({}, 1, 61.0, 68.0);
  EXPECT_THAT(problem(noise), HasSubstr("do not determine the two clocks"));
  EXPECT_THAT(problem({}), HasSubstr("too few rows"));
  RawTest still = machine, too = noise;
  std::ranges::fill(still.time, 1.0);
  std::ranges::fill(too.time, 1.0);
  EXPECT_THAT(fitted(still, too).problem, HasSubstr("the time is the same in all rows of both"));
}

TEST(Clocks, RefusesCyclesThatFitAnywhere) {
  RawTest machine, logger;
  for (int i = 0; i < 1000; ++i) {
    machine.time.push_back(0.1 * i);
    machine.force.push_back(std::sin(0.1 * i));
    if (i > 600) continue;
    logger.time.push_back(0.1 * i);
    logger.strain.push_back(std::sin(0.1 * i + 1.0));
  }
  EXPECT_THAT(fitted(machine, logger).problem, HasSubstr("several offsets fit alike"));
}

// Steady loading and a break in the last rows: nothing but the break tells the clocks. A gauge that
// was lost on the way falls as suddenly, and not to where the load's line meets zero.
TEST(Clocks, TakeTheBreakWhereItIsPlainInBothAndNoLostGaugeForIt) {
  HAVERS_SLOW;
  const Clocks truth;
  const auto records = [&](double lost_at, unsigned seed) {
    RawTest machine = machine_record(seed), logger = logger_record(truth, seed, 0.0, 60.4);
    for (std::size_t i = 0; i < machine.time.size(); ++i)
      machine.force[i] +=
          young * area *
          ((machine.time[i] < 60.0 ? machine.time[i] / 13e3 : 0.0) - strain_at(machine.time[i]));
    for (std::size_t i = 0; i < logger.time.size(); ++i) {
      const double time = truth.offset + truth.rate * logger.time[i];
      logger.strain[i] += (time < lost_at ? time / 13e3 : 0.0) - strain_at(time);
    }
    const auto rows = std::ranges::upper_bound(machine.time, 60.4) - machine.time.begin();
    machine.time.resize(static_cast<std::size_t>(rows));
    machine.force.resize(machine.time.size());
    return std::pair{machine, logger};
  };
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto [machine, logger] = records(60.0, seed);
    const ClockFit fit = fitted(machine, logger);
    ASSERT_EQ(fit.problem, "") << seed;
    EXPECT_FALSE(fit.rate_fitted);
    EXPECT_NEAR(fit.offset, truth.offset + truth.rate * fit.reference, 0.5 * (0.1 + 0.073)) << seed;
    EXPECT_NEAR(fit.offset_standard_error, std::hypot(0.1, 0.073) / std::sqrt(12.0), 0.01);
  }
  const auto [machine, lost] = records(36.0, 1);
  const std::string problem = fitted(machine, lost).problem;
  EXPECT_THAT(problem, HasSubstr("do not determine the two clocks")) << problem;
  EXPECT_THAT(problem, HasSubstr("; record some rows after the break with both"));
}

}  // namespace
}  // namespace havers::calib
