// A known specimen, cycled at low load before it is loaded to its break.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

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

TensileTruth preconditioned(double cycle_part, int rows_per_cycle, unsigned seed = 1) {
  return {.force_noise = 0.4,
          .strain_noise = 2e-6,
          .strain_rate = 5e-5,
          .cycles = 20,
          .cycle_part = cycle_part,
          .rows_per_cycle = rows_per_cycle,
          .seed = seed};
}

TEST(Preconditioning, IsNoNoiseOfTheStrength) {
  for (const double part : {0.1, 0.3, 0.5})
    for (const int rows : {20, 100, 400}) {
      SCOPED_TRACE(testing::Message() << part << ' ' << rows);
      const TensileTruth truth = preconditioned(part, rows);
      const MeasuredTest test = reduced(record(truth));
      const double noise = truth.force_noise / truth.area();
      EXPECT_NEAR(test.strength_standard_error, noise, 0.15 * noise);
      expect_the_truth(test, truth, 0.005);
    }
}

// Cycles beyond the window of the modulus, of which a single rise has too few rows for a line.
TEST(Preconditioning, LeavesTheModulusToTheLastLoading) {
  const TensileTruth truth = preconditioned(0.5, 10);
  const MeasuredTest test = reduced(record(truth));
  expect_the_truth(test, truth, 0.005);
  TensileTruth plain = truth;
  plain.cycles = 0;
  const double error = reduced(record(plain)).modulus_standard_error;
  EXPECT_NEAR(test.modulus_standard_error, error, 0.3 * error);
}

// Half of the noise is in each row alone, half goes on over ten of them.
TEST(Preconditioning, LeavesTheNoiseOfRowsThatErrAlike) {
  TensileTruth truth = preconditioned(0.3, 100);
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0.0, truth.force_noise);
  for (const int cycles : {0, 20}) {
    truth.cycles = cycles;
    RawTest raw = record(truth);
    double wander = 0.0;
    for (double& force : raw.force) {
      wander = 0.9 * wander + std::sqrt(1.0 - 0.9 * 0.9) * normal(random);
      force += wander;
    }
    const double noise = std::numbers::sqrt2 * truth.force_noise / truth.area();
    EXPECT_NEAR(reduced(raw).strength_standard_error, noise, 0.25 * noise) << cycles;
  }
}

// A tenth of the strength, at the frequency of the mains or of the machine, and none in the gauge.
TEST(Preconditioning, IsNotSeenInALoadThatHums) {
  RawTest raw = record({.strain_noise = 2e-6, .strain_rate = 5e-5});
  double phase = 0.0;
  for (double& force : raw.force) force += 48.0 * std::sin(phase += 0.4);
  const MeasuredTest test = reduce_test(raw).test;
  EXPECT_GT(test.strength_standard_error, 0.05 * test.strength);
}

TEST(Preconditioning, IsNoSlipOfTheGauge) {
  struct Cycles {
    double part;
    int rows;
  };
  for (const Cycles& cycles : {Cycles{0.1, 10}, {0.1, 20}, {0.2, 40}, {0.3, 60}, {0.5, 100}})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(testing::Message() << cycles.part << ' ' << cycles.rows << ' ' << seed);
      const TensileTruth truth = preconditioned(cycles.part, cycles.rows, seed);
      const MeasuredTest test = reduced(record(truth));
      EXPECT_EQ(detail_of(test, "gauge slip"), "");
      expect_the_truth(test, truth, 0.005);
    }
}

// On the way up and down in a cycle, and up to the break.
TEST(Preconditioning, HidesNoSlipOfTheGauge) {
  const TensileTruth truth = preconditioned(0.3, 100);
  for (const std::size_t row : {930U, 980U, 2500U}) {
    RawTest raw = record(truth);
    for (std::size_t i = row; i < raw.rows(); ++i) raw.strain[i] -= 5e-4;
    const MeasuredTest test = reduced(raw);
    expect_the_truth(test, truth, 0.005);
    ASSERT_EQ(test.warnings.size(), 1U) << row;
    EXPECT_TRUE(test.warnings[0].starts_with("the gauge slipped (1 jump)")) << test.warnings[0];
  }
}

}  // namespace
}  // namespace havers::calib
