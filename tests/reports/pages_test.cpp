// Pages of sections and of several fits.
#include "reports/pages.hpp"

#include <gtest/gtest.h>

#include "calib/porosity/scatter_map.hpp"
#include "reports/text/format.hpp"
#include "tests/reports/sound_page.hpp"

namespace havers::reports {
namespace {

using test::after;
using test::contains;
using test::expect_sound;

TEST(PorosityPage, ShowsEverySectionWithItsOverlay) {
  auto section = test::fit_sample().study.specimens.front().sections.front();
  section.warnings = {"The bone touches the edge of the image."};
  section.zones = {{"outer third", 0.031, 2e-6}};
  const calib::DepthHistogram histogram{{0.0, 0.5, 1.0}, {0.9, 0.02, 0.08}, 0.48};
  PorosityReport report{.sections = {section, section},
                        .overlays = {test::tiny_png(), test::tiny_png()},
                        .scatter = {0.41, 0.41},
                        .histograms = {histogram, histogram},
                        .mean = calib::pool_sections({section, section}),
                        .provenance = {.command = "havers porosity a.png"}};
  const std::string page = porosity_page(report);
  expect_sound(page);
  EXPECT_TRUE(contains(page, "4.80\u00a0±\u00a00.21"));
  EXPECT_TRUE(contains(page, "0.410"));
  EXPECT_TRUE(contains(page, "The bone touches the edge of the image."));
  EXPECT_TRUE(contains(page, "outer third"));
  EXPECT_TRUE(contains(page, ">threshold<"));
  EXPECT_TRUE(contains(page, "at a depth of 0.490, 0 bone, 1 pore"));
  EXPECT_TRUE(contains(page, "lacunae below 15 µm"));
  EXPECT_TRUE(contains(page, "Pores are smaller than the window of one fibre"));
  EXPECT_TRUE(contains(
      page, "by a scatter of d = " + plus_minus(calib::scatter_of(report.mean, {}),
                                                calib::scatter_standard_error(report.mean, {}))));
  EXPECT_EQ(after(page, "<img", " ").size(), 2U);

  EXPECT_TRUE(contains(page, "verdict good"));
  EXPECT_FALSE(contains(page, "in doubt"));

  report.sections[1].doubtful = true;
  report.sections[1].mean_pore_diameter = std::numeric_limits<double>::quiet_NaN();
  const std::string doubted = porosity_page(report);
  EXPECT_TRUE(contains(doubted, "verdict mixed"));
  EXPECT_TRUE(contains(doubted, "%, 1 of them in doubt: see the warnings."));
  EXPECT_TRUE(contains(doubted, "<td class=\"n\">–</td>"));

  for (calib::SectionPorosity& one : report.sections) {
    one.window_area = 1e-9;
    one.pore_area_ratio = 2e-9;
  }
  report.mean = calib::pool_sections(report.sections);
  const std::string large = porosity_page(report);
  EXPECT_TRUE(contains(large, "of the joints away"));
  EXPECT_TRUE(contains(large, "a*: mean area of the pore that a random point"));
  EXPECT_TRUE(contains(large, "– (4.80\u00a0% missing)"));
  EXPECT_FALSE(contains(large, "0.410"));
}

TEST(PorosityPage, SaysThatTwoReferencesDoNotCheckTheirLine) {
  auto section = test::fit_sample().study.specimens.front().sections.front();
  section.density = 1900.0;
  PorosityReport report{.sections = {section},
                        .overlays = {test::tiny_png()},
                        .scatter = {0.41},
                        .histograms = {{}},
                        .mean = calib::pool_sections({section})};
  report.sections.front().density_residual = test::nan;
  EXPECT_TRUE(contains(porosity_page(report), "(two references: no check of their line)"));
  report.sections.front().density_residual = 14.0;
  EXPECT_TRUE(contains(porosity_page(report), "(references 14\u00a0kg&#x2F;m³ about their line)"));
}

// A sheet of A4 is narrower than a narrow window: what scrolls there would be cut on paper.
TEST(Style, ScrollsOnScreensAlone) {
  const std::string page = comparison_page({});
  EXPECT_EQ(after(page, "@media ", "{"),
            (std::vector<std::string>{"screen and (max-width: 48em) ", "print "}));
}

TEST(ComparisonPage, PutsFitsSideBySide) {
  const auto a = test::fit_sample();
  auto b = test::fit_sample();
  b.study.name = "bovine femur B";
  b.result.parameters.pop_back();
  b.result.parameters.front().value = 14.2;
  b.result.verdict.front().outcome = calib::Outcome::fail;
  const std::string page = comparison_page({{a.study, a.result, {}, {.wall_seconds = 38.2}},
                                            {b.study, b.result, {}, {.wall_seconds = 61.0}}});
  expect_sound(page);
  EXPECT_EQ(after(page, "<p class=\"sentence\">", "<").front(),
            "1 of 2 fits cannot be trusted (bovine femur B), 1 with reservations.");
  EXPECT_TRUE(contains(page, "13.123\u00a0±\u00a00.087"));
  EXPECT_TRUE(contains(page, "14.200\u00a0±\u00a00.087"));
  EXPECT_TRUE(contains(page, "<td>bovine femur B</td><td class=\"n\">14.200"));  // wide as one fit
  EXPECT_EQ(test::after(page, "<th>E (GPa) <", ">").size(), 1U);
  EXPECT_TRUE(contains(page, "The fit cannot be trusted: 1 of 4 checks failed (search)."));
  EXPECT_TRUE(contains(page, "1\u00a0min 1\u00a0s"));
  EXPECT_TRUE(contains(page, "bovine femur B: Wall time"));
  expect_sound(comparison_page({}));
}

}  // namespace
}  // namespace havers::reports
