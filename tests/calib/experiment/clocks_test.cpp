// A known specimen recorded by two machines with a clock each, whose offset and rate are known.
#include "calib/experiment/clocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "calib/experiment/join_logger.hpp"
#include "calib/experiment/measured_test.hpp"
#include "calib/experiment/signal_rates.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/slow.hpp"

namespace havers::calib {
namespace {

struct Clocks {
  double offset = 7.3;  // machine's time when the logger's shows 0 [s]
  double rate = 1.0005;
};

// Idle, loading with a hold, the break, idle: what both recorders see. [s], [-]
double strain_at(double time) {
  if (time < 10.0 || time > 60.0) return 0.0;
  if (time < 30.0) return 1e-4 * (time - 10.0);
  if (time < 35.0) return 2e-3;
  return 2e-3 + 1e-4 * (time - 35.0);
}

constexpr double young = 13e9, area = 8e-6;

RawTest machine_record(unsigned seed, double noise = 0.3) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  RawTest raw;
  raw.area = area;
  for (int i = 0; i < 700; ++i) {
    raw.time.push_back(0.1 * i);
    raw.force.push_back(young * area * strain_at(raw.time.back()) + normal(random));
  }
  return raw;
}

RawTest logger_record(const Clocks& clocks, unsigned seed, double from = -5.0, double to = 68.0) {
  std::mt19937 random(seed + 1000);
  std::normal_distribution<double> normal(0.0, 2e-6);
  RawTest raw;
  const int rows = static_cast<int>((to - from) / 0.073);
  for (int i = 0; i < rows; ++i) {
    const double machine_time = from + 0.073 * i;
    raw.time.push_back((machine_time - clocks.offset) / clocks.rate);
    raw.strain.push_back(strain_at(machine_time) + normal(random));
  }
  return raw;
}

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
  EXPECT_NE(problem(logger_record({}, 1, 36.0, 58.0)).find("do not determine the two clocks"),
            std::string::npos);  // steady loading, from any time as from any other
  RawTest noise = logger_record({}, 1, 61.0, 68.0);
  EXPECT_NE(problem(noise).find("do not determine the two clocks"), std::string::npos);
  EXPECT_NE(problem({}).find("too few rows"), std::string::npos);
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
  EXPECT_NE(fitted(machine, logger).problem.find("several offsets fit alike"), std::string::npos);
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
  EXPECT_NE(problem.find("do not determine the two clocks"), std::string::npos) << problem;
  EXPECT_NE(problem.find("; record some rows after the break with both"), std::string::npos);
}

// Rows that the logger saw, and what they say of the specimen.
void expect_the_specimen(const JoinedTest& joined) {
  ASSERT_TRUE(joined.problems.empty()) << joined.problems[0];
  const Reduction reduction = reduce_test(joined.test);
  ASSERT_TRUE(reduction.problems.empty()) << reduction.problems[0];
  EXPECT_NEAR(reduction.test.modulus, young, 0.02 * young);
  EXPECT_NEAR(reduction.test.failure_strain, 4.5e-3, 0.02 * 4.5e-3);
}

TEST(JoinLogger, GivesTheTestTheLoggersStrain) {
  const JoinedTest joined = join_logger(machine_record(2), logger_record({}, 2), {});
  expect_the_specimen(joined);
  EXPECT_EQ(joined.test.strain.size(), joined.test.force.size());
  EXPECT_EQ(joined.test.corrections.at(0).what, "two clocks");
}

// The machine's own strain may be the crosshead's, the logger's is not.
TEST(JoinLogger, GivesAGaugeInPlaceOfTheCrosshead) {
  RawTest machine = machine_record(2), logger = logger_record({}, 2);
  machine.strain.assign(machine.rows(), 0.0);
  machine.crosshead_strain = true;
  const Reduction by_strain = reduce_test(join_logger(machine, logger, {}).test);
  EXPECT_FALSE(by_strain.test.machine_in_strain);
  EXPECT_NEAR(by_strain.test.modulus, young, 0.02 * young);
  logger.extension = std::exchange(logger.strain, {});
  for (double& elongation : logger.extension) elongation *= 25e-3;
  machine.gauge_length = 25e-3;
  const Reduction by_elongation = reduce_test(join_logger(machine, logger, {}).test);
  EXPECT_FALSE(by_elongation.test.machine_in_strain);
  EXPECT_NEAR(by_elongation.test.modulus, young, 0.02 * young);
}

TEST(JoinLogger, FitsWhatAVoltIs) {
  RawTest machine = machine_record(3);
  for (const double time : machine.time) machine.strain.push_back(strain_at(time));
  RawTest logger = logger_record({}, 3);
  logger.volts = logger.strain;
  for (double& volts : logger.volts) volts = 0.2 + 500.0 * volts;
  logger.strain.clear();
  const JoinedTest joined = join_logger(machine, logger, {});
  ASSERT_TRUE(joined.problems.empty()) << joined.problems[0];
  EXPECT_EQ(joined.test.corrections.at(0).what, "gauge factor");
  EXPECT_TRUE(joined.test.corrections[0].detail.starts_with("a volt is 0."))
      << joined.test.corrections[0].detail;  // % of strain
  machine.strain.clear();
  EXPECT_NE(join_logger(machine, logger, {}).problems.at(0).find("what a volt is"),
            std::string::npos);
}

