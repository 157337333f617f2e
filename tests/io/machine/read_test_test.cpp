// The same small test in every dress that a machine may give it.
#include "io/machine/read_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/input_error.hpp"
#include "tests/io/machine/read_content.hpp"
#include "tests/support/slow.hpp"

namespace havers::io {
namespace {

using test::encoded;
using test::read_content;
using test::replaced;

const std::string bluehill =
    "Specimen number (included),1\r\n"
    "Length,\"25.00000\",mm\r\n"
    "Specimen ID,\"0038\"\r\n"
    "Thickness,\"2.00000\",mm\r\n"
    "Width,\"4.00000\",mm\r\n"
    "\r\n"
    "Time,Extension,Load,Tensile strain (Strain 1),Tensile stress\r\n"
    "(s),(mm),(N),(%),(MPa)\r\n"
    "\"0.00000\",\"-0.01000\",\"10.00000\",\"-0.0010\",\"1.2500\"\r\n"
    "\"0.10000\",\"0.02000\",\"1,004.80328\",\"0.0500\",\"125.6004\"\r\n"
    "\"0.20000\",\"0.04000\",\"1,204.00000\",\"0.1000\",\"150.5000\"\r\n";

void expect_the_numbers(const TestFile& file) {
  const calib::RawTest& raw = file.test;
  ASSERT_EQ(file.rows, 3U);
  EXPECT_EQ(raw.time, (std::vector{0.0, 0.1, 0.2}));
  EXPECT_NEAR(raw.extension[0], -1e-5, 1e-18);
  EXPECT_EQ(raw.force, (std::vector{10.0, 1004.80328, 1204.0}));
  ASSERT_EQ(raw.strain.size(), 3U);
  EXPECT_NEAR(raw.strain[1], 5e-4, 1e-18);
  EXPECT_NEAR(raw.stress[1], 125.6004e6, 1e-6);
}

TEST(ReadTest, ReadsBluehill) {
  const TestFile file = read_content(bluehill);
  EXPECT_EQ(file.layout, "Bluehill raw data");
  EXPECT_EQ(file.encoding, "ASCII");
  EXPECT_EQ(file.delimiter, ",");
  EXPECT_EQ(file.decimal, ".");
  EXPECT_EQ(file.test.specimen_id, "0038");
  EXPECT_DOUBLE_EQ(file.test.gauge_length.value(), 25e-3);
  EXPECT_DOUBLE_EQ(file.test.width.value(), 4e-3);
  EXPECT_DOUBLE_EQ(file.test.thickness.value(), 2e-3);
  EXPECT_EQ(file.columns[3].name, "Tensile strain (Strain 1)");
  EXPECT_EQ(file.columns[3].unit, "%");
  EXPECT_EQ(file.columns[3].quantity, Quantity::strain);
  EXPECT_TRUE(file.test.warnings.empty());
  expect_the_numbers(file);
}

TEST(ReadTest, ReadsEveryLineEnd) {
  for (const char* end : {"\n", "\r", "\r\r\n"}) {
    SCOPED_TRACE(testing::PrintToString(end));
    expect_the_numbers(read_content(replaced(bluehill, "\r\n", end)));
  }
}

TEST(ReadTest, ReadsALastRowWithoutItsLineEnd) {
  expect_the_numbers(read_content(bluehill.substr(0, bluehill.size() - 2)));
}

TEST(ReadTest, ReadsEveryEncoding) {
  const std::string french =
      replaced(replaced(bluehill, "Width", "Largeur"), "Extension", "Déplacement");
  for (const auto& [content, name] : std::vector<std::pair<std::string, std::string>>{
           {french, "UTF-8"},
           {"\xEF\xBB\xBF" + french, "UTF-8 with BOM"},
           {encoded(french, "ISO-8859-1"), "ISO-8859-1"},
           {"\xFF\xFE" + encoded(french, "UTF-16LE"), "UTF-16LE"},
           {"\xFE\xFF" + encoded(french, "UTF-16BE"), "UTF-16BE"},
           {std::string("\xFF\xFE\0\0", 4) + encoded(french, "UTF-32LE"), "UTF-32LE"},
           {std::string("\0\0\xFE\xFF", 4) + encoded(french, "UTF-32BE"), "UTF-32BE"},
           {encoded(french, "UTF-16LE"), "UTF-16LE"},
           {encoded(french, "UTF-16BE"), "UTF-16BE"},
           {encoded(replaced(french, "0038", "“38”"), "WINDOWS-1252"), "WINDOWS-1252"}}) {
    SCOPED_TRACE(name);
    const TestFile file = read_content(content);
    EXPECT_EQ(file.encoding, name);
    EXPECT_EQ(file.columns[1].name, "Déplacement");
    EXPECT_DOUBLE_EQ(file.test.width.value(), 4e-3);
    expect_the_numbers(file);
  }
}

TEST(ReadTest, LosesNoMoreThanTheHalfCharacterOfUtf16) {
  const std::string lone("\x00\xD8", 2);
  expect_the_numbers(read_content("\xFF\xFE" + encoded("Label,\"A", "UTF-16LE") + lone +
                                  encoded("B\"\r\n" + bluehill, "UTF-16LE")));
}

TEST(ReadTest, ReadsPolishInItsCodePage) {
  std::string polish = replaced(bluehill, "Width", "Szerokość");
  polish = replaced(replaced(polish, "Load", "Siła"), "Extension", "Wydłużenie");
  polish = replaced(replaced(polish, "Tensile strain (Strain 1)", "Odkształcenie"), "Thickness",
                    "Grubość");
  const TestFile file =
      read_content(encoded(replaced(polish, "Tensile stress", "Naprężenie"), "WINDOWS-1250"));
  EXPECT_EQ(file.encoding, "WINDOWS-1250");
  EXPECT_EQ(file.columns[2].name, "Siła");
  EXPECT_DOUBLE_EQ(file.test.width.value(), 4e-3);
  expect_the_numbers(file);
}

TEST(ReadTest, ReadsAMicrometreInLatin1) {
  const TestFile file = read_content(encoded("Force (N);Weg (µm)\n1;100\n2;200\n", "ISO-8859-1"));
  EXPECT_EQ(file.encoding, "ISO-8859-1");
  EXPECT_DOUBLE_EQ(file.test.extension[1], 200e-6);
}

// The same cells with another delimiter and decimal mark.
std::string dressed(char delimiter, char decimal, const std::string& thousands) {
  std::string text;
  bool quoted = false;
  for (std::size_t i = 0; i < bluehill.size(); ++i) {
    const char c = bluehill[i];
    const bool in_number = i > 0 && std::isdigit(static_cast<unsigned char>(bluehill[i - 1])) != 0;
    if (c == '"') quoted = !quoted;
    if (c == '"') continue;
    if (c == ',' && quoted)
      text += thousands;
    else if (c == ',')
      text += delimiter;
    else
      text += c == '.' && in_number ? decimal : c;
  }
  return text;
}

TEST(ReadTest, ReadsEveryDelimiterAndDecimalMark) {
  struct Dress {
    char delimiter, decimal;
    std::string thousands;
  };
  for (const auto& [delimiter, decimal, thousands] :
       {Dress{',', '.', ""}, Dress{';', '.', ","}, Dress{';', ',', ""}, Dress{';', ',', "."},
        Dress{'\t', '.', ","}, Dress{'\t', ',', "\xC2\xA0"}, Dress{'\t', ',', "'"},
        Dress{';', ',', " "}}) {
    SCOPED_TRACE(testing::Message() << delimiter << ' ' << decimal << ' ' << thousands);
    const TestFile file = read_content(dressed(delimiter, decimal, thousands));
    EXPECT_EQ(file.delimiter, std::string(1, delimiter));
    EXPECT_EQ(file.decimal, std::string(1, decimal));
    EXPECT_DOUBLE_EQ(file.test.width.value(), 4e-3);
    expect_the_numbers(file);
  }
}

TEST(ReadTest, ReadsDecimalCommasInQuotes) {
  const TestFile file = read_content("Temps,Force\n(s),(kN)\n\"0,0\",\"0,5\"\n\"0,1\",\"1,25\"\n");
  EXPECT_EQ(file.delimiter, ",");
  EXPECT_EQ(file.decimal, ",");
  EXPECT_EQ(file.test.force, (std::vector{500.0, 1250.0}));
}

TEST(ReadTest, ReadsUnitsInTheNamesAndTrailingDelimiters) {
  const TestFile file = read_content(
      "S/No;C_1_Temps[s];C_1_Force[kN];C_1_Cycles[];C_1_Déplacement[mm];\n"
      "1;0.1;1.5;0;0.001;\n2;0.2;1.6;0;0.002;\n");
  EXPECT_EQ(file.layout, "table");
  EXPECT_EQ(file.test.force, (std::vector{1500.0, 1600.0}));
  EXPECT_EQ(file.test.extension, (std::vector{1e-6, 2e-6}));
  EXPECT_TRUE(file.test.warnings.empty());
}

TEST(ReadTest, ReadsUnitsWithoutBracketsBelowATitle) {
  const TestFile file = read_content(
      "\"C35\",,\r\n\"Temps\",\"Force\",\"Stroke\"\r\n\"sec\",\"N\",\"mm\"\r\n0,1,2\r\n1,2,3\r\n");
  EXPECT_EQ(file.columns[2].unit, "mm");
  EXPECT_EQ(file.test.extension, (std::vector{2e-3, 3e-3}));
}

TEST(ReadTest, SaysWhichUnitItAssumed) {
  const TestFile file = read_content("Time,Load\n0,1\n1,2\n");
  ASSERT_EQ(file.test.warnings.size(), 2U);
  EXPECT_EQ(file.test.warnings[1], "column \"Load\" has no unit, taken as N");
}

TEST(ReadTest, FindsColumnsByTheirUnitWhereTheNameSaysNothing) {
  const TestFile file = read_content("A (s),B (kN),C (mm),D (%)\n0,1,2,3\n1,2,3,4\n");
  EXPECT_EQ(file.test.force, (std::vector{1000.0, 2000.0}));
  EXPECT_EQ(file.test.extension, (std::vector{2e-3, 3e-3}));
  EXPECT_TRUE(file.test.strain.empty());
}

TEST(ReadTest, TakesTheUsersWordForAColumn) {
  const ReadOptions options{{{Quantity::force, {"Load 2", "kN"}}, {Quantity::strain, {"3", "%"}}}};
  const TestFile file = read_content("Load (N),Load 2,D\n1,2,3\n2,3,4\n", options);
  EXPECT_EQ(file.test.force, (std::vector{2000.0, 3000.0}));
  EXPECT_EQ(file.test.strain, (std::vector{0.03, 0.04}));
}

TEST(ReadTest, ReadsColumnsWithoutNamesOnceTheyAreNamed) {
  const ReadOptions options{{{Quantity::time, {"1", "s"}}, {Quantity::force, {"2", "N"}}}};
  EXPECT_EQ(read_content("0,5\n1,6\n2,7\n", options).test.force, (std::vector{5.0, 6.0, 7.0}));
}

TEST(ReadTest, TurnsTheElongationOfAGaugeIntoStrain) {
  const std::string table = "Load (N),Strain 1 (mm)\n1,0.05\n2,0.1\n";
  EXPECT_EQ(read_content("Gauge length,50,mm\n" + table).test.strain, (std::vector{1e-3, 2e-3}));
  const TestFile unknown = read_content(table);
  EXPECT_TRUE(unknown.test.strain.empty());
  EXPECT_NE(unknown.test.warnings.at(0).find("the gauge length is unknown"), std::string::npos);
}

TEST(ReadTest, UsesTheFirstOfTwoColumnsAndSaysHowToChoose) {
  const std::string table = "Load (N),Load 2 (N)\n1,5\n2,6\n";
  const TestFile file = read_content(table);
  EXPECT_EQ(file.test.force, (std::vector{1.0, 2.0}));
  EXPECT_EQ(file.test.warnings.at(0),
            "columns \"Load\" and \"Load 2\" both hold force: \"Load\" is used (force = 2 in "
            "[specimen.columns] takes the other)");
  const TestFile chosen = read_content(table, {{{Quantity::force, {"2", ""}}}});
  EXPECT_EQ(chosen.test.force, (std::vector{5.0, 6.0}));
  EXPECT_TRUE(chosen.test.warnings.empty());
}

TEST(ReadTest, WarnsOfAStressThatIsNotForceOverArea) {
  const TestFile file = read_content(replaced(bluehill, "Width,\"4", "Width,\"5"));
  ASSERT_EQ(file.test.warnings.size(), 1U);
  EXPECT_NE(file.test.warnings[0].find("check width and thickness"), std::string::npos);
}

TEST(ReadTest, WarnsOfAHeaderLineItCannotUse) {
  const TestFile text = read_content(replaced(bluehill, "\"4.00000\"", "n/a"));
  EXPECT_FALSE(text.test.width);
  EXPECT_EQ(text.test.warnings.at(0), "line 5, Width: \"n/a\" is no size; the line is not used");
  const TestFile unit = read_content(replaced(bluehill, "\"4.00000\",mm", "\"4.00000\",s"));
  EXPECT_EQ(unit.test.warnings.at(0),
            "line 5, Width: \"s\" is not a known unit of it; the line is not used");
  const TestFile none = read_content(replaced(bluehill, "\"4.00000\",mm", "\"4.00000\""));
  EXPECT_EQ(none.test.warnings.at(0), "line 5, Width: no unit, taken as mm");
  EXPECT_DOUBLE_EQ(none.test.width.value(), 4e-3);
}

// More than one block of the source, so that rows and characters lie across its borders.
TEST(ReadTest, ReadsALongFileAsAShortOne) {
  HAVERS_SLOW;
  std::string rows = "Temps (s);Déplacement (mm);Force (N)\n";
  for (int i = 0; i < 60000; ++i) rows += std::to_string(i) + ";0,25;é" + "\n";
  rows = replaced(rows, "é\n",
                  "1\xC2\xA0"
                  "000,5\n");
  for (const char* encoding : {"UTF-8", "ISO-8859-1", "UTF-16LE"}) {
    SCOPED_TRACE(encoding);
    const TestFile file = read_content(encoded(rows, encoding));
    ASSERT_EQ(file.rows, 60000U);
    EXPECT_EQ(file.test.time.back(), 59999.0);
    EXPECT_TRUE(std::ranges::all_of(file.test.force, [](double f) { return f == 1000.5; }));
  }
}

}  // namespace
}  // namespace havers::io
