// The test that comes of two records, machine and logger.
#include "calib/experiment/join_logger.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <utility>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/two_recorders.hpp"

namespace havers::calib {
namespace {

using test::area;
using test::Clocks;
using test::logger_record;
using test::machine_record;
using test::strain_at;
using test::young;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

RawTest with_elongation(RawTest logger, double gauge_length) {
  logger.extension = std::exchange(logger.strain, {});
  for (double& elongation : logger.extension) elongation *= gauge_length;
  return logger;
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

// A slow logger sees the gauge go off as the specimen parts, rows of the machine before the break.
TEST(JoinLogger, SpreadsNoJumpOfTheGaugeOverRowsBeforeTheBreak) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    RawTest slow;
    const RawTest logger = logger_record({}, seed);
    for (std::size_t i = seed; i < logger.time.size(); i += 7) {
      const double machine_time = -5.0 + 0.073 * static_cast<double>(i);
      slow.time.push_back(logger.time[i]);
      slow.strain.push_back(machine_time > 60.0 ? 5.5e-3 : logger.strain[i]);
    }
    const JoinedTest joined = join_logger(machine_record(seed, 0.02), slow, {});
    expect_the_specimen(joined);
  }
}

// A logger that stopped on the way up, or clocks that are matched wrongly, hide the strength.
TEST(JoinLogger, SaysWhereTheLoggerSawLessThanTheLargestLoad) {
  const auto doubt = HasSubstr("% of the largest in the machine's record");
  const RawTest machine = machine_record(2);
  EXPECT_THAT(join_logger(machine, logger_record({}, 2), {}).test.warnings, Not(Contains(doubt)));
  const JoinedTest joined = join_logger(machine, logger_record({}, 2, -5.0, 50.0), {});
  ASSERT_TRUE(joined.problems.empty()) << joined.problems[0];
  EXPECT_THAT(joined.test.warnings, Contains(doubt));
}

// The machine's own strain may be the crosshead's, the logger's is not.
TEST(JoinLogger, GivesAGaugeInPlaceOfTheCrosshead) {
  RawTest machine = machine_record(2);
  const RawTest logger = logger_record({}, 2);
  machine.strain.assign(machine.rows(), 0.0);
  machine.crosshead_strain = true;
  const Reduction by_strain = reduce_test(join_logger(machine, logger, {}).test);
  EXPECT_FALSE(by_strain.test.machine_in_strain);
  EXPECT_NEAR(by_strain.test.modulus, young, 0.02 * young);
  machine.gauge_length = 25e-3;
  const Reduction by_elongation =
      reduce_test(join_logger(machine, with_elongation(logger, 25e-3), {}).test);
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
  EXPECT_THAT(join_logger(machine, logger, {}).problems.at(0), HasSubstr("what a volt is"));
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
  RawTest machine = machine_record(5);
  const RawTest logger = with_elongation(logger_record({}, 5), 25e-3);
  EXPECT_THAT(join_logger(machine, logger, {}).problems.at(0), HasSubstr("give gauge_length_mm"));
  machine.gauge_length = 25e-3;
  const JoinedTest joined = join_logger(machine, logger, {});
  ASSERT_TRUE(joined.problems.empty()) << joined.problems[0];
  EXPECT_NEAR(std::ranges::max(joined.test.strain), 4.5e-3, 2e-5);
  EXPECT_THAT(joined.test.warnings,
              Contains(HasSubstr("gauge length of the machine's file, 25 mm")));
  machine.gauge_length = 50e-3;  // the extensometer is shorter, says the file
  machine.extensometer_length = 25e-3;
  EXPECT_NEAR(std::ranges::max(join_logger(machine, logger, {}).test.strain), 4.5e-3, 2e-5);
}

// By its column's name, or as volts were fitted to one: the machine stays in it.
TEST(JoinLogger, KnowsTheStrainOfACrosshead) {
  RawTest machine = machine_record(2), logger = logger_record({}, 2);
  logger.crosshead_strain = true;
  EXPECT_TRUE(reduce_test(join_logger(machine, logger, {}).test).test.machine_in_strain);
  logger.crosshead_strain = false;
  logger.volts = std::exchange(logger.strain, {});
  machine.gauge_length = 25e-3;
  machine.crosshead_strain = true;
  for (const double time : machine.time) {
    machine.strain.push_back(1.5 * strain_at(time));
    machine.extension.push_back(1.6 * strain_at(time) * *machine.gauge_length);
  }
  const Reduction fitted = reduce_test(join_logger(machine, logger, {}).test);
  EXPECT_TRUE(fitted.test.machine_in_strain);
  EXPECT_THAT(fitted.test.warnings,
              Contains(HasSubstr("the gauge was fitted to the strain of the crosshead, which")));
  EXPECT_NEAR(fitted.test.modulus, young / 1.5, 0.02 * young);
  // It slips as a gauge does.
  for (std::size_t i = 600; i < logger.volts.size(); ++i) logger.volts[i] += 5e-4;
  const Reduction slipped = reduce_test(join_logger(machine, logger, {}).test);
  EXPECT_THAT(slipped.test.corrections, Contains(testing::Field(&Correction::what, "gauge slip")));
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
  EXPECT_THAT(join_logger(machine, logger_record({}, 1), {}).problems.at(0),
              HasSubstr("needs time and force"));
}

}  // namespace
}  // namespace havers::calib
