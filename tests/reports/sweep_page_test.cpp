#include "reports/sweep/sweep_page.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "reports/sweep/sweep_figure.hpp"
#include "reports/sweep/sweep_words.hpp"
#include "tests/reports/sound_page.hpp"
#include "tests/support/sweeps.hpp"

namespace havers::reports {
namespace {

using test::deviation;
using test::KnownSweep;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Strength falls with the scatter, at two ratios.
struct Case {
  calib::Sweep sweep;
  calib::SweepResult result;

  Case() {
    const KnownSweep known({{"joints.ratio", {"1", "3"}}, {"joints.scatter", {"0.2", "0.8"}}}, 20,
                           [](const calib::SweepPoint& p, int k) {
                             return 1e6 * (50.0 - 10.0 * p.numbers[1] + deviation(k));
                           });
    sweep.name = "A <sweep>";
    sweep.plan = known.plan;
    sweep.points = known.points;
    sweep.laws = {{calib::Measure::strength, {"joints.scatter"}, "joints.ratio"}};
    sweep.findings.emplace_back();
    sweep.findings.front().id = "F7";
    sweep.findings.front().test = calib::FindingTest::falls;
    sweep.findings.front().keys = {"joints.scatter"};
    result.points = known.points;
    result.runs = known.runs;
    for (std::size_t i = 0; i < known.points.size(); ++i) {
      result.summaries.push_back(calib::summary_of(known.runs, i));
      result.strengths.emplace_back();
    }
    result.laws = fit_laws(sweep.laws.front(), known.plan, known.points, known.runs);
    result.findings = judge(sweep.findings.front(), known.plan, known.points, known.runs);
  }

  [[nodiscard]] std::string page() const { return sweep_page("Title", {{"a", sweep, result}}, {}); }

