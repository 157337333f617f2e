#include "calib/fit/profile.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "calib/fit/calibrate.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// From a little above the answer on hardly anything depends on the ratio.
TEST(Profile, GoesFurtherWhereTheCostIsTooLowAndIsOpenWhereItStaysLow) {
  const auto study = test::synthetic_study(test::three_orientations);
  const auto known = test::parameter_of(test::fit(study), "ratio");
  const double most = known.value + 0.6 * (known.slopes_95[1] - known.value);
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [most](sim::Scene scene) {
    const double ratio = sim::ratio(scene.assembly, scene.joints);
    if (ratio > most) apply(scene, "ratio", most * std::pow(ratio / most, 0.1));
    return test::ClosedForm{}(scene);
  };
  const auto result = calibrate_with(simulator, study);
  const auto ratio = test::parameter_of(result, "ratio");
  const auto profile = std::ranges::find(result.profiles, "ratio", &Profile::parameter);
  ASSERT_NE(profile, result.profiles.end());
  EXPECT_EQ(profile->value.size(), 7U);
  EXPECT_GE(profile->rise.front(), profile->level);
  EXPECT_LT(profile->rise.back(), profile->level);
  EXPECT_TRUE(std::isnan(profile->interval_95[1]));
  EXPECT_EQ(ratio.interval_95[1], ratio.bounds[1]);
  EXPECT_GT(ratio.interval_95[0], profile->value.front());
  EXPECT_THAT(ratio.profile_missing, testing::HasSubstr("does not rise enough"));
  const Check agree = test::check_of(result, "intervals agree");
  EXPECT_EQ(agree.outcome, Outcome::warn);
  EXPECT_THAT(agree.text, testing::HasSubstr("ratio (open above)"));
}

}  // namespace
}  // namespace havers::calib
