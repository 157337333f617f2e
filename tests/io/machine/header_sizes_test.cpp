// Sizes of a specimen from the lines above the table.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/machine/read_content.hpp"

namespace havers::io {
namespace {

calib::RawTest sized(const std::string& content, const ReadOptions& options = {}) {
  return test::read_content(content, options).test;
}

TEST(HeaderSizes, TellTheirDecimalMarkWhateverTheTableUses) {
  const std::string commas = "Time (s);Load (N)\n0,1;6,5\n0,2;12,5\n";
  const std::string points = "Time (s),Load (N)\n0.1,6.5\n0.2,12.5\n";
  const std::string whole = "Time (s);Load (N)\n0;6\n1;12\n";
  for (const std::string& content :
       {"Width;4.020;mm\n" + commas, "Width;4,020;mm\n" + commas, "Width;4,02;mm\n" + commas,
        "Width,\"4,020\",mm\n" + points, "Width,\"4,02\",mm\n" + points,
        "Width,4.020,mm\n" + points, "Width;4,020;mm\n" + whole, "Width;4.020;mm\n" + whole}) {
    SCOPED_TRACE(content);
    const calib::RawTest test = sized(content);
    EXPECT_NEAR(test.width.value_or(0.0), 4.02e-3, 1e-15);
    EXPECT_TRUE(test.warnings.empty());
    EXPECT_EQ(test.force.size(), 2U);
  }
}

TEST(HeaderSizes, GroupThousandsByOneOfTwoMarks) {
  const std::string table = "Time (s);Load (N)\n0,1;6,5\n0,2;12,5\n";
  EXPECT_NEAR(sized("Length;1.004,5;mm\n" + table).gauge_length.value(), 1.0045, 1e-12);
  EXPECT_NEAR(sized("Length;1,004.5;mm\n" + table).gauge_length.value(), 1.0045, 1e-12);
}

TEST(HeaderSizes, GiveWayToThoseOfTheUser) {
  ReadOptions options;
  options.width = 8e-3;
  options.thickness = 3e-3;
  options.gauge_length = 25e-3;
  const std::string table = "Load (N),Strain (mm),Stress (MPa)\n10,0.05,1\n20,0.1,2\n";
  for (const std::string header : {"", "Width,4,mm\nThickness,2,mm\nGauge length,50,mm\n"}) {
    const calib::RawTest test = sized(header + table, options);
    EXPECT_EQ(test.width, 8e-3);
    EXPECT_EQ(test.thickness, 3e-3);
    EXPECT_EQ(test.gauge_length, 25e-3);
    ASSERT_EQ(test.strain.size(), 2U);  // an elongation, by the given length
    EXPECT_NEAR(test.strain[0], 2e-3, 1e-15);
    EXPECT_NEAR(test.strain[1], 4e-3, 1e-15);
    EXPECT_EQ(test.warnings.size(), header.empty() ? 0U : 2U);
  }
}

const std::string two_rows = "Time (s),Load (N)\n0,6\n1,12\n";

TEST(HeaderSizes, TakeTheGaugeLengthBeforeABareLength) {
  for (const std::string gauge : {"Gauge length", "Gage length", "Messlänge", "Anfangsmesslänge",
                                  "Longueur initiale", "标距", "L0 - Course standard"})
    for (const std::string bare : {"Length", "Longueur", "Longitud", "Lunghezza", "Długość"}) {
      SCOPED_TRACE(gauge + ", " + bare);
      const std::string first = bare + ",100,mm\n", second = "\"" + gauge + "\",25,mm\n";
      for (const std::string& header : {first + second, second + first}) {
        const calib::RawTest test = sized(header + two_rows);
        EXPECT_EQ(test.gauge_length, 25e-3);
        EXPECT_TRUE(test.warnings.empty());
      }
      EXPECT_EQ(sized(first + two_rows).gauge_length, 0.1);
    }
}

TEST(HeaderSizes, WarnOfTwoValuesOfOneSize) {
  const calib::RawTest widths = sized("Width,4,mm\nSpecimen width,5,mm\n" + two_rows);
  EXPECT_EQ(widths.width, 4e-3);
  EXPECT_EQ(widths.warnings,
            std::vector<std::string>{"line 2, Specimen width: 5 mm differs from "
                                     "4 mm of \"Width\" above: the first is used"});
  const calib::RawTest lengths =
      sized("Length,100,mm\nGauge length,25,mm\nGage length,50,mm\n" + two_rows);
  EXPECT_EQ(lengths.gauge_length, 25e-3);
  ASSERT_EQ(lengths.warnings.size(), 1U);
  EXPECT_NE(lengths.warnings[0].find("50 mm differs from 25 mm of \"Gauge length\""),
            std::string::npos);
  EXPECT_TRUE(sized("Width,4,mm\nBreite,0.4,cm\n" + two_rows).warnings.empty());
}

TEST(HeaderSizes, AreNotComparedWithThoseOfTheUser) {
  ReadOptions options;
  options.gauge_length = 30e-3;
  const calib::RawTest test =
      sized("Length,100,mm\nGauge length,25,mm\nGage length,50,mm\n" + two_rows, options);
  EXPECT_EQ(test.gauge_length, 30e-3);
  EXPECT_TRUE(test.warnings.empty());
}

// A correction is no slip, and a bare length may be that of the whole specimen.
TEST(HeaderSizes, AreSaidWhereThoseOfTheUserAreFarOff) {
  ReadOptions options;
  options.width = 4.0;
  options.thickness = 2.2e-3;
  options.gauge_length = 25e-3;
  const calib::RawTest test =
      sized("Width,4,mm\nThickness,2,mm\nLength,1000,mm\n" + two_rows, options);
  EXPECT_EQ(test.width, 4.0);
  EXPECT_EQ(test.warnings,
            std::vector<std::string>{"line 1, Width: 4 mm here, and 4000 mm is given: the given "
                                     "one is used, check both"});
  EXPECT_EQ(sized("Width,4,mm\n" + two_rows, {.width = 4.8e-3}).warnings,
            std::vector<std::string>{"line 1, Width: 4 mm here, and 4.8 mm is given: the given one "
                                     "is used, check both"});
  EXPECT_EQ(
      sized("Width,40,mm\nGauge length,2.5,mm\n" + two_rows, {.width = 4e-3, .gauge_length = 25e-3})
          .warnings.size(),
      2U);
  EXPECT_EQ(sized("Length,25,mm\n" + two_rows, {.gauge_length = 25e-6}).warnings,
            std::vector<std::string>{"line 1, Length: 25 mm here, and 0.025 mm is given as gauge "
                                     "length: the given one counts where an elongation is to be a "
                                     "strain, check both"});
  EXPECT_EQ(sized("Width,4\n" + two_rows, {.width = 4e-3}).warnings,
            std::vector<std::string>{"line 1, Width: no unit, taken as mm"});
}

TEST(HeaderSizes, AreSaidWhereTheAreaIsNotWidthTimesThickness) {
  const std::vector<std::string> said{
      "the file's area of 8.5 mm² is not width x thickness, 8 mm²: the latter is used, check them"};
  EXPECT_EQ(sized("Width,4,mm\nThickness,2,mm\nArea,8.5,mm²\n" + two_rows).warnings, said);
  const std::string area = "Area,8.5,mm²\n" + two_rows;
  EXPECT_EQ(sized(area, {.width = 4e-3, .thickness = 2e-3}).warnings, said);
  EXPECT_TRUE(sized(area, {.width = 4.26e-3, .thickness = 2e-3}).warnings.empty());
  EXPECT_TRUE(sized(area).warnings.empty());
}

TEST(HeaderSizes, AreKnownWithTheirSymbols) {
  const calib::RawTest test = sized("Breite b0;4,00;mm\nDicke a0;2,00;mm\nMesslänge L0;25,0;mm\n" +
                                    test::replaced(two_rows, ",", ";"));
  EXPECT_EQ(test.width, 4e-3);
  EXPECT_EQ(test.thickness, 2e-3);
  EXPECT_EQ(test.gauge_length, 25e-3);
  EXPECT_DOUBLE_EQ(sized("Cross-sectional area,8.0,mm^2\n" + two_rows).area.value(), 8e-6);
}

TEST(HeaderSizes, TellTheAreaByADiameter) {
  const calib::RawTest test = sized("Diameter,2,mm\n" + two_rows);
  EXPECT_DOUBLE_EQ(test.area.value(), std::numbers::pi * 1e-6);
  EXPECT_TRUE(test.warnings.empty());
  EXPECT_EQ(sized("Area,3.2,mm²\nDiameter,2,mm\n" + two_rows).warnings,
            std::vector<std::string>{"line 2, Diameter: 3.14159 mm² differs from 3.2 mm² of "
                                     "\"Area\" above: the first is used"});
}

TEST(HeaderSizes, DivideAnExtensometersElongationByItsOwnLength) {
  const std::string text =
      "Gauge length,25,mm\nExtensometer gauge length,10,mm\nLoad (N),Strain 1 (mm)\n1,0.1\n2,0.2\n";
  const calib::RawTest test = sized(text);
  EXPECT_DOUBLE_EQ(test.strain.at(1), 0.02);
  EXPECT_EQ(test.gauge_length, 25e-3);
  EXPECT_TRUE(test.warnings.empty());
  const calib::RawTest given = sized(text, {.gauge_length = 20e-3});
  EXPECT_DOUBLE_EQ(given.strain.at(1), 0.01);
  EXPECT_EQ(
      given.warnings,
      std::vector<std::string>{
          "column \"Strain 1\" is an elongation, divided by the given gauge length, 20 mm, and "
          "the file says that its extensometer has 10 mm: without gauge_length_mm that one "
          "counts"});
  EXPECT_EQ(sized("Gauge length,25,mm\nLoad (N),Strain 1 (mm)\n1,0.1\n2,0.2\n").warnings,
            std::vector<std::string>{
                "column \"Strain 1\" is an elongation, divided by the gauge length, 25 mm: of an "
                "extensometer of another length the strain is wrong (gauge_length_mm says it)"});
}

TEST(HeaderSizes, HaveTheirUnitBeforeAColon) {
  const std::string table = test::replaced(two_rows, ",", ";");
  for (const std::string& header :
       {std::string("Breite [cm]:;0,402\nMesslänge [cm] : ;2,5\n"),
        std::string("Breite/cm:;0,402\nMesslänge in cm:;2,5\n"),
        std::string("Width (cm): 0.402\nGauge length [cm]: 2.5\n"),
        std::string("Width (cm) : 4.02 mm\nGauge length (mm): 2.5 cm\n")}) {
    SCOPED_TRACE(header);
    const calib::RawTest test = sized(header + table);
    EXPECT_NEAR(test.width.value_or(0.0), 4.02e-3, 1e-15);
    EXPECT_NEAR(test.gauge_length.value_or(0.0), 25e-3, 1e-15);
    EXPECT_TRUE(test.warnings.empty());
  }
}

TEST(HeaderSizes, ThatTheUserGivesAloneChangeNothingBesideAnArea) {
  const std::string area = "Area,8.5,mm²\n" + two_rows;
  EXPECT_EQ(sized(area, {.width = 4e-3}).warnings,
            std::vector<std::string>{"the width of 4 mm that is given changes nothing: the file's "
                                     "area, 8.5 mm², counts where the thickness is unknown (add "
                                     "thickness_mm)"});
  EXPECT_EQ(sized(area, {.thickness = 2e-3}).warnings,
            std::vector<std::string>{"the thickness of 2 mm that is given changes nothing: the "
                                     "file's area, 8.5 mm², counts where the width is unknown (add "
                                     "width_mm)"});
  EXPECT_TRUE(
      sized("Thickness,2.1,mm\nArea,8.4,mm²\n" + two_rows, {.width = 4e-3}).warnings.empty());
  EXPECT_TRUE(sized("Width,4,mm\n" + area).warnings.empty());
  EXPECT_TRUE(sized(two_rows, {.width = 4e-3}).warnings.empty());
}

}  // namespace
}  // namespace havers::io