TEST(JoinLogger, FitsWhatAVoltOfTheLoadCellIs) {
  RawTest machine = machine_record(4), logger = logger_record({}, 4);
  for (const double strain : logger.strain) logger.force.push_back(young * area * strain);
  machine.load_volts = machine.force;
  for (double& volts : machine.load_volts) volts = 0.1 + volts / 500.0;
  machine.force.clear();
  const JoinedTest joined = join_logger(machine, logger, {});
  ASSERT_TRUE(joined.problems.empty()) << joined.problems[0];
  EXPECT_EQ(joined.test.corrections.at(0).what, "load cell factor");
  const Reduction reduction = reduce_test(joined.test);
  ASSERT_TRUE(reduction.problems.empty()) << reduction.problems[0];
  EXPECT_NEAR(reduction.test.max_force, 4.5e-3 * young * area, 0.01 * 4.5e-3 * young * area);
  logger.force.clear();
  EXPECT_EQ(join_logger(machine, logger, {}).problems.at(0),
            "the test's force is in volts, and the logger's force does not tell what a volt is: "
            "give force_unit, as in \"500 N/V\"");
}

TEST(JoinLogger, DividesAnElongationByTheGaugeLength) {
  RawTest machine = machine_record(5), logger = logger_record({}, 5);
  logger.extension = std::exchange(logger.strain, {});
  for (double& elongation : logger.extension) elongation *= 25e-3;
  EXPECT_NE(join_logger(machine, logger, {}).problems.at(0).find("give gauge_length_mm"),
            std::string::npos);
  machine.gauge_length = 25e-3;
  const JoinedTest joined = join_logger(machine, logger, {});
  ASSERT_TRUE(joined.problems.empty()) << joined.problems[0];
  EXPECT_NEAR(std::ranges::max(joined.test.strain), 4.5e-3, 2e-5);
}

// One row stretches the range, by parts of which the clocks are matched.
TEST(JoinLogger, MatchesWhatIsLeftWithoutSpikes) {
  RawTest machine = machine_record(6), logger = logger_record({}, 6);
  machine.force[100] = 5000.0;
  JoinedTest joined = join_logger(machine, logger, {});
  expect_the_specimen(joined);
  ASSERT_EQ(joined.test.corrections.size(), 2U);
  EXPECT_TRUE(joined.test.corrections[0].detail.starts_with("1 row of force stood out"));
  EXPECT_NE(join_logger(machine, logger, {.remove_spikes = false}).problems.size(), 0U);

  machine = machine_record(6);
  logger.strain[150] = 0.3;
  joined = join_logger(machine, logger, {});
  expect_the_specimen(joined);
  ASSERT_EQ(joined.test.corrections.size(), 2U);
  EXPECT_TRUE(joined.test.corrections[0].detail.starts_with(
      "in the logger's record: 1 row of strain stood out"));
}

TEST(JoinLogger, MatchesALoadThatIsWrittenNegative) {
  RawTest machine = machine_record(7);
  for (double& force : machine.force) force = -force;
  for (const bool crosshead : {true, false}) {  // without one the logger's gauge tells tension
    for (const double time : machine.time)
      if (crosshead) machine.extension.push_back(1e-5 * time);
    const JoinedTest joined = join_logger(machine, logger_record({}, 7), {});
    expect_the_specimen(joined);
    ASSERT_EQ(joined.test.warnings.size(), 1U);
    EXPECT_TRUE(joined.test.warnings[0].starts_with("the force is negative while"));
    EXPECT_TRUE(joined.test.load_turned);
    machine.extension.clear();
  }
  RawTest pressed = logger_record({}, 7);
  for (double& strain : pressed.strain) strain = -strain;
  EXPECT_LT(std::ranges::min(join_logger(machine, pressed, {}).test.force), -100.0);
}

TEST(JoinLogger, SpreadsRepeatedTimesBeforeItMatches) {
  RawTest logger = logger_record({}, 8);
  for (std::size_t i = 0; i < logger.time.size(); ++i) logger.time[i] = logger.time[i - i % 20];
  const JoinedTest joined = join_logger(machine_record(8), logger, {});
  expect_the_specimen(joined);
  EXPECT_EQ(joined.test.corrections.at(0).what, "repeated times");
  const Clocks truth;
  EXPECT_NEAR(joined.clocks.offset, truth.offset + truth.rate * joined.clocks.reference, 0.2);
}

TEST(JoinLogger, KeepsTheRowsThatBothSaw) {
  const JoinedTest joined = join_logger(machine_record(2), logger_record({}, 2, 22.0, 68.0), {});
  expect_the_specimen(joined);
  EXPECT_NEAR(joined.test.time.front(), 22.0, 0.2);
  EXPECT_GE(joined.test.time.front(), 22.0 - 0.1);
  EXPECT_LE(joined.test.time.back(), 68.0);
  EXPECT_EQ(joined.test.force.size(), joined.test.time.size());
  EXPECT_EQ(joined.test.strain.size(), joined.test.time.size());
}

TEST(JoinLogger, SaysWhatIsMissing) {
  RawTest machine = machine_record(1);
  machine.time.clear();
  EXPECT_NE(
      join_logger(machine, logger_record({}, 1), {}).problems.at(0).find("needs time and force"),
      std::string::npos);
}

}  // namespace
}  // namespace havers::calib
