#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "calib/porosity/scatter_map.hpp"
#include "reports/bench_pages.hpp"
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
                        .provenance = {{"seed", "1"}}};
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

sim::WorkPrecision work_precision_sample() {
  const auto row = [](sim::BenchSetting setting, double error, int trusted) {
    sim::BenchRow made{.setting = setting, .runs = 1, .trusted = trusted};
    made.wall = made.cpu = {0.2, 0.1, 0.3};
    made.errors = {.bonded_forces = {error, error, error, 1},
                   .failure_strain = {error, 0.5 * error, 2.0 * error, 1}};
    made.steps = made.iterations = {1'234'567.0, 0.0, 0.0};
    return made;
  };
  const sim::BenchSetting reference{.step = 1e-11};
  sim::WorkPrecision study{.complete = true, .reference = reference};
  study.rows = {row(reference, 0.0, 1), row({.step = 2e-8}, 3e-6, 1),
                row({.contact = sim::ContactMethod::gauss_seidel, .step = 2e-8}, 3e-5, 0)};
  study.cheapest = {{.quantity = "failure strain", .target = 1e-3, .row = 1}};
  study.omissions = sim::Omissions{{.step = 2e-8}, 1.3e-13, 1.7};
  return study;
}

TEST(WorkPrecisionPage, WritesNumbersAsAReaderDoes) {
  const sim::WorkPrecision study = work_precision_sample();
  const sim::Scene scene;
  const std::string page = work_precision_page(scene, study, {{"seed", "1"}});
  expect_sound(page);
  EXPECT_TRUE(contains(page, "Gauss-Seidel 10⁻⁸, h = 20\u00a0ns, 8 triangles a fibre"));
  EXPECT_TRUE(contains(page, "h = 10\u00a0ps"));
  EXPECT_TRUE(
      contains(page, "3.0\u00a0×\u00a010⁻⁶ (1.5\u00a0×\u00a010⁻⁶ to 6.0\u00a0×\u00a010⁻⁶)"));
  EXPECT_TRUE(contains(page, ">1234567<"));
  EXPECT_TRUE(
      contains(page, "differs by 1.3\u00a0×\u00a010⁻¹³ at most and takes 1.7 times the CPU time"));
  EXPECT_TRUE(contains(page, "1 of 1 not to be trusted"));
  EXPECT_FALSE(contains(page, "e-0"));
}

TEST(WorkPrecisionPage, ShowsFailureStrainsWhereNoForcesOfTheIntactSpecimenAre) {
  sim::WorkPrecision study = work_precision_sample();
  for (sim::BenchRow& row : study.rows)
    row.errors.bonded_forces.median = std::numeric_limits<double>::quiet_NaN();
  const std::string page = work_precision_page({}, study, {});
  EXPECT_TRUE(contains(page, "Relative error of failure strain"));
  EXPECT_FALSE(contains(page, "Relative error of joint forces"));
}

TEST(WorkPrecisionPage, SaysWhatForcesBeforeTheFirstBreakAreComparedWith) {
  sim::WorkPrecision study = work_precision_sample();
  const std::string_view words = "before the first break are relative to their closed form";
  EXPECT_FALSE(contains(work_precision_page({}, study, {}), words));
  study.closed_form = true;
  EXPECT_TRUE(contains(work_precision_page({}, study, {}), words));
}

// Pieces of the thin lines in both panels, of rows with these settings.
long pieces_of_lines(const std::vector<sim::BenchSetting>& settings) {
  sim::WorkPrecision study = work_precision_sample();
  const sim::BenchRow row = study.rows[1];
  study.rows.resize(1);
  for (const sim::BenchSetting& setting : settings) {
    study.rows.push_back(row);
    const double cpu = 0.1 * static_cast<double>(study.rows.size());
    study.rows.back().setting = setting;
    study.rows.back().cpu = {cpu, cpu, cpu};
  }
  const std::string svg = work_precision_svg(study), line = "stroke-width=\"0.80\"";
  long pieces = 0;
  for (std::size_t at = svg.find(line); at != std::string::npos; at = svg.find(line, at + 1))
    pieces += std::ranges::count(svg.substr(at, svg.find("</g>", at) - at), 'L');
  return pieces;
}

