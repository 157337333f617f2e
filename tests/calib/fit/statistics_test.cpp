#include "calib/fit/statistics.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/calib/student_tail.hpp"

namespace havers::calib {
namespace {

TEST(Statistics, AreThoseOfTheTextbook) {
  const Statistics s = statistics_of({1.0, 4.0, 2.0, 3.0});
  EXPECT_EQ(s.n, 4);
  EXPECT_NEAR(s.mean, 2.5, 1e-15);
  EXPECT_NEAR(s.sd, std::sqrt(5.0 / 3.0), 1e-15);
  EXPECT_NEAR(s.standard_error(), std::sqrt(5.0 / 3.0) / 2.0, 1e-15);
  for (const double risk : {0.05, 0.2})
    EXPECT_NEAR(test::student_tail(s.half_width(risk) / s.standard_error(), 3), risk / 2.0, 1e-12);
}

TEST(Statistics, OfOneValueHaveNoSpread) {
  const Statistics one = statistics_of({7.0});
  EXPECT_EQ(one.mean, 7.0);
  EXPECT_THAT((std::vector{one.sd, one.standard_error(), one.half_width()}),
              testing::Each(testing::IsNan()));
  EXPECT_THAT(statistics_of({}).mean, testing::IsNan());
}

}  // namespace
}  // namespace havers::calib