  // Of the first panel.
  [[nodiscard]] std::string commands(const calib::SweepFigure& wanted) const {
    return sweep_figures(sweep, result, wanted, "f").front().figure.commands;
  }
};

TEST(SweepPage, SaysTheOutcomeFirstAndEscapesWhatUsersWrote) {
  const Case known;
  const std::string page = known.page();
  EXPECT_THAT(page, HasSubstr("Of 1 finding: 1 agrees (F7)."));
  EXPECT_THAT(page, HasSubstr("80 runs, 0 failed"));
  EXPECT_THAT(page, HasSubstr("A &lt;sweep&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<sweep>")));
}

TEST(SweepPage, IsGreenOnlyWhereEveryFindingAgrees) {
  Case known;
  EXPECT_THAT(known.page(), HasSubstr("verdict good"));
  known.result.findings.back().outcome = calib::FindingOutcome::undecided;
  EXPECT_THAT(known.page(),
              AllOf(HasSubstr("verdict mixed"), HasSubstr("Of 1 finding: 1 is undecided (F7)")));
}

TEST(SweepPage, SaysThatAFindingDiffersByRow) {
  Case known;
  known.result.findings.push_back(known.result.findings.front());
  known.result.findings.back().outcome = calib::FindingOutcome::undecided;
  EXPECT_THAT(known.page(), HasSubstr("Of 1 finding in 2 rows: 1 differs by row (F7)."));
}

TEST(SweepPage, IsRedWhereRunsDidNotBreakAndTellsWhich) {
  Case known;
  known.result.summaries.back().unbroken = 5;
  EXPECT_THAT(known.page(),
              AllOf(HasSubstr("verdict bad"), HasSubstr("80 runs, 0 failed, 5 did not break"),
                    HasSubstr("Did not break</th>"), HasSubstr("the modulus alone is drawn")));
  known.result.summaries.back().unbroken = 4;
  EXPECT_THAT(known.page(), HasSubstr("verdict good"));
}

TEST(SweepPage, SaysHowManyRunsFailedAndWhy) {
  Case known;
  known.result.summaries.back().failed = 3;
  known.result.most_failed_because = "nothing holds the specimen together";
  EXPECT_THAT(known.page(),
              AllOf(HasSubstr("80 runs, 3 failed"), HasSubstr("<th class=\"n\">Failed</th>"),
                    HasSubstr("most often so: nothing holds the specimen together.")));
}

TEST(SweepPage, HasADashAloneWhereNothingCouldBeCompared) {
  Case known;
  calib::Finding& finding = known.result.findings.front();
  finding.value = finding.low = finding.high = std::numeric_limits<double>::quiet_NaN();
  finding.compared.clear();
  known.result.laws.front().lack_of_fit = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(known.page(),
              AllOf(HasSubstr("Strength, difference: –<br><span class=\"note\">asked: "),
                    HasSubstr("<td class=\"n\">–</td><td class=\"n\">40</td>")));
}

TEST(SweepPage, HasADigitMoreWhereRoundingWouldHideWhyAFindingDoesNotAgree) {
  Case known;
  calib::Finding& finding = known.result.findings.front();
  finding.test = calib::FindingTest::linear;
  finding.value = 0.0131;
  finding.low = -0.0241;
  finding.high = 0.0502;
  finding.asked_low = -0.05;
  finding.asked_high = 0.05;
  EXPECT_THAT(known.page(), HasSubstr("1.31\u00a0% (−2.41 to 5.02)"));
}

TEST(SweepPage, GivesEveryLawWithItsIntervals) {
  const Case known;
  const std::string page = known.page();
  EXPECT_THAT(page, HasSubstr("scatter d: −10.0 ("));
  EXPECT_THAT(page, HasSubstr("ratio r\u00a0=\u00a03"));
}

TEST(SweepPage, SaysBesideTheIntervalsThatALawDoesNotFit) {
  Case known;
  EXPECT_THAT(known.page(), Not(HasSubstr("The law does not fit")));
  known.result.laws.front().lack_of_fit_p = 0.001;
  EXPECT_THAT(known.page(), HasSubstr("). The law does not fit: "));
}

TEST(SweepPage, TypesetsClaimsAndChancesThatAreNextToNothing) {
  Case known;
  known.result.findings.front().claim = "and grows with d (1.8e-6 d)";
  known.result.laws.front().lack_of_fit = 709.0;
  known.result.laws.front().lack_of_fit_p = 0.0;
  const std::string page = known.page();
  EXPECT_THAT(page, HasSubstr("1.8\u00a0×\u00a010⁻⁶ d"));
  EXPECT_THAT(page, HasSubstr("709 (p &lt; 10⁻⁶)"));
}

TEST(SweepPage, HasADashForTheInertiaNumberOfTheQuasiStaticLimit) {
  Case known;
  const double none = std::numeric_limits<double>::quiet_NaN();
  known.result.findings.front().inertia_low = known.result.findings.front().inertia_high = none;
  EXPECT_THAT(known.page(), HasSubstr("I = –<"));
}

TEST(SweepWords, PutTheUnitBehindTheValue) {
  EXPECT_EQ(place("assembly.orientation_deg", "45"), "θ\u00a0=\u00a045°");
  EXPECT_EQ(place("joints.ratio", "3"), "ratio r\u00a0=\u00a03");
  EXPECT_EQ(place("joints.distribution", "weibull"), "distribution\u00a0=\u00a0weibull");
  EXPECT_EQ(place("material.young_GPa", "13"), "modulus E\u00a0=\u00a013\u00a0GPa");
}

TEST(SweepWords, NameKeysWithTheirUnitsAndWithoutUnderlines) {
  EXPECT_EQ(name_of_key("assembly.orientation_deg"), "angle θ (°)");
  EXPECT_EQ(name_of_key("material.layer_contrast"), "layer contrast");
  EXPECT_EQ(name_of_key("joints.head_tail_shear_MPa"), "head tail shear (MPa)");
  EXPECT_EQ(name_of_key("solver.step_s"), "step (s)");
}

TEST(SweepPage, HasTheUnitBehindBothValuesThatAreCompared) {
  Case known;
  known.result.findings.front().compared = {{"assembly.orientation_deg", "45", "0"},
                                            {"joints.ratio", "3", ""}};
  EXPECT_THAT(known.page(), HasSubstr("θ\u00a0=\u00a045° against 0°, ratio r\u00a0=\u00a03"));
}

TEST(SweepFigures, DrawTheCurveOfTheFirstSeedThatHasNotFailed) {
  Case known;
  const calib::SweepFigure wanted{.caption = "c"};
  calib::SweepRun failed, good;
  good.failed = false;
  good.strain = {0.0, 0.01};
  good.stress = {0.0, 50e6};
  known.result.runs = {failed};
  EXPECT_EQ(known.commands(wanted), "");
  known.result.runs.push_back(good);
  EXPECT_THAT(known.commands(wanted), HasSubstr("0.01 5e+07"));
}

TEST(SweepFigures, HaveAPanelForEveryValueOfPer) {
  const Case known;
  const calib::SweepFigure wanted{.caption = "c", .x = "joints.scatter", .per = "joints.ratio"};
  const auto panels = sweep_figures(known.sweep, known.result, wanted, "f");
  ASSERT_EQ(panels.size(), 2U);
  EXPECT_EQ(panels[1].at, "ratio r\u00a0=\u00a03");
  EXPECT_THAT(panels[0].figure.commands, HasSubstr("Strength (MPa)"));
}

TEST(SweepFigures, DrawASeriesAlikeInAllPanels) {
  Case known;
  const calib::SweepFigure wanted{
      .caption = "c", .x = "joints.scatter", .series = "joints.scatter", .per = "joints.ratio"};
  known.result.summaries.front() = {};  // the first series has no value in the first panel
  const auto panels = sweep_figures(known.sweep, known.result, wanted, "f");
  for (const SweepPanel& panel : panels)
    EXPECT_THAT(panel.figure.commands, HasSubstr("dt 2 pt 7 ps 0.7 lc rgb red title '0.8'"));
  EXPECT_THAT(panels[0].figure.commands, Not(HasSubstr("lc rgb blue")));
}

TEST(SweepFigures, WriteSmallNumbersAsPowersOfTen) {
  Case known;
  const calib::SweepFigure wanted{.caption = "c", .x = "joints.scatter"};
  EXPECT_THAT(known.commands(wanted), Not(HasSubstr("'%h'")));
  for (calib::SweepPoint& point : known.result.points) point.numbers[1] *= 1e-7;
  EXPECT_THAT(known.commands(wanted),
              AllOf(HasSubstr("set format x '%h'\nset xtics 1e-08\n"), HasSubstr("unset lmargin")));
}

TEST(SweepFigures, TellCurvesApartWithoutColour) {
  Case known;
  for (calib::SweepRun& run : known.result.runs) run.strain = run.stress = {0.0, 1.0};
  const calib::SweepFigure wanted{.caption = "c", .series = "joints.scatter"};
  const std::string commands = known.commands(wanted);
  EXPECT_THAT(commands, AllOf(HasSubstr("dt 1 lc rgb blue"), HasSubstr("dt 2 lc rgb red")));
}

TEST(SweepFigures, JoinPointsThatLieOnACurveAlone) {
  const Case known;
  const auto commands = [&](const std::string& series) {
    const calib::SweepFigure wanted{.caption = "c", .x = "joints.scatter", .series = series};
    return known.commands(wanted);
  };
  EXPECT_THAT(commands("joints.ratio"), HasSubstr("with linespoints"));
  EXPECT_THAT(commands(""), AllOf(Not(HasSubstr("with linespoints")), Not(HasSubstr("filled"))));
}

TEST(SweepFigures, ShowBothOfTwoSeriesThatCoincide) {
  const Case known;
  const calib::SweepFigure wanted{.caption = "c", .x = "joints.scatter", .series = "joints.ratio"};
  EXPECT_THAT(known.commands(wanted), AllOf(HasSubstr("dt 1 pt 4 ps 1.1 lc rgb blue"),
                                            HasSubstr("dt 2 pt 7 ps 0.7 lc rgb red")));
}

TEST(SweepFigures, GiveTheMeanOfASingleRunNoBand) {
  Case known;
  const calib::SweepFigure wanted{.caption = "c", .x = "joints.scatter", .series = "joints.ratio"};
  EXPECT_THAT(known.commands(wanted), Not(HasSubstr("NaN NaN")));
  known.result.summaries.front().measures.at(static_cast<std::size_t>(wanted.response)).n = 1;
  EXPECT_THAT(known.commands(wanted), HasSubstr("NaN NaN"));
}

TEST(SweepFigures, SayWhatBarsAndBandsAre) {
  Case known;
  known.sweep.figures = {{.caption = "As in fig. 12.", .x = "joints.ratio"}};
  EXPECT_THAT(known.page(),
              HasSubstr("As in fig. 12. Bars and bands: 95\u00a0% intervals of the means; "
                        "that of a single run has none."));
  known.sweep.figures.front().x = "";
  EXPECT_THAT(known.page(), Not(HasSubstr("Bars and bands")));
}

TEST(SweepFigures, SayThatACurveEndsEarlyWhereItDoes) {
  for (const auto regime : {sim::Regime::dynamic, sim::Regime::quasi_static}) {
    Case known;
    known.sweep.figures.emplace_back();
    for (auto& point : known.sweep.points) point.scene.solver.regime = regime;
    const bool early = known.page().find("In the limit it ends where") != std::string::npos;
    EXPECT_EQ(early, regime == sim::Regime::quasi_static);
  }
}

TEST(SweepFigures, WriteTheirSeriesAsTheTextDoes) {
  Case known;
  for (calib::SweepPoint& point : known.result.points) point.values[1] = "1e-07";
  known.sweep.figures = {{.caption = "c", .x = "joints.ratio", .series = "joints.scatter"}};
  const std::string page = known.page();
  EXPECT_THAT(page, AllOf(HasSubstr("10⁻⁷"), Not(HasSubstr("1e-07"))));
}

TEST(Avalanche, IsASentenceWhereNothingBroke) {
  EXPECT_THAT(avalanche_svg({}, {}), HasSubstr("no joint broke"));
}

TEST(Avalanche, ShowsEveryBrokenJointInItsTurn) {
  const sim::Assembly assembly =
      sim::build_assembly({.layers = 4, .fibres = 3}, sim::Lateral::free);
  sim::Simulation run;
  run.joints.resize(assembly.joints.size());
  for (std::size_t i = 0; i < 3; ++i) {
    run.joints[i].threshold = {1.0, 1.0};
    run.joints[i].broken = true;
    run.joints[i].broken_at_strain = 0.003 + 0.001 * static_cast<double>(i);
  }
  run.joints[3].broken = true;  // missing from the start
  const std::string svg = avalanche_svg(assembly, run);
  EXPECT_THAT(svg, HasSubstr("3 broken joints"));
  EXPECT_THAT(svg, HasSubstr("at 0.3000\u00a0%, to the last, at 0.5000\u00a0%"));
  EXPECT_EQ(test::after(svg, "<animate", " ").size(), 3U);
}

}  // namespace
}  // namespace havers::reports
