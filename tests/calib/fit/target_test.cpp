#include "calib/fit/target.hpp"

#include <gtest/gtest.h>

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

// The true end is uniform over the row: its sd is the row over √12.
TEST(Target, KnowsTheStrengthNoBetterThanItsRows) {
  auto test = test::straight_test(10e9, 100e6, 0.0, 0.0);
  test.strain.clear();
  test.stress.clear();
  for (int i = 0; i <= 20; ++i) {
    test.strain.push_back(i * 5e-4);
    test.stress.push_back(i * 5e6);
  }
  EXPECT_NEAR(target_of(test).noise[strength], 5.0 / 102.5 / std::sqrt(12.0), 1e-4);
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
