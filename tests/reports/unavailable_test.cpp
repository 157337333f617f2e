#include <gtest/gtest.h>

#include "reports/pages.hpp"

namespace havers::reports {
namespace {

TEST(UnavailablePages, SayHowToGetThem) {
  EXPECT_FALSE(available());
  EXPECT_NE(import_page({}, {}).find("libmstch-dev"), std::string::npos);
  EXPECT_NE(comparison_page({}).find("gnuplot"), std::string::npos);
}

}  // namespace
}  // namespace havers::reports
