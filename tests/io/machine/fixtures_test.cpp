// Files in the shape of every layout, written for this test, each with the quantities it must give
// or the sentence that refuses it: tests/fixtures/machine/expected.csv.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "io/input_error.hpp"
#include "io/machine/csv_rows.hpp"
#include "io/machine/number.hpp"
#include "io/machine/read_test.hpp"
#include "tests/io/complaints.hpp"
#include "tests/support/machine_files.hpp"

namespace havers::io {
namespace {

const std::filesystem::path fixtures =
    std::filesystem::path(HAVERS_SOURCE_DIR) / "tests/fixtures/machine";

enum Field {
  file,
  specimen,
  rows,
  width,
  thickness,
  gauge_length,
  last_time,
  force,
  extension,
  strain,
  refused,
  fields
};
using Expected = std::vector<std::string>;

std::vector<Expected> expected_rows() {
  std::vector<Expected> all;
  CsvRows rows_of_table(',', [&](const Row& row) {
    if (row.line > 1) all.emplace_back(row.cells.begin(), row.cells.end());
    return true;
  });
  rows_of_table.feed(test::contents(fixtures / "expected.csv"));
  rows_of_table.finish();
  return all;
}

// An empty cell of the table means that the file does not tell.
void expect_size(const std::optional<double>& metres, const std::string& cell_mm) {
  EXPECT_EQ(metres.has_value(), !cell_mm.empty());
  EXPECT_NEAR(metres.value_or(0.0), 1e-3 * parse_number(cell_mm).value, 1e-12);
}

void expect_largest(const std::vector<double>& values, const std::string& cell, double unit) {
  EXPECT_EQ(values.empty(), cell.empty());
  if (values.empty()) return;
  const double largest = parse_number(cell).value * unit;
  EXPECT_NEAR(std::ranges::max(values), largest, 1e-6 * largest);
}

void expect_test(const TestFile& read, const Expected& expected) {
  EXPECT_EQ(read.test.specimen_id, expected[specimen]);
  EXPECT_EQ(std::to_string(read.rows), expected[rows]);
  expect_size(read.test.width, expected[width]);
  expect_size(read.test.thickness, expected[thickness]);
  expect_size(read.test.gauge_length, expected[gauge_length]);
  expect_largest(read.test.time, expected[last_time], 1.0);
  expect_largest(read.test.force, expected[force], 1.0);
  expect_largest(read.test.extension, expected[extension], 1e-3);
  expect_largest(read.test.strain, expected[strain], 1.0);
}

TEST(Fixtures, GiveTheQuantitiesOrTheSentenceOfTheirTable) {
  const std::vector<Expected> table = expected_rows();
  ASSERT_GT(table.size(), 20U);
  for (std::size_t i = 0; i < table.size();) {
    const Expected& first = table[i];
    ASSERT_EQ(first.size(), static_cast<std::size_t>(fields));
    SCOPED_TRACE(first[file]);
    try {
      const std::vector<TestFile> tests = read_tests(fixtures / first[file]);
      EXPECT_EQ(first[refused], "");
      for (const TestFile& test : tests) {
        ASSERT_LT(i, table.size());
        ASSERT_EQ(table[i][file], first[file]);
        expect_test(test, table[i++]);
      }
    } catch (const InputError& error) {
      const Problem& problem = error.problems().front();
      EXPECT_EQ(to_string(Problem{"", problem.what, problem.hint}), ": " + first[refused]);
      ++i;
    }
  }
}

TEST(Fixtures, AreAllInTheTable) {
  std::set<std::string> named, there;
  for (const Expected& row : expected_rows()) named.insert(row[file]);
  for (const auto& entry : std::filesystem::directory_iterator(fixtures))
    if (entry.path().filename() != "expected.csv") there.insert(entry.path().filename().string());
  EXPECT_EQ(named, there);
}

TEST(Fixtures, OneOfSeveralSpecimensIsChosenByNameOrNumber) {
  ReadOptions options;
  options.specimen = "South";
  EXPECT_EQ(read_test(fixtures / "side_by_side.csv", options).rows, 21U);
  EXPECT_EQ(read_test(fixtures / "side_by_side.csv", {.specimen_number = 2}).rows, 21U);
  const auto complaint = [&](const ReadOptions& chosen) -> std::string {
    const Problem problem =
        test::first_problem_of([&] { read_test(fixtures / "side_by_side.csv", chosen); });
    return problem.what + "; " + problem.hint;
  };
  EXPECT_EQ(complaint({}),
            "holds 2 specimens; say which by specimen_in_file, its name or number: 1 \"North\", 2 "
            "\"South\"");
  options.specimen = "A";
  const test::TemporaryFile twice(
      "Specimen ID,A\nTime (s),Load (N)\n0,1\n1,2\nSpecimen ID,A\nTime (s),Load (N)\n0,3\n1,4\n");
  EXPECT_THROW(read_test(twice.path(), options), InputError);
  EXPECT_EQ(read_test(twice.path(), {.specimen_number = 2}).test.force, (std::vector{3.0, 4.0}));
  for (const std::string name : {"West", "2"}) {
    options.specimen = name;
    EXPECT_EQ(complaint(options),
              "holds no specimen \"" + name + "\"; it holds 1 \"North\", 2 \"South\"");
  }
  EXPECT_EQ(complaint({.specimen_number = 3}),
            "holds no specimen 3; it holds 1 \"North\", 2 \"South\"");
}

}  // namespace
}  // namespace havers::io