TEST(WorkPrecisionFigure, JoinsTheStepsOfOneSolverToleranceAndMesh) {
  const auto sweeps = [](double tolerance, double step) {
    return sim::BenchSetting{
        .contact = sim::ContactMethod::gauss_seidel, .tolerance = tolerance, .step = step};
  };
  EXPECT_EQ(pieces_of_lines({{.step = 2e-8}, {.step = 5e-9}}), 2);
  EXPECT_EQ(pieces_of_lines({{.step = 2e-8}, {}}), 0) << "a chosen step is none of them";
  EXPECT_EQ(pieces_of_lines({sweeps(1e-4, 2e-8), sweeps(1e-4, 5e-9), sweeps(1e-6, 2e-8)}), 2);
}

TEST(WorkPrecisionPage, IsNotGreenWithoutAReference) {
  sim::WorkPrecision study = work_precision_sample();
  EXPECT_TRUE(contains(work_precision_page({}, study, {}), "verdict good"));
  study.rows.front().trusted = 0;
  EXPECT_TRUE(contains(work_precision_page({}, study, {}), "verdict bad"));
}

TEST(WorkPrecisionPage, IsNotGreenWhereNothingComesNearTheReference) {
  sim::WorkPrecision study = work_precision_sample();
  study.cheapest.front().row = {};
  study.rows[1].errors.failure_strain = {0.0005, 0.0001, 0.0042, 1};
  const std::string page = work_precision_page({}, study, {});
  EXPECT_TRUE(contains(page, "verdict mixed"));
  EXPECT_TRUE(contains(
      page,
      "0.1\u00a0% for every seed; the nearest comes to 0.42\u00a0%: active set, h = 20\u00a0ns, "));
}

TEST(WorkPrecisionPage, NamesNoSettingForWhatTheReferenceIsNotKnownTo) {
  sim::WorkPrecision study = work_precision_sample();
  study.cheapest.front() = {.target = 1e-3, .reference_error = 0.0096};
  EXPECT_TRUE(contains(work_precision_page({}, study, {}),
                       "cannot be told: the reference may err by 0.0096"));
}

TEST(WorkPrecisionPage, SaysHowFarRunsCameThatWereStopped) {
  sim::WorkPrecision study = work_precision_sample();
  study.time_limit = 20.0;
  sim::BenchRow& stopped = study.rows.back();
  stopped.out_of_time = 1;
  stopped.reached = {0.004, 0.0021, 0.004};  // of all seeds
  stopped.stopped_at = {0.0021, 0.0021, 0.0021};
  EXPECT_TRUE(contains(work_precision_page({}, study, {}),
                       "1 of 1 stopped after 20.0\u00a0s, at a strain of 0.210\u00a0%"));
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
  const std::string page = comparison_page({{a.study, a.result, {}, {{"seed", "1"}}, 38.2},
                                            {b.study, b.result, {}, {{"seed", "2"}}, 61.0}});
  expect_sound(page);
  EXPECT_EQ(after(page, "<p class=\"sentence\">", "<").front(),
            "1 of 2 fits cannot be trusted (bovine femur B), 1 with reservations.");
  EXPECT_TRUE(contains(page, "13.123\u00a0±\u00a00.087"));
  EXPECT_TRUE(contains(page, "14.200\u00a0±\u00a00.087"));
  EXPECT_TRUE(contains(page, "<td>bovine femur B</td><td class=\"n\">14.200"));  // wide as one fit
  EXPECT_EQ(test::after(page, "<th>E (GPa) <", ">").size(), 1U);
  EXPECT_TRUE(contains(page, "The fit cannot be trusted: 1 of 4 checks failed (search)."));
  EXPECT_TRUE(contains(page, "1\u00a0min 1\u00a0s"));
  EXPECT_TRUE(contains(page, "bovine femur B: seed"));
  expect_sound(comparison_page({}));
}

}  // namespace
}  // namespace havers::reports
