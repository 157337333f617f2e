// Rows that are cut in a hurry and rows that libcsv cuts are the same rows.
#include "io/machine/csv_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace havers::io {
namespace {

struct Cut {
  std::size_t line = 0;
  std::vector<std::string> cells;

  bool operator==(const Cut&) const = default;
};

// Whole lines in one block may be cut in a hurry; of blocks of one byte libcsv must make the rows.
std::vector<Cut> rows_of(const std::string& text, std::size_t block, char delimiter = ',') {
  std::vector<Cut> all;
  CsvRows rows(delimiter, [&](const Row& row) {
    all.push_back({row.line, {row.cells.begin(), row.cells.end()}});
    return true;
  });
  // The line end is that of the first block.
  const std::size_t first = std::max(block, std::min(text.find_first_of("\r\n") + 3, text.size()));
  rows.feed(std::string_view(text).substr(0, first));
  for (std::size_t at = first; at < text.size(); at += block)
    rows.feed(std::string_view(text).substr(at, block));
  rows.finish();
  return all;
}

using Cells = std::vector<std::string>;

TEST(CsvRows, TakesQuotesAndOuterBlanksOff) {
  for (const std::size_t block : {1U, 1000U}) {
    const std::vector<Cut> rows =
        rows_of("a, b\t,c\n\"1,004.5\", \"x\" ,\" y \"\n\"a \"\"b\"\"\",,\n\n  \nlast,1", block);
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0].cells, (Cells{"a", "b", "c"}));
    EXPECT_EQ(rows[1].cells, (Cells{"1,004.5", "x", " y "}));
    EXPECT_EQ(rows[2].cells, (Cells{"a \"b\"", "", ""}));
    EXPECT_EQ(rows[3], (Cut{6, {"last", "1"}}));
  }
}

TEST(CsvRows, CountsTheLinesInsideAQuote) {
  const std::vector<Cut> rows = rows_of("a,b\r\n\"1\r\n2\r\n3\",4\r\n5,6\r\n", 1000);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1].line, 2U);
  EXPECT_EQ(rows[2].line, 5U);
}

TEST(CsvRows, StopsWhenNoMoreIsWanted) {
  int taken = 0;
  CsvRows rows(',', [&](const Row&) { return ++taken < 2; });
  EXPECT_FALSE(rows.feed("1,2\n3,4\n5,6\n7,8\n"));
  EXPECT_EQ(taken, 2);
}

// Any text, of the characters that matter.
TEST(CsvRows, AreTheSameHoweverTheTextIsCutIntoBlocks) {
  std::mt19937 random(1);
  const std::string alphabet = "aab11\"\",,;; \t\n\n\r.";
  for (int i = 0; i < 20000; ++i) {
    std::string text = "x,y\n";
    for (int length = static_cast<int>(random() % 40); length > 0; --length)
      text += alphabet[random() % alphabet.size()];
    for (const char delimiter : {',', ';', '\t'}) {
      const std::vector<Cut> whole = rows_of(text, 1000, delimiter);
      ASSERT_EQ(whole, rows_of(text, 1, delimiter)) << testing::PrintToString(text);
      ASSERT_EQ(whole, rows_of(text, 7, delimiter)) << testing::PrintToString(text);
    }
  }
}

}  // namespace
}  // namespace havers::io
