// What exports have around and between their numbers.
#include <gtest/gtest.h>

#include "io/machine/read_test.hpp"
#include "tests/support/machine_files.hpp"

namespace havers::io {
namespace {

std::vector<TestFile> tests_of(const std::string& content, const ReadOptions& options = {}) {
  const test::TemporaryFile file(content);
  return read_tests(file.path(), options);
}

const std::string heads = "Time (s),Load (N),Strain (%)\n";
const std::string numbers = "0,1,0.1\n1,2,0.2\n2,3,0.3\n";

// Sums, results, a last word: nothing of it is a test's.
TEST(OddExports, EndWithWhatIsNotRead) {
  for (const std::string foot :
       {"Maximum,3,0.3\nMean,2,0.2\n", "End of test\n", "\nMax Load (N),3\n"}) {
    const auto tests = tests_of(heads + numbers + foot);
    ASSERT_EQ(tests.size(), 1U) << foot;
    EXPECT_EQ(tests[0].test.force, (std::vector{1.0, 2.0, 3.0}));
    ASSERT_EQ(tests[0].test.warnings.size(), 1U);
    EXPECT_TRUE(
        tests[0].test.warnings[0].ends_with("what follows it are no rows of numbers: not read"));
  }
}

// Each has its sizes above its own columns; what stands left of all is of all.
TEST(OddExports, HaveASpecimensSizesAboveItsColumns) {
  const auto tests = tests_of(
      "Specimen ID,A1,,Specimen ID,A2,\nWidth,4.00,mm,Width,3.00,mm\n"
      "Thickness,2.00,mm,,,\n\nTime,Load,Strain,Time,Load,Strain\n(s),(N),(%),(s),(N),(%)\n"
      "0,1,0.1,0,1,0.1\n1,2,0.2,1,2,0.2\n");
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests[0].test.specimen_id, "A1");
  EXPECT_EQ(tests[1].test.specimen_id, "A2");
  EXPECT_NEAR(*tests[0].test.width, 4e-3, 1e-12);
  EXPECT_NEAR(*tests[1].test.width, 3e-3, 1e-12);
  for (const TestFile& test : tests) EXPECT_NEAR(*test.test.thickness, 2e-3, 1e-12);
}

// Names alone and a time that goes on are a page of the same test; a time that begins again, or
// leaps, is another's.
TEST(OddExports, RepeatTheirNamesOnEveryPage) {
  for (const auto& [next, tests] : {std::pair("3,4,0.4\n4,5,0.5\n", 1U),
                                    {"0,4,0.4\n1,5,0.5\n", 2U},
                                    {"90,4,0.4\n91,5,0.5\n", 2U}}) {
    const auto read = tests_of(heads + numbers + heads + next);
    EXPECT_EQ(read.size(), tests) << next;
    EXPECT_EQ(read[0].rows, tests == 1U ? 5U : 3U);
    EXPECT_EQ(tests_of(heads + numbers + "Specimen,B\n" + heads + next).size(), 2U);
  }
}

TEST(OddExports, HaveTheirUnitsAboveTheNames) {
  const auto file = tests_of("s,kN,%\nTime,Load,Strain\n" + numbers)[0];
  EXPECT_EQ(file.test.force, (std::vector{1e3, 2e3, 3e3}));
  EXPECT_EQ(file.test.strain, (std::vector{0.001, 0.002, 0.003}));
  EXPECT_TRUE(file.test.warnings.empty());
}

TEST(OddExports, NameTheirDelimiterForASpreadsheet) {
  const auto file = tests_of("sep=;\nTime (s);Load (N);Strain (%)\n0;1;0,1\n1;2;0,2\n")[0];
  EXPECT_EQ(file.test.strain, (std::vector{0.001, 0.002}));
  EXPECT_TRUE(file.test.specimen_id.empty());
  EXPECT_EQ(tests_of("Time (s)|Load (N)|Strain (%)\n0|1|0,1\n1|2|0,2\n")[0].delimiter, "|");
}

// The crosshead's extension is another thing, and contains the machine.
TEST(OddExports, HaveTheElongationOfAnExtensometer) {
  for (const char* name : {"Extensometer", "Extensomètre", "Extensómetro", "Estensimetro"}) {
    const auto file =
        tests_of(std::string("Load (N),Extension (mm),") + name + " (mm)\n1,5,0.05\n2,6,0.1\n",
                 {.gauge_length = 50e-3})[0];
    EXPECT_EQ(file.test.strain, (std::vector{1e-3, 2e-3})) << name;
    EXPECT_EQ(file.test.extension, (std::vector{5e-3, 6e-3})) << name;
  }
}

// A date and time as a number, as spreadsheets keep it; what could be one and is none.
TEST(OddExports, CountTimeInDaysOfASpreadsheet) {
  const auto timed = [](const std::string& name, const std::vector<std::string>& times,
                        const ReadOptions& options = {}) {
    std::string content = name + ",Load (N),Strain (%)\n";
    for (const std::string& time : times) content += time + ",1,0.1\n";
    return tests_of(content, options)[0].test;
  };
  const std::vector<std::string> dates{"45123.5", "45123.50001157407", "45124.25"};
  const calib::RawTest days = timed("Time", dates, {.alone = true});
  EXPECT_NEAR(days.time.at(0), 43200.0, 1e-5);
  EXPECT_NEAR(days.time.at(1), 43201.0, 1e-5);
  EXPECT_NEAR(days.time.at(2), 108000.0, 1e-5);
  EXPECT_EQ(days.warnings,
            std::vector<std::string>{"column \"Time\" has no unit, taken as days, as a spreadsheet "
                                     "counts dates (--set columns.time_unit=\"s\" takes seconds)"});
  EXPECT_EQ(timed("Time (s)", dates).time.at(0), 45123.5);
  EXPECT_EQ(timed("Time", dates, {.units = {{Quantity::time, "s"}}}).time.at(0), 45123.5);
  EXPECT_EQ(timed("Time", {"45123.5", "45125.5"}).time.at(0), 45123.5);
  EXPECT_EQ(timed("Time", {"3600", "3600.5"}).time.at(0), 3600.0);
  EXPECT_EQ(timed("Time", {"1764408000", "1764408000.5"}).time.at(0), 1764408000.0);
  EXPECT_EQ(timed("Time", {"12:00:00.1", "12:00:00.2"}).time.at(0), 43200.1);
}

}  // namespace
}  // namespace havers::io
