// A gauge in volts beside a strain that is known: what a volt is must lie within the error it comes
// with.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "calib/experiment/join_logger.hpp"
#include "tests/support/slow.hpp"

namespace havers::calib {
namespace {

// Idle, loading that swings and so tells the clocks, the break, idle. [s], [-]
double pulled_at(double time) {
  return time < 10.0 || time > 60.0 ? 0.0 : 1e-4 * (time - 10.0) + 4e-4 * std::sin(time - 10.0);
}

constexpr double volts_per_strain = 500.0;

struct StatedFactor {
  double value = 0.0, error = 0.0;  // [% of strain]
};

// The known strain wanders, so that rows beside each other err alike.
StatedFactor factor_beside_a_wandering_strain(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  RawTest machine, logger;
  machine.area = 8e-6;
  double error = 0.0;
  for (int i = 0; i < 700; ++i) {
    const double strain = pulled_at(0.1 * i);
    error = 0.85 * error + 1e-5 * normal(random);
    machine.time.push_back(0.1 * i);
    machine.force.push_back(13e9 * 8e-6 * strain + 0.3 * normal(random));
    machine.strain.push_back(strain + error);
    logger.time.push_back(0.1 * i);
    logger.volts.push_back(0.2 + volts_per_strain * (strain + 1e-6 * normal(random)));
  }
  const JoinedTest joined = join_logger(machine, logger, {});
  EXPECT_TRUE(joined.problems.empty()) << joined.problems.front();
  StatedFactor stated;
  EXPECT_EQ(std::sscanf(joined.test.corrections.at(0).detail.c_str(), "a volt is %lf ± %lf",
                        &stated.value, &stated.error),
            2);
  return stated;
}

TEST(GaugeFactor, LiesWithinTheErrorItStatesWhereRowsErrAlike) {
  HAVERS_SLOW;
  int within_two = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const StatedFactor factor = factor_beside_a_wandering_strain(seed);
    const double truth = 100.0 / volts_per_strain;
    within_two += std::abs(factor.value - truth) < 2.0 * factor.error ? 1 : 0;
    EXPECT_LT(factor.error, 0.01 * truth) << seed;
  }
  EXPECT_GE(within_two, 34);
}

}  // namespace
}  // namespace havers::calib
