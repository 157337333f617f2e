// The modulus of curves that are nowhere straight, and its error where the noise is not white.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "calib/experiment/measured_test.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/reduction.hpp"

namespace havers::calib {
namespace {

using test::detail_of;
using test::record;
using test::reduced;
using test::TensileTruth;

// A slope that fades from the start leaves the modulus to a convention, and that is said.
TEST(Modulus, TakesTheStandardWindowWhereNothingIsStraight) {
  const TensileTruth truth{.strength = 200e6};
  RawTest raw = record(truth);
  for (std::size_t i = 0; i < raw.rows(); ++i) {
    const double stress = raw.force[i] / truth.area();
    raw.strain[i] = stress / truth.young * (0.5 + stress / truth.strength);
  }
  const MeasuredTest test = reduced(raw, {.remove_toe = false});
  ASSERT_EQ(test.warnings.size(), 1U);
  EXPECT_NE(test.warnings[0].find("no straight part between 20 and 80 MPa"), std::string::npos);
  EXPECT_NE(test.warnings[0].find("ISO 527-1"), std::string::npos);
  EXPECT_NEAR(test.window_low, 0.0005, 2e-5);
  EXPECT_NEAR(test.window_high, 0.0025, 2e-5);
}

TEST(Modulus, SaysWhenNotEvenTheStandardWindowServes) {
  const TensileTruth truth{.strength = 20e6};  // fails before 0.25 % strain
  RawTest raw = record(truth);
  for (std::size_t i = 0; i < raw.rows(); ++i) {
    const double part = raw.force[i] / (truth.area() * truth.strength);
    raw.strain[i] = truth.failure_strain() * part * (0.5 + part);
  }
  EXPECT_NE(reduced(raw).warnings.at(0).find("the modulus is a mean slope"), std::string::npos);
}

// Stiffening by the root, or fading by a power, from the start: no part of the window is straight,
// and none is spoken of.
TEST(Modulus, LeavesTheWindowAsItWasWhereNothingIsStraight) {
  for (const double power : {0.5, 1.0 / 0.45}) {
    const TensileTruth truth{.strength = 100e6};
    RawTest raw = record(truth);
    for (std::size_t i = 0; i < raw.rows(); ++i)
      raw.strain[i] = 0.01 * std::pow(raw.force[i] / (truth.area() * truth.strength), power);
    const MeasuredTest test = reduced(raw, {.remove_toe = false});
    EXPECT_EQ(detail_of(test, "modulus window"), "") << power;
    ASSERT_FALSE(test.warnings.empty());
    EXPECT_NE(test.warnings[0].find("no straight part between 10 and 40 MPa"), std::string::npos)
        << test.warnings[0];
    if (test.warnings[0].find("ISO 527-1") != std::string::npos) continue;
    EXPECT_NEAR(test.window_low, 0.01 * std::pow(0.1, power), 5e-5) << power;
    EXPECT_NEAR(test.window_high, 0.01 * std::pow(0.4, power), 5e-5) << power;
  }
}

}  // namespace
}  // namespace havers::calib
