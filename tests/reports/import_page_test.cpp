#include <gtest/gtest.h>

#include "reports/pages.hpp"
#include "tests/reports/sound_page.hpp"

namespace havers::reports {
namespace {

using test::after;
using test::contains;
using test::expect_sound;

class ImportPage : public testing::Test {
 protected:
  calib::RawTest raw = test::raw_test(13e9, 43e6, 1);
  calib::MeasuredTest measured = test::measured_test(13e9, 43e6, 1);
};
using TestSvg = ImportPage;

// As a machine records it that counts tension negative: no axis goes below zero for it.
TEST_F(ImportPage, DrawsATurnedLoadAsItWasUsed) {
  for (std::vector<double>* channel : {&raw.force, &raw.stress})
    for (double& value : *channel) value = -value;
  for (const bool turned : {false, true}) {
    measured.load_turned = turned;
    const std::string svg = test_svg({"A1.csv", raw, measured});
    EXPECT_EQ(contains(svg, ">as read, sign turned<"), turned);
    EXPECT_EQ(contains(svg, ">−10<"), !turned);
  }
}

// A test that was joined with a logger comes turned.
TEST_F(ImportPage, SaysThatALoadWasTurnedBeforeItWasJoined) {
  raw.load_turned = measured.load_turned = true;
  const std::string svg = test_svg({"A1.csv", raw, measured});
  EXPECT_TRUE(contains(svg, ">as read, sign turned<"));
  EXPECT_FALSE(contains(svg, ">−10<"));
  EXPECT_TRUE(contains(test_svg({"A1.csv", raw, {}}), ", sign turned<"));
}

TEST_F(ImportPage, SaysWhatTheAreaIs) {
  raw.width = 4e-3;
  raw.thickness = 2e-3;
  raw.area = 7.5e-6;
  EXPECT_TRUE(
      contains(import_page({{"A1.csv", raw, measured}}, {}), "8\u00a0mm², width × thickness<"));
  raw.thickness.reset();
  EXPECT_TRUE(contains(import_page({{"A1.csv", raw, measured}}, {}), ">7.5\u00a0mm²<"));
}

TEST_F(ImportPage, CallsNothingAlignedWhereTheClocksAreNot) {
  calib::ClockFit clocks;
  const auto page = [&] { return import_page({{"A1.csv", raw, measured, {}, &clocks}}, {}); };
  EXPECT_TRUE(contains(page(), "the aligned signals"));
  clocks.problem = "the signals do not determine the two clocks: several offsets fit alike";
  EXPECT_FALSE(contains(page(), "the aligned signals"));
  EXPECT_TRUE(contains(page(), "cannot be aligned: the signals do not determine the two clocks"));
}

TEST_F(ImportPage, ShowsNumbersCorrectionsAndWarningsOfEveryTest) {
  measured.warnings = {"The curve is not linear to failure."};
  const std::string page =
      import_page({{"a/A1.csv", raw, measured}, {"a/A2.csv", raw, measured}}, {});
  expect_sound(page);
  EXPECT_TRUE(contains(page, "<h2>A1.csv</h2>"));
  EXPECT_TRUE(contains(page, "<h2>A2.csv</h2>"));
  EXPECT_TRUE(
      contains(page, "13.000\u00a0±\u00a00.078\u00a0GPa, in the window 0.033 to 0.132\u00a0%"));
  EXPECT_TRUE(contains(page, "strain shifted by 2.0\u00a0×\u00a010⁻⁴"));
  EXPECT_TRUE(contains(page, "The curve is not linear to failure."));
  EXPECT_FALSE(contains(page, "at least"));

  measured.broke = false;
  const std::string stopped = import_page({{"a/A1.csv", raw, measured}}, {});
  EXPECT_TRUE(contains(stopped, "Strength, at least"));
  EXPECT_TRUE(contains(stopped, "Failure strain, at least"));
  EXPECT_TRUE(contains(stopped, "<td class=\"n\">≥ "));
}

TEST_F(ImportPage, SaysFirstWhetherTheTestsCanBeUsed) {
  measured.warnings.clear();
  const calib::MeasuredTest none;
  std::vector<ImportReport> reports{{"A1.csv", raw, measured}};
  const auto verdict = [&] {
    return after(import_page(reports, {}), "<p class=\"sentence\">", "<");
  };
  EXPECT_EQ(verdict(), std::vector<std::string>{"The test can be used."});
  reports.push_back({"data/A2.csv", raw, none, {"no column is a force"}});
  EXPECT_EQ(verdict(), std::vector<std::string>{"1 of 2 tests cannot be used (A2.csv)."});
  EXPECT_TRUE(contains(import_page(reports, {}), "verdict bad"));
}

TEST_F(ImportPage, SurvivesAnEmptyTest) {
  raw = {};
  measured = {};
  expect_sound(import_page({{"empty.csv", raw, measured}}, {}));
  expect_sound(import_page({}, {}));
}

TEST_F(TestSvg, StandsOnItsOwn) {
  const std::string svg = test_svg({"A1.csv", raw, measured});
  EXPECT_TRUE(contains(svg, "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_TRUE(contains(svg, "modulus; window shaded"));
  EXPECT_LT(svg.size(), 200'000U);
}

// The parted specimen goes back in strain: a line would look like a second loading.
TEST_F(TestSvg, DrawsWhatWasReadAfterTheBreakApart) {
  measured.time = raw.time;
  EXPECT_FALSE(contains(test_svg({"A1.csv", raw, measured}), ">read after the break<"));
  measured.time.resize(raw.time.size() / 2);
  EXPECT_TRUE(contains(test_svg({"A1.csv", raw, measured}), ">read after the break<"));
}

TEST_F(TestSvg, DrawsTheStepsOfAClockThatRepeatsItself) {
  EXPECT_FALSE(contains(test_svg({"A1.csv", raw, measured}), "Time step (s)"));
  for (double& time : raw.time) time = std::floor(time);
  EXPECT_TRUE(contains(test_svg({"A1.csv", raw, measured}), "Time step (s)"));
}

}  // namespace
}  // namespace havers::reports
