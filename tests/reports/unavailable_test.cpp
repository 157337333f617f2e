#include <gmock/gmock.h>

#include "reports/sweep/sweep_page.hpp"

namespace havers::reports {
namespace {

TEST(UnavailablePages, SayHowToGetThem) {
  EXPECT_FALSE(available());
  EXPECT_THAT(import_page({}, {}), testing::HasSubstr("libmstch-dev"));
  EXPECT_THAT(avalanche_svg({}, {}), testing::HasSubstr("libmstch-dev"));
  EXPECT_THAT(sweep_page("", {}, {}, 0.0), testing::HasSubstr("libmstch-dev"));
  EXPECT_THAT(comparison_page({}), testing::HasSubstr("gnuplot"));
}

}  // namespace
}  // namespace havers::reports
