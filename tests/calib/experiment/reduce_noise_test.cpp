// Recovery of a known specimen through noise, within the error that is stated.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/reduction.hpp"
#include "tests/support/slow.hpp"

namespace havers::calib {
namespace {

using test::record;
using test::reduced;
using test::TensileTruth;

TEST(ReduceTest, RecoversThroughNoiseWithinTheErrorItStates) {
  HAVERS_SLOW;
  int within_one = 0, within_two = 0, within_three = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const TensileTruth truth{
        .preload = 5.0, .force_noise = 0.5, .strain_noise = 2e-6, .seed = seed};
    const MeasuredTest test = reduced(record(truth));
    const double error = std::abs(test.modulus - truth.young) / test.modulus_standard_error;
    within_one += error < 1.0 ? 1 : 0;
    within_two += error < 2.0 ? 1 : 0;
    within_three += error < 3.0 ? 1 : 0;
    EXPECT_NEAR(test.strength_standard_error, 0.5 / truth.area(), 0.3 * 0.5 / truth.area());
    EXPECT_NEAR(test.strength, truth.strength, 4.0 * test.strength_standard_error);
    EXPECT_NEAR(test.failure_strain, truth.failure_strain(), 0.02 * truth.failure_strain());
  }
  EXPECT_NEAR(within_one, 137, 25);
  EXPECT_NEAR(within_two, 191, 12);
  EXPECT_GE(within_three, 195);
}

// A window of 5e-5 in which the strain has a noise of 2e-6: least squares alone errs by 2 %.
TEST(ReduceTest, IsNotFlattenedByNoiseOfTheStrain) {
  HAVERS_SLOW;
  double sum = 0.0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const TensileTruth truth{
        .strength = 2.2e6, .strain_noise = 2e-6, .strain_rate = 1e-5, .seed = seed};
    sum += reduced(record(truth)).modulus / truth.young / 400.0;
  }
  EXPECT_NEAR(sum, 1.0, 0.005);
}

// A window of 30 000 rows, fitted by the means of 15: a fifteenth of the noise's variance is left.
TEST(ReduceTest, IsSteepenedByTheNoiseThatMeansOfRowsKeep) {
  const TensileTruth truth{.young = 15e9, .strain_noise = 1e-4, .strain_rate = 4e-7};
  const MeasuredTest test = reduced(record(truth));
  EXPECT_GT(test.strain.size(), 90'000U);
  const double window = 0.3 * truth.failure_strain(), rows = 0.3 * 1e5;
  const double error = truth.young * truth.strain_noise * std::sqrt(12.0 / rows) / window;
  EXPECT_NEAR(test.modulus, truth.young, 3.0 * error);
  EXPECT_NEAR(test.modulus_standard_error, error, 0.1 * error);
}

// A window of seven rows: of 1000 tests 95 % within two standard errors, which Gauss's law would
// make 90 % of these.
TEST(ReduceTest, StatesTheErrorOfAFewRowsTruly) {
  int within_two = 0;
  double squares = 0.0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const TensileTruth truth{.force_noise = 2.0, .strain_rate = 2e-3, .seed = seed};
    const MeasuredTest test = reduced(record(truth));
    const double error = (test.modulus - truth.young) / test.modulus_standard_error;
    within_two += std::abs(error) < 2.0 ? 1 : 0;
    squares += error * error / 1000.0;
  }
  RecordProperty("within_two", within_two);
  RecordProperty("squares", std::to_string(squares));
  EXPECT_NEAR(within_two, 954, 25);
}

}  // namespace
}  // namespace havers::calib
