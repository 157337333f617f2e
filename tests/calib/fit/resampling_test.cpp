// Other specimens by one step from the answer.
#include "calib/fit/resampling.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "calib/fit/calibrate.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// A mean of n drawn with replacement has the standard deviation √(Σ d²/n)/√n, and what the mean
// took from the residuals widens it to S/√n; ten draws are nearly normal.
TEST(Bootstrap, OfAMeanIsAsWideAsItsStandardErrorSays) {
  constexpr unsigned studies = 16, pairs = 5;
  constexpr double normal = 1.95996;  // the quantile of 97.5 %
  double part = 0.0;
  for (unsigned draw = 1; draw <= studies; ++draw) {
    Study study = test::modulus_study(pairs, draw);
    study.calibrate.profiles = false;
    study.calibrate.seed = draw;  // other draws of specimens
    const auto [low, high] = test::parameter_of(test::fit(study), "young_GPa").bootstrap_95;
    const double error = test::deviation_of_moduli(study) / std::sqrt(2.0 * pairs);
    part += std::log(high / low) / (2.0 * normal * error) / studies;
  }
  RecordProperty("part", std::to_string(part));
  EXPECT_NEAR(part, 1.0, 0.03);
}

TEST(Bootstrap, IsMissingWhereItHasTooFewSpecimens) {
  const auto few = test::parameter_of(test::fit(test::synthetic_study({0.0})), "young_GPa");
  EXPECT_THAT(few.bootstrap_missing, testing::HasSubstr("too few"));
  EXPECT_TRUE(std::isnan(few.bootstrap_95[0]));
}

// The ratio shows at 45 degrees only: of two specimens there among six, (4/6)⁶ = 9 % of the draws
// have none, of one among five (4/5)⁵ = 33 %; a fifth may.
TEST(Bootstrap, IsMissingWhereManyDrawsDoNotDetermineAParameter) {
  Study study = test::synthetic_study(test::three_orientations);
  study.calibrate.profiles = false;
  EXPECT_EQ(test::parameter_of(test::fit(study), "ratio").bootstrap_missing, "");
  study.specimens[2].use = Use::validate;
  const auto ratio = test::parameter_of(test::fit(study), "ratio");
  EXPECT_EQ(ratio.bootstrap_missing, "too many draws of specimens do not determine it");
  EXPECT_TRUE(std::isnan(ratio.bootstrap_95[0]));
}

}  // namespace
}  // namespace havers::calib
