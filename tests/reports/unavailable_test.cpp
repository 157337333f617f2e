#include <gmock/gmock.h>

#include "reports/pages.hpp"

namespace havers::reports {
namespace {

TEST(UnavailablePages, SayHowToGetThem) {
  EXPECT_FALSE(available());
  EXPECT_THAT(import_page({}, {}), testing::HasSubstr("libmstch-dev"));
  EXPECT_THAT(comparison_page({}), testing::HasSubstr("gnuplot"));
}

}  // namespace
}  // namespace havers::reports
