// Every bad input: one sentence that names the file, the line, and what to do.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/input_error.hpp"
#include "io/machine/read_test.hpp"
#include "tests/support/machine_files.hpp"
#include "tests/support/slow.hpp"

namespace havers::io {
namespace {

std::string refusal(const std::filesystem::path& file, const ReadOptions& options = {}) {
  try {
    read_test(file, options);
  } catch (const InputError& error) {
    EXPECT_TRUE(error.problems()[0].where.starts_with(file.string()));
    return test::replaced(error.what(), file.parent_path().string() + "/", "");
  }
  return "read without refusal";
}

std::string complaint_of(const std::string& content, const ReadOptions& options = {}) {
  const test::TemporaryFile file(content);
  return refusal(file.path(), options);
}

const std::string header = "Time (s),Load (N),Extension (mm)\n0,1,2\n1,2,3\n";

TEST(InputFaults, NamesAMissingFile) {
  EXPECT_EQ(refusal("nowhere/none.csv"), "none.csv: there is no such file");
}

TEST(InputFaults, SaysWhyAFileCannotBeRead) {
  const test::TemporaryFile file("x");
  const std::string name(300, 'x');
  EXPECT_TRUE(refusal(file.path().parent_path() / name).starts_with(name + ": cannot be read: "));
}

TEST(InputFaults, NamesAFolder) {
  const test::TemporaryFile file("x");
  EXPECT_NE(refusal(file.path().parent_path()).find("is a folder, not a test file"),
            std::string::npos);
}

TEST(InputFaults, NamesAnEmptyFile) {
  EXPECT_EQ(complaint_of(""), "test.csv: the file is empty");
}

TEST(InputFaults, NamesABinaryFile) {
  EXPECT_EQ(complaint_of(std::string("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16)),
            "test.csv: is not a text file (export the raw data as CSV)");
  EXPECT_EQ(complaint_of(std::string("PK\x03\x04\x14\0\x06\0", 8)),
            "test.csv: is not a text file (a spreadsheet: save it as CSV)");
}

TEST(InputFaults, NamesTextWithoutNumbers) {
  EXPECT_EQ(complaint_of("Dear reader,\nthere is nothing here.\n"),
            "test.csv: no rows of numbers were found in it (a test file has a row of column names "
            "and rows of two numbers or more, separated by commas, semicolons, tabs or |)");
}

TEST(InputFaults, NamesATruncatedRow) {
  EXPECT_EQ(complaint_of(header + "2,3"),
            "test.csv:4: the row ends after 2 of 3 columns (the file may be cut off here)");
}

// As if the table went on below its names, but without the time.
TEST(InputFaults, NamesATruncatedRowBelowNamesThatAreRepeated) {
  const std::string names = "Force (N),Extension (mm),Time (s)\n";
  EXPECT_EQ(complaint_of(names + "1,2,0\n2,3,1\n3,4,2\n" + names + "5,6\n"),
            "test.csv:6: the row ends after 2 of 3 columns (the file may be cut off here)");
}

TEST(InputFaults, NamesTextWhereANumberShouldBe) {
  EXPECT_EQ(complaint_of(header + "2,abc,4\n"),
            "test.csv:4: column \"Load\": \"abc\" is not a number");
  EXPECT_EQ(
      complaint_of(header + "2,,4\n"),
      "test.csv:4: column \"Load\": \"\" is empty (export all channels at one rate, or leave the "
      "row out)");
}

// A clock of colons alone is none; the first row is looked at before the columns are.
TEST(InputFaults, NamesTextThatKeepsARowFromBeingNumbers) {
  const std::string names = "Clock,Load (N),Strain (%)\n",
                    ends = ",1,2\n10:00:01,2,3\n10:00:02,3,4\n";
  for (const std::string cell : {":", "//", "abc"}) {
    const std::string sentence = "test.csv:2: \"" + cell +
                                 "\" stands among numbers (correct it, or "
                                 "leave its column out of the export)";
    EXPECT_EQ(complaint_of(names + cell + ends), sentence);
  }
  EXPECT_EQ(complaint_of("Time,Load (N),Strain (%)\n0:0:0,1,2\n0:0:1,1,2\n:,2,3\n"),
            "test.csv:4: column \"Time\": \":\" is not a number");
}

// Words that name no quantity are no header of a further specimen.
TEST(InputFaults, NamesARowOfTextAmongTheNumbers) {
  EXPECT_EQ(complaint_of(header + "2,3,4\nx,y,z\n3,4,5\n4,5,6\n5,6,7\n"),
            "test.csv:5: column \"Time\": \"x\" is not a number");
}

TEST(InputFaults, NamesNumbersThatAreNone) {
  EXPECT_EQ(complaint_of(header + "2,NaN,4\n"),
            "test.csv:4: column \"Load\": \"NaN\" is not a finite number");
  EXPECT_EQ(complaint_of(header + "2,1e999,4\n"),
            "test.csv:4: column \"Load\": \"1e999\" is too large for a number");
}

TEST(InputFaults, NamesTimeThatGoesBack) {
  EXPECT_EQ(complaint_of(header + "\n0.5,3,4\n"),
            "test.csv:5: time goes back from 1 s to 0.5 s (one table holds one test)");
}

TEST(InputFaults, NamesAFileWithoutForce) {
  EXPECT_EQ(
      complaint_of("Time (s),Extension (mm)\n0,1\n1,2\n"),
      "test.csv:2: no column holds a force or a stress (the columns are Time (s), Extension (mm); "
      "name it in [specimen.columns])");
}

// Names and units in a script that the words are not of: the user says which is which.
TEST(InputFaults, NamesColumnsAndUnitsInWhateverScript) {
  EXPECT_EQ(complaint_of("Время,Сила\n(с),(Н)\n0,1\n1,20\n"),
            "test.csv:3: no column holds a force or a stress (the columns are Время (с), Сила (Н); "
            "name it in [specimen.columns]; from the numbers it may be force = \"2\", extension = "
            "\"1\")");
}

TEST(InputFaults, NamesAQuoteThatIsNeverClosed) {
  HAVERS_SLOW;
  const std::string sentence =
      "a quote is opened and never closed (the file may be cut off or damaged here)";
  EXPECT_EQ(complaint_of(header + "2,\"3,4\n3,4,5\n"), "test.csv:4: " + sentence);
  EXPECT_EQ(complaint_of("\"Key,1\n" + header), "test.csv:1: " + sentence);
  EXPECT_EQ(complaint_of(header + "2,\"3" + std::string(3U << 20U, '\n')),
            "test.csv:4: " + sentence);
}

// Numbers that are read as if each line had been quoted would hide it.
TEST(InputFaults, NamesAnOpenQuoteEvenWhereMostRowsWouldReadWithoutIt) {
  std::string rows = header + "2,\"3,4\n";
  for (int i = 3; i < 1000; ++i) rows += std::to_string(i) + ",4,5\n";
  EXPECT_EQ(complaint_of(rows),
            "test.csv:4: a quote is opened and never closed (the file may be cut off or damaged "
            "here)");
}

TEST(InputFaults, NamesAFileLargerThanAnyTest) {
  const test::TemporaryFile file(header);
  std::filesystem::resize_file(file.path(), 2'000'000'000);  // sparse
  EXPECT_EQ(refusal(file.path()),
            "test.csv: is larger than 1000 MB, which no tensile test is (export one test alone, or "
            "fewer rows a second)");
}

TEST(InputFaults, NamesAMillionColumns) {
  std::string names = "a", row = "1";
  for (int i = 1; i < 1'000'000; ++i) {
    names += ",a";
    row += ",1";
  }
  EXPECT_EQ(complaint_of(names + "\n" + row + "\n" + row + "\n"),
            "test.csv:1: has more than 10000 columns (a test has a row for each time and a column "
            "for each channel)");
  EXPECT_EQ(complaint_of(header + row + "\n"),
            "test.csv:4: the row has 1000000 cells, and there are 3 columns (is the decimal mark "
            "also the delimiter?)");
}

TEST(InputFaults, NamesAFirstLineOfMegabytes) {
  const std::string sentence =
      "test.csv: no rows of numbers were found in it (a test file has a row of column names and "
      "rows of two numbers or more, separated by commas, semicolons, tabs or |)";
  EXPECT_EQ(complaint_of(std::string(5'000'000, 'x') + "\n" + header), sentence);
  EXPECT_EQ(complaint_of(std::string(5'000'000, '1') + "\n" + header), sentence);
}

TEST(InputFaults, ShowsTheBeginningOfALongCell) {
  HAVERS_SLOW;
  EXPECT_EQ(complaint_of(header + "2," + std::string(500'000, 'z') + ",4\n"),
            "test.csv:4: column \"Load\": \"" + std::string(60, 'z') + "...\" is not a number");
}

TEST(InputFaults, NamesANumberThatItsUnitMakesTooLarge) {
  EXPECT_EQ(complaint_of("Time (s),Stress (GPa)\n0,1\n1,1e300\n"),
            "test.csv:3: column \"Stress\": \"1e300\" is too large for a number");
}

TEST(InputFaults, NamesARowWithMoreCellsThanNames) {
  EXPECT_EQ(
      complaint_of(header + "2,3,4,\n3,4,5,6\n"),
      "test.csv:5: the row has 4 cells, and there are 3 columns (is the decimal mark also the "
      "delimiter?)");
}

TEST(InputFaults, AsksForTheNamesOfColumnsAndGuesses) {
  EXPECT_EQ(
      complaint_of("0,0.1,5\n1,0.2,60\n2,0.25,90\n3,0.3,130\n"),
      "test.csv:1: the columns have no names (say which is which in [specimen.columns]; from the "
      "numbers it may be time = \"1\", force = \"3\", extension = \"2\")");
}

TEST(InputFaults, NamesAColumnThatIsNotThere) {
  EXPECT_EQ(complaint_of(header, {{{Quantity::force, {"Kraft", ""}}}}),
            "test.csv:2: there is no column \"Kraft\" (the columns are Time (s), Load (N), "
            "Extension (mm))");
  EXPECT_EQ(
      complaint_of(header, {{{Quantity::force, {"2", "mm"}}}}),
      "test.csv:2: \"mm\" is not a known unit of force (force_unit may be N, kN, lbf, kgf, V, or "
      "a factor such as 500 N/V)");
}

TEST(InputFaults, CollectsAFewAndThenStops) {
  std::string rows = header;
  for (int i = 0; i < 100; ++i) rows += "2,x,4\n";
  const std::string said = complaint_of(rows);
  EXPECT_EQ(std::ranges::count(said, '\n'), 4) << said;
}

}  // namespace
}  // namespace havers::io
