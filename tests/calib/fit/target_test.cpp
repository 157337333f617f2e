#include "calib/fit/target.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

Target target_of(const MeasuredTest& test, bool broke = true) {
  Specimen specimen;
  specimen.broke = broke;
  specimen.test = test;
  return calib::target_of(specimen, CalibrateOptions{}.terms);
}

TEST(Target, AddsHalfARowToATestThatPartsBetweenTwo) {
  const auto test = test::straight_test(10e9, 100e6);
  const auto target = target_of(test);
  EXPECT_NEAR(target.value[modulus], std::log(10e9), 1e-12);
  EXPECT_NEAR(target.value[strength], std::log(100e6 * 1.0005), 1e-9);
  EXPECT_NEAR(target.value[linearity], 0.0, 1e-9);
}

TEST(Target, AddsNothingToASmoothPeak) {
  auto test = test::straight_test(10e9, 100e6);
  test.strain.push_back(test.strain.back() * 1.001);
  test.stress.push_back(test.stress.back() * 0.999);
  EXPECT_NEAR(target_of(test).value[strength], std::log(100e6), 1e-12);
}

// Errors of modulus, strength and rows that all differ. The true end is uniform over a row, whose
// standard deviation is the row over √12; the curve bends, so that rows are other parts of stress
// and strain.
TEST(Target, HasTheNoiseOfItsErrorsRowsAndChannels) {
  auto test = test::straight_test(12e9, 100e6, 4e-3, 3e-3);
  test.failure_strain = 0.01;
  test.strain.clear();
  test.stress.clear();
  for (int i = 0; i <= 20; ++i) {
    test.strain.push_back(i * 5e-4);
    test.stress.push_back(std::min(i * 6e6, 60e6 + i * 2e6));
  }
  const auto target = target_of(test);
  const double peak = 101e6, strain = 0.01025, channel = 1e-6;  // of 0.1 %, squared
  const double by_modulus = 16e-6;
  const double by_strength = (0.3e6 * 0.3e6 + 2e6 * 2e6 / 12.0) / (peak * peak);
  const double by_strain = 5e-4 * 5e-4 / 12.0 / (strain * strain);
  const double by_end = by_strength + by_strain;
  const std::array<double, landmark_count> variance{
      by_modulus + 2.0 * channel, by_strength + channel, by_modulus + by_end + channel,
      0.25 * by_end + channel,    by_end + channel,      by_strain + channel};
  EXPECT_NEAR(target.value[strength], std::log(peak), 1e-12);
  EXPECT_NEAR(target.value[linearity], std::log(peak / (12e9 * strain)), 1e-12);
  for (Eigen::Index q = 0; q < landmark_count; ++q)
    EXPECT_NEAR(std::pow(target.noise[q], 2), variance.at(static_cast<std::size_t>(q)), 1e-12) << q;
}

// A test that was stopped bounds the strength and knows nothing of the break.
TEST(Target, OfATestThatDidNotBreakKeepsModulusAndABound) {
  const auto target = target_of(test::straight_test(10e9, 100e6), false);
  EXPECT_TRUE(target.censored);
  EXPECT_NEAR(target.value[strength], std::log(100e6), 1e-12);
  EXPECT_TRUE(target.present[modulus] && target.present[strength]);
  EXPECT_FALSE(target.present.tail<4>().any());
}

TEST(Target, HasOnlyTheTermsAskedFor) {
  Specimen specimen;
  specimen.test = test::straight_test(10e9, 100e6);
  const auto target = calib::target_of(specimen, {"modulus", "energy"});
  EXPECT_EQ(target.present.count(), 2);
  EXPECT_TRUE(target.present[modulus] && target.present[energy]);
}

TEST(Target, IsOfNoUseWithoutAModulus) {
  EXPECT_FALSE(target_of(MeasuredTest{}).usable);
  EXPECT_TRUE(target_of(test::straight_test(10e9, 100e6)).usable);
}

}  // namespace
}  // namespace havers::calib
