#include <gtest/gtest.h>

#include <limits>

#include "reports/pages.hpp"
#include "tests/reports/sound_page.hpp"
#include "tests/support/slow.hpp"

namespace havers::reports {
namespace {

using test::contains;
using test::expect_sound;

std::string page_of(const test::FitSample& fit) {
  return fit_page({fit.study, fit.result, {}, {}});
}

class FitPage : public testing::Test {
 protected:
  // One specimen: its figures are what takes the time of a page.
  FitPage() {
    sample.study.specimens.resize(1);
    sample.result.specimens.resize(1);
  }

  test::FitSample sample = test::fit_sample();
};

TEST_F(FitPage, GivesTheVerdictBeforeAnyNumber) {
  sample = test::fit_sample();
  const std::string page =
      fit_page({sample.study, sample.result, {}, {.havers = "0.1.0", .wall_seconds = 38.2}});
  expect_sound(page);
  const std::size_t verdict = page.find("The fit can be trusted, with 1 reservation.");
  ASSERT_NE(verdict, std::string::npos);
  EXPECT_LT(verdict, page.find("goodness of fit"));
  EXPECT_LT(page.find("goodness of fit"), page.find("13.123\u00a0±\u00a00.087"));
}

TEST_F(FitPage, TicksNoCheckThatWasNotDone) {
  HAVERS_SLOW;
  for (const bool done : {true, false}) {
    sample.result.verdict = {{"held-out specimens", calib::Outcome::pass, "none was kept", done}};
    const std::string page = page_of(sample);
    EXPECT_EQ(contains(page, "✓"), done);
    EXPECT_EQ(contains(page, "– not done"), !done);
  }
}

TEST_F(FitPage, ShowsEverySpecimenParameterCheckAndStage) {
  sample = test::fit_sample();
  const std::string page =
      fit_page({sample.study, sample.result, {{"A2", {test::tiny_png()}}}, {.wall_seconds = 38.2}});
  for (const auto& specimen : sample.result.specimens)
    EXPECT_TRUE(contains(page, "<h3>" + specimen.id + " "));
  for (const auto& parameter : sample.result.parameters)
    EXPECT_TRUE(contains(page, parameter.name));
  for (const auto& check : sample.result.verdict) EXPECT_TRUE(contains(page, check.text));
  for (const auto& stage : sample.result.stages) EXPECT_TRUE(contains(page, stage.optimiser));
  for (const char* wall : {"21.4\u00a0s", "6.25\u00a0s"}) EXPECT_TRUE(contains(page, wall)) << wall;
  EXPECT_TRUE(contains(page, sample.result.parameters.back().left_out_because));
  EXPECT_TRUE(contains(page, "38.2\u00a0s wall time"));
  EXPECT_TRUE(contains(page, "data:image/png;base64,iVBORw0KGgo"));
  EXPECT_TRUE(contains(page, "porosity 4.80\u00a0±\u00a00.21\u00a0%"));
}

// Two reasons side by side are wider than the page, unless their lines break.
TEST_F(FitPage, BreaksTheLinesOfReasonsInTheTableOfIntervals) {
  sample.result.fitted = {"young_GPa", "head_tail_MPa"};
  sample.result.correlation = {{1.0, 0.0}, {0.0, 1.0}};
  sample.result.parameters.front().bootstrap_95 = {test::nan, test::nan};
  sample.result.parameters.front().bootstrap_missing = "3 specimens are too few to draw from";
  const std::string page = page_of(sample);
  EXPECT_TRUE(contains(page, "<td class=\"n said\">– (3 specimens are too few"));
  EXPECT_TRUE(contains(page, "td.said { white-space: normal; }"));
}

// Beside "2 specimens are too few to draw from" it would speak of a fit of six.
TEST_F(FitPage, SaysWhatABootstrapIsWorthWhereThereIsOne) {
  HAVERS_SLOW;
  sample.result.fitted = {"young_GPa"};
  const std::string worth = "over six they hold the truth in 78 to 91&nbsp;%";
  EXPECT_TRUE(contains(page_of(sample), worth));
  for (auto& parameter : sample.result.parameters)
    parameter.bootstrap_missing = "2 specimens are too few to draw from, 5 are the least";
  EXPECT_FALSE(contains(page_of(sample), worth));
}

// What a search asks for again is in memory; the store knows what earlier runs left.
TEST_F(FitPage, TellsRepeatsFromTheStore) {
  sample.result.evaluations = 14898;
  sample.result.distinct_simulations = 2540;
  sample.result.simulated = 2538;
  EXPECT_TRUE(
      contains(page_of(sample), "2538 run, 2 taken from the store, 12358 asked for again; "));
}

TEST_F(FitPage, ShowsNoCorrelationAsZero) {
  sample.result.fitted = {"young_GPa", "head_tail_MPa"};
  sample.result.correlation = {{1.0, -9e-32}, {-9e-32, 1.0}};
  const std::string page = page_of(sample);
  EXPECT_TRUE(contains(page, "Correlation"));
  EXPECT_FALSE(contains(page, "10⁻³²"));
}

// A key stands once, beside its symbol; everywhere else parameters have the names of the figures.
TEST_F(FitPage, WritesSymbolsInTablesAndFormulas) {
  auto& result = sample.result;
  result.fitted = {"young_GPa", "head_tail_MPa"};
  result.correlation = {{1.0, 0.5}, {0.5, 1.0}};
  result.directions = {"head_tail_MPa × young_GPa^-0.23 is known to ± 1.9 %."};
  result.next_tests = {{"one more specimen at 45 deg", {0.9, 0.8}}};
  result.parameters.back().left_out_because = "only head_tail_MPa × ratio^0.5 is determined";
  const std::string page = page_of(sample);
  for (const char* shown : {"σ₁ × E⁻⁰·²³ is known", "at 45°<", "<th>E (GPa)</th>", "<th>E</th>",
                            "<th class=\"n\">σ₁</th>", "only σ₁ × r⁰·⁵ is determined"})
    EXPECT_TRUE(contains(page, shown)) << shown;
  EXPECT_EQ(page.find("young_GPa"), page.rfind("young_GPa"));
}

TEST_F(FitPage, LeavesOutTheNumbersOfAnOptimisersMessage) {
  sample.result.stages.front().message = "Tolerance reached. |cost_change|/cost: 1.1e-05 <= 5e-05";
  const std::string page = page_of(sample);
  EXPECT_TRUE(contains(page, "<td>Tolerance reached</td>"));
}

TEST_F(FitPage, NamesTheChecksThatFailed) {
  sample.result.verdict[1].outcome = calib::Outcome::fail;
  const std::string page = page_of(sample);
  EXPECT_TRUE(contains(page, "The fit cannot be trusted: 1 of 4 checks failed (goodness of fit)."));
  EXPECT_FALSE(contains(page, "class=\"verdict good\""));
}

TEST_F(FitPage, SaysWhyAFitWithoutFailedChecksCannotBeTrusted) {
  sample.result.status = calib::CalibrationStatus::cancelled;
  EXPECT_TRUE(
      contains(page_of(sample), "The fit cannot be trusted: " + explain(sample.result.status)));
}

// Its check "converged" fails too, and says less.
TEST_F(FitPage, SaysHowASearchEndedThatDidNotConverge) {
  sample.result.status = calib::CalibrationStatus::budget_spent;
  sample.result.verdict[0].outcome = calib::Outcome::fail;
  EXPECT_TRUE(
      contains(page_of(sample), "The fit cannot be trusted: " + explain(sample.result.status)));
}

TEST_F(FitPage, NamesNoCostWhereThereIsNoAnswer) {
  HAVERS_SLOW;
  EXPECT_TRUE(contains(page_of(sample), "Cost ½ Σ residual² = "));
  sample.result.cost = std::numeric_limits<double>::infinity();
  const std::string page = page_of(sample);
  EXPECT_FALSE(contains(page, "Cost ½ Σ residual²"));
  EXPECT_TRUE(contains(page, "No answer after "));
}

TEST_F(FitPage, EscapesWhatUsersWrote) {
  sample.study.name = "<script>alert(1)</script> & \"co\"";
  sample.result.specimens.front().id = "<b>A1</b>";
  sample.result.specimens.front().measured.warnings = {"1 < 2 & 3"};
  const std::string page = fit_page({sample.study, sample.result, {}, {.command = "a <b> 'c'"}});
  expect_sound(page);
  EXPECT_FALSE(contains(page, "<b>A1"));
  EXPECT_TRUE(contains(page, "&lt;script&gt;"));
}

TEST_F(FitPage, TellsWhatIsNotOfBoneRightUnderTheVerdict) {
  sample.result.specimens.front().measured.unit_doubt =
      "a strength of 77542 MPa is not that of compact bone (1 to 1000 MPa): check the units";
  const std::string page = page_of(sample);
  EXPECT_LT(page.find("A1: a strength of 77542\u00a0MPa"), page.find("goodness of fit"));
}

TEST_F(FitPage, TellsTheDoubtsAboutStudyTestsAndSections) {
  sample.result.notes = {"specimen A1 has no orientation_deg"};
  sample.result.specimens.front().measured.warnings = {"no break was seen"};
  calib::Specimen& declared = sample.study.specimens.front();
  ASSERT_EQ(declared.id, sample.result.specimens.front().id);
  declared.sections.resize(1);
  declared.sections.front().file = "in/A1_s1.png";
  declared.sections.front().warnings = {"the outline touches the edge"};
  const std::string page = page_of(sample);
  expect_sound(page);
  const std::size_t specimen = page.find("<h3>A1 ");
  EXPECT_LT(page.find("<li>specimen A1 has no orientation_deg</li>"), specimen);
  for (const char* doubt :
       {"<li>no break was seen</li>", "<li>A1_s1.png: the outline touches the edge</li>"}) {
    EXPECT_TRUE(contains(page, doubt)) << doubt;
    EXPECT_GT(page.find(doubt), specimen);
  }
}

// An interval holds wherever the parameter that was left out may be, the curve at its value alone.
TEST_F(FitPage, SaysWhyAnIntervalReachesBeyondItsProfile) {
  HAVERS_SLOW;
  sample.result.fitted = {"young_GPa"};
  sample.result.profiles = {{"young_GPa", {12.9, 13.1, 13.3}, {2.0, 0.0, 2.0}, 1.9, {12.0, 14.0}}};
  const std::string said = "The curves hold r = 1.5";
  sample.result.parameters.back() = {.name = "ratio", .unit = "", .value = 1.5};
  const std::string fitted = page_of(sample);
  EXPECT_FALSE(contains(fitted, said));
  EXPECT_TRUE(contains(fitted, "drawn straight and taken for a parabola between its points"));
  sample.result.parameters.back().left_out_because = "nothing changes with it";
  EXPECT_TRUE(contains(page_of(sample), said));
  sample.result.directions = {
      "young_GPa is known to ± 5.5 % (one standard error, at ratio = 1.5)."};
  const std::string page = page_of(sample);
  EXPECT_TRUE(contains(page, "Standard errors are those at r = 1.5; the 95&nbsp;% intervals let"));
  EXPECT_TRUE(contains(page, "E is known to ±\u00a05.5\u00a0% (one standard error, at r = 1.5)."));
  sample.study.calibrate.automatic = true;
  EXPECT_FALSE(contains(page_of(sample), said));
}

TEST_F(FitPage, LeavesAnIntervalOpenWhereItsProfileHasNoEnd) {
  sample.result.fitted = {"young_GPa"};
  sample.result.parameters.front().profile_95 = {test::nan, 14.2};
  sample.result.parameters.front().profile_missing = "the cost does not rise enough";
  EXPECT_TRUE(contains(page_of(sample), "at most 14.20 (the cost does not rise enough)"));
}

TEST_F(FitPage, SpeaksOfAFlatStretchOnlyWhereThereIsOne) {
  HAVERS_SLOW;
  sample.result.starts = {8.0, 8.1, 20.0};
  EXPECT_TRUE(contains(page_of(sample), "The flat stretch"));
  sample.result.starts = {8.0, 12.0, 20.0};
  EXPECT_FALSE(contains(page_of(sample), "The flat stretch"));
}

// Both would be called failure strain, and their residuals have opposite signs.
TEST_F(FitPage, NamesTheTermThatStandsForTheFailureStrainByWhatItIs) {
  sample.result.specimens.front().terms = {{.term = "strength"}, {.term = "failure strain"}};
  const std::string page = page_of(sample);
  EXPECT_TRUE(contains(page, "<th>ln (strength &#x2F; (modulus × failure strain))</th>"));
  EXPECT_TRUE(contains(page, "<th>ln strength (Pa)</th>"));
}

TEST_F(FitPage, SpeaksOfBoundsOnlyWhereATestWasStopped) {
  HAVERS_SLOW;
  sample.result.specimens.front().terms = {{.term = "strength"}};
  EXPECT_FALSE(contains(page_of(sample), "is but a bound"));
  sample.result.specimens.front().terms.front().bound = true;
  EXPECT_TRUE(contains(page_of(sample), "is but a bound"));
}

TEST(Provenance, KeepsDigestsFolded) {
  const auto sample = test::fit_sample();
  const std::string page =
      fit_page({sample.study, sample.result, {}, {.command = "havers", .inputs = {{"a", "12"}}}});
  expect_sound(page);
  EXPECT_LT(page.find("<summary>SHA-256 of 1 input file"), page.find("<td class=\"hash\">12"));
}

TEST_F(FitPage, SurvivesAResultOfNothing) {
  expect_sound(fit_page({calib::Study{}, calib::CalibrationResult{}, {}, {}}));
}

TEST_F(FitPage, SurvivesNumbersThatAreNone) {
  auto& specimen = sample.result.specimens.front();
  specimen.modulus = specimen.strength = specimen.failure_strain = {test::nan, test::nan};
  specimen.residual = {test::nan, test::nan, test::nan};
  specimen.porosity = test::nan;
  specimen.measured = {};
  std::fill(specimen.band.residual.begin(), specimen.band.residual.end(), test::nan);
  std::fill(specimen.band.median.begin(), specimen.band.median.end(), test::nan);
  sample.result.parameters.front().value = test::nan;
  expect_sound(page_of(sample));
}

}  // namespace
}  // namespace havers::reports
