#include "calib/fit/profile.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "calib/fit/calibrate.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// From a little above the answer on, or from a little below it, hardly anything depends on the
// ratio.
void expect_open_side(const Study& study, const CalibratedParameter& known, bool upper) {
  const std::size_t open = upper ? 1 : 0, closed = 1 - open;
  const double edge = known.value + 0.6 * (known.slopes_95.at(open) - known.value);
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [=](sim::Scene scene) {
    const double ratio = sim::ratio(scene.assembly, scene.joints);
    if (upper ? ratio > edge : ratio < edge)
      apply(scene, "ratio", edge * std::pow(ratio / edge, 0.1));
    return test::ClosedForm{}(scene);
  };
  const auto result = calibrate_with(simulator, study);
  const auto ratio = test::parameter_of(result, "ratio");
  const auto profile = std::ranges::find(result.profiles, "ratio", &Profile::parameter);
  ASSERT_NE(profile, result.profiles.end());
  ASSERT_EQ(profile->value.size(), 7U);
  const std::array ends{0U, 6U};
  EXPECT_GE(profile->rise.at(ends.at(closed)), profile->level);
  EXPECT_LT(profile->rise.at(ends.at(open)), profile->level);
  EXPECT_TRUE(std::isnan(profile->interval_95.at(open)));
  EXPECT_EQ(ratio.interval_95.at(open), ratio.bounds.at(open));
  // Held at 1.1 half widths on the one side, and at twice those on the other.
  EXPECT_LT(std::abs(std::log(ratio.interval_95.at(closed) / ratio.value)),
            std::abs(std::log(profile->value.at(ends.at(closed)) / ratio.value)));
  EXPECT_NEAR(std::log(profile->value.at(ends.at(open)) / ratio.value) /
                  std::log(profile->value.at(ends.at(closed)) / ratio.value),
              -2.0 / 1.1, 1e-6);
  EXPECT_THAT(ratio.profile_missing, testing::HasSubstr("does not rise enough"));
  const Check agree = test::check_of(result, "intervals agree");
  EXPECT_EQ(agree.outcome, Outcome::warn);
  EXPECT_THAT(agree.text, testing::HasSubstr(upper ? "ratio (open above)" : "ratio (open below)"));
}

TEST(Profile, GoesFurtherWhereTheCostIsTooLowAndIsOpenWhereItStaysLow) {
  const Study study = test::synthetic_study(test::three_orientations);
  const auto known = test::parameter_of(test::fit(study), "ratio");
  expect_open_side(study, known, true);
  expect_open_side(study, known, false);
}

}  // namespace
}  // namespace havers::calib
