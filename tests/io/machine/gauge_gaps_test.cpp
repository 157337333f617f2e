// A gauge without readings in some of a file's rows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/io/complaints.hpp"
#include "tests/io/machine/read_content.hpp"

namespace havers::io {
namespace {

// Forty rows; the gauge's cell is `blank` in those from `from` to before `to`.
std::string with_gap(const std::string& columns, int from, int to, const std::string& blank) {
  std::string text = columns + "\n";
  for (int i = 0; i < 40; ++i)
    text += fmt::format("{},{},{},{}\n", i, 10 * i, 0.01 * i,
                        i >= from && i < to ? blank : fmt::format("{}", 0.02 * i));
  return text;
}

const std::string with_crosshead = "Time (s),Load (N),Crosshead (mm),Strain (%)";

std::string why_refused(const std::string& content) {
  return test::first_problem_of([&] { test::read_content(content); }).what;
}

TEST(GaugeGaps, AtAnEndOfTheRecordAreFilledByTheCrosshead) {
  for (const std::string blank : {"", "NaN", "---"})
    for (const auto& [from, to] : {std::pair(25, 40), {2, 2}, {38, 40}}) {
      const TestFile read = test::read_content(with_gap(with_crosshead, from, to, blank));
      ASSERT_EQ(read.test.strain.size(), 40U);
      for (int i = 0; i < 40; ++i) EXPECT_NEAR(read.test.strain.at(std::size_t(i)), 2e-4 * i, 1e-9);
      EXPECT_EQ(read.test.warnings.size(), from < to ? 1U : 0U) << from;
    }
  const TestFile late = test::read_content(with_gap(with_crosshead, 0, 12, ""));
  EXPECT_NEAR(late.test.strain.front(), 0.0, 1e-9);
}

TEST(GaugeGaps, BetweenReadingsAreRefused) {
  EXPECT_EQ(why_refused(with_gap(with_crosshead, 10, 12, "")), "column \"Strain\": \"\" is empty");
  EXPECT_EQ(why_refused(with_gap(with_crosshead, 10, 12, "NaN")),
            "column \"Strain\": \"NaN\" is not a finite number");
  EXPECT_EQ(why_refused(with_gap(with_crosshead, 25, 40, "x")),
            "column \"Strain\": \"x\" is not a number");
  EXPECT_EQ(why_refused(with_gap("Time (s),Extension (mm),Strain (%),Load (N)", 25, 40, "")),
            "column \"Load\": \"\" is empty");
}

TEST(GaugeGaps, WithoutACrossheadAreRefused) {
  EXPECT_EQ(why_refused(with_gap("Time (s),Load (N),T (°C),Strain (%)", 25, 40, "")),
            "the gauge has no readings at the record's end, and no crosshead tells the strain "
            "there");
}

TEST(GaugeGaps, OfALoggerEndItsRecord) {
  const TestFile read =
      test::read_content(with_gap("Time (s),a,b,Strain (%)", 25, 40, ""), {.logger = true});
  EXPECT_EQ(read.test.strain.size(), 25U);
  EXPECT_EQ(read.test.time.size(), 25U);
}

}  // namespace
}  // namespace havers::io
