#include "calib/fit/replicate_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace havers::calib {
namespace {

Prediction with_sd(double sd, int usable) {
  return {.replicates = {}, .sd = Landmarks::Constant(sd), .usable = usable};
}

// Spreads of 0.01 and 0.03 at scatters of 0.1 and 0.2, by 4 and 8 replicates:
// (3·0.1² + 7·0.15²)/10 = 0.01875 per squared scatter.
TEST(ReplicateSpread, IsPooledOverAnOrientationInProportionToTheScatter) {
  const Prediction one = with_sd(0.01, 4), other = with_sd(0.03, 8), across = with_sd(0.05, 4);
  const auto spread = replicate_spread({{0.0, 0.1, &one}, {0.0, 0.2, &other}, {1.5, 0.3, &across}});
  EXPECT_NEAR(spread[0][strength], 0.1 * std::sqrt(0.01875), 1e-12);
  EXPECT_NEAR(spread[1][strength], 0.2 * std::sqrt(0.01875), 1e-12);
  EXPECT_NEAR(spread[2][strength], 0.05, 1e-12) << "alone";
}

TEST(ReplicateSpread, WithoutScatterIsTheSpecimensOwn) {
  const Prediction none = with_sd(0.0, 4), some = with_sd(0.02, 4);
  const auto spread = replicate_spread({{0.0, 0.0, &none}, {0.0, 0.3, &some}});
  EXPECT_EQ(spread[0][modulus], 0.0);
  EXPECT_NEAR(spread[1][modulus], 0.02, 1e-12);
}

TEST(ReplicateSpread, WhereJointsAreMissingIsTheSpecimensOwn) {
  const Prediction intact = with_sd(0.001, 4), missing = with_sd(0.4, 4);
  const sim::JointOptions joints{.scatter = 0.2}, fewer{.scatter = 0.2, .missing = 0.1};
  const auto spread =
      replicate_spread({replicated_of(0.0, joints, intact), replicated_of(0.0, fewer, missing)});
  EXPECT_NEAR(spread[0][modulus], 0.001, 1e-12);
  EXPECT_NEAR(spread[1][modulus], 0.4, 1e-12);
}

// One simulation that answered shows no spread, but does not have none.
TEST(ReplicateSpread, OfASingleReplicateIsThatOfTheOthersAtItsOrientation) {
  const Prediction some = with_sd(0.02, 4), single = with_sd(0.0, 1);
  const auto spread = replicate_spread({{0.0, 0.3, &some}, {0.0, 0.6, &single}});
  EXPECT_NEAR(spread[1][modulus], 0.04, 1e-12);
  EXPECT_EQ(replicate_spread({{0.0, 0.6, &single}})[0][modulus], 0.0) << "of one alone";
}

}  // namespace
}  // namespace havers::calib
