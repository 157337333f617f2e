// The page of a bench of one scene: error against run time.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "reports/bench_pages.hpp"
#include "tests/reports/sound_page.hpp"

namespace havers::reports {
namespace {

using test::contains;
using test::expect_sound;

sim::WorkPrecision work_precision_sample() {
  const auto row = [](sim::BenchSetting setting, double error, int trusted) {
    sim::BenchRow made{.setting = setting, .runs = 1, .trusted = trusted};
    made.wall = made.cpu = {0.2, 0.1, 0.3};
    made.errors = {.bonded_forces = {error, error, error, 1},
                   .strength_without_ringing = {7.0 * error, error, error, 1},
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

class WorkPrecisionPage : public testing::Test {
 protected:
  [[nodiscard]] std::string page() const { return work_precision_page({}, study, {}); }

  sim::WorkPrecision study = work_precision_sample();
};

TEST_F(WorkPrecisionPage, WritesNumbersAsAReaderDoes) {
  const std::string shown = page();
  expect_sound(shown);
  EXPECT_TRUE(contains(shown, "Gauss-Seidel 10⁻⁸, h = 20\u00a0ns, 8 triangles a fibre"));
  EXPECT_TRUE(contains(shown, "h = 10\u00a0ps"));
  EXPECT_TRUE(
      contains(shown, "3.0\u00a0×\u00a010⁻⁶ (1.5\u00a0×\u00a010⁻⁶ to 6.0\u00a0×\u00a010⁻⁶)"));
  EXPECT_TRUE(contains(shown, ">2.1\u00a0×\u00a010⁻⁵<")) << "without ringing";
  EXPECT_TRUE(contains(shown, ">1234567<"));
  EXPECT_TRUE(
      contains(shown, "differs by 1.3\u00a0×\u00a010⁻¹³ at most and takes 1.7 times the CPU time"));
  EXPECT_TRUE(contains(shown, "1 of 1 not to be trusted"));
  EXPECT_FALSE(contains(shown, "e-0"));
}

TEST_F(WorkPrecisionPage, ShowsFailureStrainsWhereNoForcesOfTheIntactSpecimenAre) {
  for (sim::BenchRow& row : study.rows)
    row.errors.bonded_forces.median = std::numeric_limits<double>::quiet_NaN();
  const std::string shown = page();
  EXPECT_TRUE(contains(shown, "Relative error of failure strain"));
  EXPECT_FALSE(contains(shown, "Relative error of joint forces"));
}

TEST_F(WorkPrecisionPage, SaysWhatForcesBeforeTheFirstBreakAreComparedWith) {
  const std::string_view words = "before the first break are relative to their closed form";
  EXPECT_FALSE(contains(page(), words));
  study.closed_form = true;
  EXPECT_TRUE(contains(page(), words));
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

TEST_F(WorkPrecisionPage, IsNotGreenWithoutAReference) {
  EXPECT_TRUE(contains(page(), "verdict good"));
  study.rows.front().trusted = 0;
  EXPECT_TRUE(contains(page(), "verdict bad"));
}

TEST_F(WorkPrecisionPage, IsNotGreenWhereNothingComesNearTheReference) {
  study.cheapest.front().row = {};
  study.rows[1].errors.failure_strain = {0.0005, 0.0001, 0.0042, 1};
  const std::string shown = page();
  EXPECT_TRUE(contains(shown, "verdict mixed"));
  EXPECT_TRUE(contains(
      shown,
      "0.1\u00a0% for every seed; the nearest comes to 0.42\u00a0%: active set, h = 20\u00a0ns, "));
}

TEST_F(WorkPrecisionPage, NamesNoSettingForWhatTheReferenceIsNotKnownTo) {
  study.cheapest.front() = {.target = 1e-3, .reference_error = 0.0096};
  EXPECT_TRUE(contains(page(), "cannot be told: the reference may err by 0.0096"));
}

TEST_F(WorkPrecisionPage, SaysHowFarRunsCameThatWereStopped) {
  study.time_limit = 20.0;
  sim::BenchRow& stopped = study.rows.back();
  stopped.out_of_time = 1;
  stopped.reached = {0.004, 0.0021, 0.004};  // of all seeds
  stopped.stopped_at = {0.0021, 0.0021, 0.0021};
  EXPECT_TRUE(contains(page(), "1 of 1 stopped after 20.0\u00a0s, at a strain of 0.210\u00a0%"));
}

TEST_F(WorkPrecisionPage, ShowsNoEmptyTableOfABenchStoppedAtOnce) {
  study = {};
  EXPECT_TRUE(contains(page(), "Stopped before every setting was run."));
  EXPECT_FALSE(contains(page(), "<table"));
  EXPECT_FALSE(contains(page(), "<figcaption>"));
  EXPECT_FALSE(contains(page(), "Errors are relative"));
}

TEST_F(WorkPrecisionPage, SaysWhatTheReferencesStrengthMayErrByToo) {
  study = {.complete = true, .rows = {{.runs = 3, .trusted = 3}}};
  EXPECT_FALSE(contains(page(), "own strength may err"));
  study.reference_errors.strength.high = 0.014;
  study.reference_errors.strength_without_ringing.high = 0.0026;
  study.reference_errors.failure_strain.high = 0.0025;
  EXPECT_TRUE(contains(page(),
                       "own strength may err by 1.4\u00a0%, that without ringing by 0.26\u00a0%, "
                       "its failure strain by "
                       "0.25\u00a0%, the largest of all seeds."));
}

}  // namespace
}  // namespace havers::reports
