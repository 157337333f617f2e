// Known clocks under everything that spoils a match: the offset must lie within the error it comes
// with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "calib/experiment/clocks.hpp"
#include "tests/support/slow.hpp"

namespace havers::calib {
namespace {

using TimeCourse = std::function<double(double)>;

// Strain of the specimen over time, and what the two recorders make of it. [s], [-]
struct Situation {
  const char* name;
  double end = 70.0, breaks_at = 60.0;
  TimeCourse strain;
  TimeCourse force = [](double of) { return of; };  // of the specimen, in parts
  TimeCourse gauge = [](double of) { return of; };  // what the gauge shows of the strain
  double after_break = 0.0;                         // what the gauge shows then
  double machine_sampling = 0.1, logger_sampling = 0.073;
  double rate = 1.0, noise = 7e-4;
  double largest_error = 0.05;  // that may be stated [s]
  bool tells_rate = false;      // more than the break is in both
};

struct Record {
  std::vector<double> time, value;
  [[nodiscard]] Signal signal() const { return {time, value}; }
};

struct TwoRecords {
  Record machine, logger;
  double offset;  // machine's time when the logger's shows 0 [s]
};

// Sampling starts anywhere within a step on both clocks, as recorders do.
TwoRecords recorded(const Situation& of, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> anywhere;
  std::normal_distribution<double> noise(0.0, of.noise);
  TwoRecords two{.machine = {}, .logger = {}, .offset = 3.0 + 5.0 * anywhere(random)};
  for (double t = of.machine_sampling * anywhere(random); t < of.end; t += of.machine_sampling) {
    two.machine.time.push_back(t);
    two.machine.value.push_back((t < of.breaks_at ? of.force(of.strain(t)) : 0.0) + noise(random));
  }
  for (double t = of.logger_sampling * anywhere(random); t < of.end; t += of.logger_sampling) {
    two.logger.time.push_back((t - two.offset) / of.rate);
    two.logger.value.push_back((t < of.breaks_at ? of.gauge(of.strain(t)) : of.after_break) +
                               noise(random));
  }
  return two;
}

double ramp(double t) {
  return std::clamp(t / 60.0, 0.0, 1.0);
}
double late_ramp(double t) {
  return std::clamp((t - 8.0) / 52.0, 0.0, 1.0);
}
double ramp_with_hold(double t) {
  return t < 30.0 ? late_ramp(t) : late_ramp(std::max(30.0, t - 6.0));
}
double reloaded(double t) {
  if (t < 25.0) return t / 50.0;
  return t < 35.0 ? 0.5 - (t - 25.0) / 50.0 : 0.3 + (t - 35.0) / 40.0;
}
double with_toe(double strain) {
  return strain - 0.04 + 0.04 * std::exp(-strain / 0.04);
}
double with_slack(double strain) {
  return std::max(0.0, strain - 0.05);
}
double yielding(double strain) {
  return strain < 0.6 ? strain : 0.6 + 0.3 * (strain - 0.6);
}

const std::vector<Situation>& situations() {
  static const std::vector<Situation> all{
      {.name = "AToeInTheForce", .strain = ramp, .force = with_toe},
      {.name = "AToeInTheForceAndEqualSampling",
       .strain = ramp,
       .force = with_toe,
       .logger_sampling = 0.1},
      {.name = "AGaugeThatStartsLate", .strain = late_ramp, .gauge = with_slack},
      {.name = "AGaugeThatStartsLateBeforeAHold",
       .strain = ramp_with_hold,
       .gauge = with_slack,
       .tells_rate = true},
      {.name = "AYieldingSpecimen", .strain = late_ramp, .force = yielding},
      {.name = "AGaugeThatStaysOnOneHalf", .strain = ramp, .force = with_toe, .after_break = 0.4},
      {.name = "AGaugeThatFallsByATenth", .strain = late_ramp, .after_break = 0.9},
      {.name = "ABreakInTheLastRows", .end = 60.5, .strain = ramp},
      {.name = "ABreakInTheLastRowsAfterAToe",
       .end = 60.5,
       .strain = late_ramp,
       .force = with_toe,
       .logger_sampling = 0.1},
      {.name = "Noise",
       .strain = ramp_with_hold,
       .force = with_toe,
       .noise = 2e-3,
       .tells_rate = true},
      {.name = "ClocksThatDrift",
       .strain = reloaded,
       .force = with_toe,
       .rate = 1.002,
       .tells_rate = true},
      {.name = "ASlowLogger",
       .strain = ramp_with_hold,
       .machine_sampling = 0.02,
       .logger_sampling = 0.5,
       .largest_error = 0.2,
       .tells_rate = true},
      {.name = "ASlowMachine",
       .strain = ramp,
       .force = with_toe,
       .machine_sampling = 0.5,
       .logger_sampling = 0.02,
       .largest_error = 0.2},
      {.name = "UnloadingAndNoBreak",
       .end = 50.0,
       .strain = reloaded,
       .force = with_toe,
       .tells_rate = true}};
  return all;
}

class ClocksOf : public testing::TestWithParam<Situation> {};

INSTANTIATE_TEST_SUITE_P(Clocks, ClocksOf, testing::ValuesIn(situations()),
                         [](const auto& test) { return test.param.name; });

TEST_P(ClocksOf, LieWithinTheErrorTheyComeWith) {
  HAVERS_SLOW;
  constexpr int draws = 25;
  int within_two = 0, within_three = 0, rates_within_three = 0;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    const TwoRecords two = recorded(GetParam(), seed);
    const ClockFit fit = fit_clocks(two.machine.signal(), two.logger.signal());
    ASSERT_EQ(fit.problem, "") << seed;
    const double error = std::abs(fit.offset - two.offset - GetParam().rate * fit.reference);
    within_two += error <= 2.0 * fit.offset_standard_error ? 1 : 0;
    within_three += error <= 3.0 * fit.offset_standard_error ? 1 : 0;
    rates_within_three +=
        std::abs(fit.rate - GetParam().rate) <= 3.0 * fit.rate_standard_error ? 1 : 0;
    EXPECT_LT(fit.offset_standard_error, GetParam().largest_error) << seed;
    EXPECT_EQ(fit.rate_fitted, GetParam().tells_rate) << seed;
  }
  EXPECT_GE(within_two, 22);
  EXPECT_GE(within_three, 24);
  EXPECT_GE(rates_within_three, 24);
}

// Slack in one of the signals moves the beginning, so that it alone tells no clocks.
TEST(ClocksOfABeginning, AreRefused) {
  HAVERS_SLOW;
  const Situation beginning{.name = "", .end = 40.0, .strain = late_ramp};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const TwoRecords two = recorded(beginning, seed);
    const ClockFit fit = fit_clocks(two.machine.signal(), two.logger.signal());
    EXPECT_NE(fit.problem.find("do not determine the two clocks"), std::string::npos) << seed;
  }
}

}  // namespace
}  // namespace havers::calib
