#include "io/config/key_unit.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace havers::io {
namespace {

TEST(KeyUnit, ConvertsWithoutAnExtraRounding) {
  EXPECT_EQ(to_si(100.0, micrometre), 1e-4);  // 100 * 1e-6 is 9.999999999999999e-05
  EXPECT_EQ(to_si(13.0, gigapascal), 13e9);
  EXPECT_EQ(to_si(4.0, millimetre), 4e-3);
  EXPECT_EQ(to_si(90.0, degree), std::numbers::pi / 2.0);
  EXPECT_DOUBLE_EQ(to_si(0.5, millimetre_per_minute), 0.5e-3 / 60.0);
}

TEST(KeyUnit, GivesBackTheNumberTheUserWrote) {
  EXPECT_EQ(from_si(std::numbers::pi / 4.0, degree), 45.0);
  EXPECT_EQ(from_si(1e-4, micrometre), 100.0);
  EXPECT_EQ(from_si(to_si(0.1, megapascal), megapascal), 0.1);
}

// Whatever a file held, what is written for it reads as the same bits.
TEST(KeyUnit, ComesBackToTheSameBitsFromEveryNumberOfAFile) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(1e-3, 1e3);
  for (const KeyUnit unit : {millimetre, micrometre, megapascal, gigapascal, degree})
    for (int i = 0; i < 100'000; ++i) {
      const double si = to_si(uniform(random), unit);
      ASSERT_EQ(to_si(from_si(si, unit), unit), si);
    }
}

}  // namespace
}  // namespace havers::io
