#include "calib/sweep/finding.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>

#include "tests/support/sweeps.hpp"

namespace havers::calib {
namespace {

using test::deviation;
using test::KnownSweep;

Finding judged(const FindingRequest& request, const KnownSweep& known) {
  return judge(request, known.plan, known.points, known.runs).front();
}

// Strengths of mean 100 + slope x with the standard deviation sd.
Finding found(FindingTest test, double slope, double sd, double margin = 0.05) {
  const KnownSweep known({{"x", {"0", "1", "2"}}}, 20, [&](const SweepPoint& p, int k) {
    return 100.0 + slope * p.numbers[0] + sd * deviation(k);
  });
  const FindingRequest request{.id = "R",
                               .test = test,
                               .keys = {"x"},
                               .margin = margin,
                               .if_agrees = "so it is",
                               .if_undecided = "who knows"};
  const auto findings = judge(request, known.plan, known.points, known.runs);
  EXPECT_EQ(findings.size(), 1U);
  return findings.front();
}

TEST(Finding, SameAgreesWithinTheMarginAndMattersBeyond) {
  using enum FindingOutcome;
  const auto judged_both = [](double slope, double sd) {
    return std::pair(found(FindingTest::same, slope, sd).outcome,
                     found(FindingTest::matters, slope, sd).outcome);
  };
  EXPECT_EQ(judged_both(1.0, 1.0), std::pair(agrees, disagrees));
  EXPECT_EQ(judged_both(5.0, 1.0), std::pair(disagrees, agrees));
  EXPECT_EQ(judged_both(2.5, 5.0), std::pair(undecided, undecided));
}

TEST(Finding, ShowsTheComparisonThatSpeaksMostAgainstTheClaim) {
  const Finding finding = found(FindingTest::same, 5.0, 1.0);
  EXPECT_EQ(to_string(finding.compared), "x = 2 against 0");
  EXPECT_NEAR(finding.value, 0.10, 1e-3);
  EXPECT_LT(finding.low, finding.value);
  EXPECT_GT(finding.high, finding.value);
  EXPECT_EQ(finding.comparisons, 3);
  EXPECT_EQ(finding.runs, 60);
}

// The first point lies farther off, the second is less well known.
TEST(Finding, ShowsTheComparisonThatLeavesItUndecided) {
  const KnownSweep known({{"x", {"0", "1"}}}, 20, [](const SweepPoint& p, int k) {
    return p.numbers[0] < 0.5 ? 103.0 + 0.1 * deviation(k) : 100.0 + 10.0 * deviation(k);
  });
  const Finding finding = judged({.test = FindingTest::below, .margin = 104.0}, known);
  EXPECT_EQ(finding.outcome, FindingOutcome::undecided);
  EXPECT_EQ(to_string(finding.compared), "x = 1");
  EXPECT_GT(finding.high, finding.asked_high);
}

TEST(Finding, ShowsTheComparisonThatContradictsTheClaim) {
  const KnownSweep known({{"x", {"0", "1"}}}, 20, [](const SweepPoint& p, int k) {
    return p.numbers[0] < 0.5 ? 106.0 + 0.1 * deviation(k) : 106.5 + 10.0 * deviation(k);
  });
  const Finding finding = judged({.test = FindingTest::below, .margin = 104.0}, known);
  EXPECT_EQ(finding.outcome, FindingOutcome::disagrees);
  EXPECT_EQ(to_string(finding.compared), "x = 0");
}

TEST(Finding, HasADigitMoreWhereRoundingWouldHideWhyItDoesNotAgree) {
  Finding finding;
  finding.low = -0.0241;
  finding.asked_low = -0.05;
  finding.asked_high = 0.05;
  finding.high = 0.0502;
  EXPECT_EQ(extra_digits(finding, 0.01), 1);
  finding.high = 0.0499;
  EXPECT_EQ(extra_digits(finding, 0.01), 0);
  finding.high = 0.0531;
  EXPECT_EQ(extra_digits(finding, 0.01), 0);
  finding.low = std::nan("");
  EXPECT_EQ(extra_digits(finding, 0.01), 0);
}

TEST(Finding, RisesAndFallsTellTheSign) {
  EXPECT_EQ(found(FindingTest::rises, 3.0, 1.0).outcome, FindingOutcome::agrees);
  EXPECT_EQ(found(FindingTest::falls, 3.0, 1.0).outcome, FindingOutcome::disagrees);
  EXPECT_EQ(found(FindingTest::falls, -3.0, 1.0).outcome, FindingOutcome::agrees);
  EXPECT_EQ(found(FindingTest::rises, 0.0, 1.0).outcome, FindingOutcome::undecided);
}

TEST(Finding, TakesNoDifferenceForOne) {
  for (const double slope : {0.0, 1e-10, -1e-10}) {
    EXPECT_EQ(found(FindingTest::rises, slope, 0.0).outcome, FindingOutcome::disagrees) << slope;
    EXPECT_EQ(found(FindingTest::falls, slope, 0.0).outcome, FindingOutcome::disagrees) << slope;
  }
}

// Judged over x = 0, 1, 2 by strengths of these means.
Finding rising(std::vector<double> means, double sd) {
  const KnownSweep known({{"x", {"0", "1", "2"}}}, 20, [&](const SweepPoint& p, int k) {
    return means.at(static_cast<std::size_t>(p.numbers[0])) + sd * deviation(k);
  });
  return judged({.test = FindingTest::rises, .keys = {"x"}}, known);
}

TEST(Finding, IsUndecidedWhereTheEndsRiseAndAStepBetweenNeighboursFalls) {
  const Finding finding = rising({100.0, 135.0, 104.0}, 1.0);
  EXPECT_EQ(finding.outcome, FindingOutcome::undecided);
  EXPECT_EQ(to_string(finding.compared), "x = 2 against 1");
  EXPECT_LT(finding.high, 0.0);
  EXPECT_THAT(finding.ground, testing::EndsWith("this step goes the other way"));
  EXPECT_EQ(finding.comparisons, 3);
}

TEST(Finding, AgreesWhereAStepFallsByNoMoreThanChance) {
  const Finding finding = rising({100.0, 110.2, 110.0}, 1.0);
  EXPECT_EQ(finding.outcome, FindingOutcome::agrees);
  EXPECT_EQ(to_string(finding.compared), "x = 2 against 0");
  EXPECT_GT(finding.low, 0.0);
  EXPECT_EQ(rising({100.0, 100.0, 110.0}, 0.0).outcome, FindingOutcome::agrees);
}

TEST(Finding, DisagreesWhereTheEndsFallWhateverTheStepsDo) {
  const Finding finding = rising({100.0, 135.0, 96.0}, 1.0);
  EXPECT_EQ(finding.outcome, FindingOutcome::disagrees);
}

TEST(Finding, SteadyIsAboutTheCoefficientOfVariation) {
  EXPECT_EQ(found(FindingTest::steady, 0.0, 1.0).outcome, FindingOutcome::agrees);
  EXPECT_EQ(found(FindingTest::steady, 0.0, 15.0).outcome, FindingOutcome::disagrees);
  EXPECT_EQ(found(FindingTest::steady, 0.0, 5.0).outcome, FindingOutcome::undecided);
}

TEST(Finding, AboveAndBelowCompareTheMeanWithTheMargin) {
  EXPECT_EQ(found(FindingTest::above, 0.0, 1.0, 90.0).outcome, FindingOutcome::agrees);
  EXPECT_EQ(found(FindingTest::below, 0.0, 1.0, 90.0).outcome, FindingOutcome::disagrees);
  EXPECT_EQ(found(FindingTest::below, 0.0, 1.0, 100.1).outcome, FindingOutcome::undecided);
}

TEST(Finding, TakesRoundingForNoInterval) {
  const KnownSweep known({{"x", {"0"}}}, 20,
                         [](const SweepPoint&, int k) { return 13.0 + 1e-14 * deviation(k); });
  const Finding finding = judged({.test = FindingTest::above, .margin = 1.0}, known);
  EXPECT_EQ(finding.low, finding.value);
  EXPECT_EQ(finding.high, finding.value);
}

TEST(Finding, OfAShareShowsNoIntervalBeyondWhatAShareCanBe) {
  const KnownSweep known({{"x", {"0", "1"}}}, 2, [](const SweepPoint& p, int k) {
    return p.numbers[0] < 0.5 ? 0.2 * k : 1.0 - 0.2 * k;
  });
  FindingRequest request{.test = FindingTest::below, .response = Measure::crack_span};
  request.margin = 0.95;
  Finding finding = judged(request, known);
  EXPECT_EQ(finding.high, 1.0);
  request.test = FindingTest::above;
  finding = judged(request, known);
  EXPECT_EQ(finding.low, 0.0);
  EXPECT_EQ(finding.outcome, FindingOutcome::undecided);
  request.response = Measure::fall_part;
  EXPECT_LT(judged(request, known).low, 0.0);
}

TEST(Finding, SaysWhatWasAskedInTheUnitOfTheMeasure) {
  FindingRequest request{.test = FindingTest::above, .margin = 2e7};
  const KnownSweep known({{"x", {"0", "1"}}}, 20,
                         [](const SweepPoint&, int k) { return 3e7 + deviation(k); });
  const auto ground = [&] { return judged(request, known).ground; };
  EXPECT_EQ(ground(), "all means above 20 MPa");
  request = {.test = FindingTest::below, .response = Measure::failure_strain, .margin = 0.005};
  EXPECT_EQ(ground(), "all means below 0.5 %");
  request = {.test = FindingTest::below, .response = Measure::fall_part, .margin = 0.05};
  EXPECT_EQ(ground(), "all means below 0.05");
  request = {.test = FindingTest::same, .keys = {"x"}, .margin = 1.0 / 3.0};
  EXPECT_EQ(ground(), "all differences within ±33.33 %");
}

// Of three points over x one has one run left, the others having failed.
Finding judged_with_failed_runs(FindingTest test, std::size_t point = 2) {
  KnownSweep known({{"x", {"0", "1", "2"}}}, 20, [](const SweepPoint& p, int k) {
    return 1e6 * (100.0 - 10.0 * p.numbers[0] + deviation(k));
  });
  for (std::size_t i = 1; i < 20; ++i) known.runs[20 * point + i].failed = true;
  const double margin = test == FindingTest::above ? 1e6 : 0.5;
  return judged({.test = test, .keys = {"x"}, .margin = margin}, known);
}

TEST(Finding, IsUndecidedWhereAPointHasTooFewRuns) {
  for (const FindingTest test :
       {FindingTest::falls, FindingTest::same, FindingTest::above, FindingTest::steady}) {
    const Finding finding = judged_with_failed_runs(test);
    EXPECT_EQ(finding.outcome, FindingOutcome::undecided);
    EXPECT_THAT(to_string(finding.compared), testing::StartsWith("x = 2"));
    EXPECT_TRUE(std::isnan(finding.low));
    EXPECT_THAT(finding.ground, testing::EndsWith("; 19 runs failed and do not count"));
  }
}

TEST(Finding, IsUndecidedWhereAStepOnTheWayHasTooFewRuns) {
  const Finding finding = judged_with_failed_runs(FindingTest::falls, 1);
  EXPECT_EQ(finding.outcome, FindingOutcome::undecided);
  EXPECT_TRUE(std::isnan(finding.low));
}

TEST(Finding, LinearAgreesWithALineAndDisagreesWithAParabola) {
  EXPECT_EQ(found(FindingTest::linear, 10.0, 1.0).outcome, FindingOutcome::agrees);
  const KnownSweep known({{"x", {"0", "1", "2"}}}, 20, [](const SweepPoint& p, int k) {
    return 100.0 + 30.0 * p.numbers[0] * p.numbers[0] + deviation(k);
  });
  EXPECT_EQ(judged({.test = FindingTest::linear, .keys = {"x"}}, known).outcome,
            FindingOutcome::disagrees);
}

TEST(Finding, IsJudgedForEveryValueOfPerWithTheOtherKeysHeld) {
  const KnownSweep known({{"x", {"0", "1"}}, {"y", {"1", "2"}}}, 20,
                         [](const SweepPoint& p, int k) {
                           const double effect = p.numbers[1] > 1.5 ? 20.0 * p.numbers[0] : 0.0;
                           return 100.0 * p.numbers[1] + effect + deviation(k);
                         });
  FindingRequest request;
  request.keys = {"x"};
  request.per = "y";
  const auto findings = judge(request, known.plan, known.points, known.runs);
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].outcome, FindingOutcome::agrees);
  EXPECT_EQ(findings[1].outcome, FindingOutcome::disagrees);
}

TEST(Finding, HasNoInertiaNumberWhereNoneOfItsPointsHasOne) {
  KnownSweep known({{"x", {"0", "1"}}}, 20, [](const SweepPoint&, int k) { return deviation(k); });
  const FindingRequest request{.keys = {"x"}};
  for (SweepPoint& point : known.points) point.inertia_number = std::nan("");
  EXPECT_TRUE(std::isnan(judged(request, known).inertia_high));
  known.points.back().inertia_number = 0.1;
  const Finding finding = judged(request, known);
  EXPECT_EQ(finding.inertia_low, 0.1);
  EXPECT_EQ(finding.inertia_high, 0.1);
}

// One run of a point ended at the strain limit.
Finding judged_with_an_unbroken_run(Measure response) {
  KnownSweep known({{"x", {"0", "1"}}}, 20,
                   [](const SweepPoint&, int k) { return 100.0 + deviation(k); });
  known.runs.back().broke = false;
  return judged({.response = response, .keys = {"x"}, .if_undecided = "who knows"}, known);
}

TEST(Finding, IsUndecidedWhereARunDidNotBreak) {
  const Finding finding = judged_with_an_unbroken_run(Measure::strength);
  EXPECT_EQ(finding.outcome, FindingOutcome::undecided);
  EXPECT_THAT(finding.ground, testing::EndsWith("; 1 run did not break: raise loading.max_strain"));
  EXPECT_EQ(finding.runs, 39);
  EXPECT_TRUE(std::isnan(finding.value));
}

TEST(Finding, SaysWhichRunsHadTheModulusOfAShock) {
  KnownSweep known({{"x", {"0", "1"}}}, 20,
                   [](const SweepPoint&, int k) { return 100.0 + deviation(k); });
  for (std::size_t i = 20; i < 40; ++i)
    known.runs[i].measures[static_cast<std::size_t>(Measure::modulus)] = std::nan("");
  const Finding finding = judged({.response = Measure::modulus, .keys = {"x"}}, known);
  EXPECT_EQ(finding.outcome, FindingOutcome::undecided);
  EXPECT_EQ(finding.runs, 20);
  EXPECT_THAT(finding.ground,
              testing::EndsWith("; 20 runs had the modulus of a shock and do not count"));
}

TEST(Finding, SaysWhichRunsBrokeNoHeadTailJoint) {
  KnownSweep known({{"x", {"0", "1"}}}, 20,
                   [](const SweepPoint&, int k) { return 0.5 + 0.01 * deviation(k); });
  for (std::size_t i = 20; i < 40; ++i)
    known.runs[i].measures[static_cast<std::size_t>(Measure::crack_linked)] = std::nan("");
  EXPECT_THAT(judged({.response = Measure::crack_linked, .keys = {"x"}}, known).ground,
              testing::EndsWith("; 20 runs broke no head-tail joint and do not count"));
}

TEST(Finding, OfTheModulusNeedsNoBreak) {
  const Finding finding = judged_with_an_unbroken_run(Measure::modulus);
  EXPECT_EQ(finding.outcome, FindingOutcome::agrees);
  EXPECT_EQ(finding.runs, 40);
}

TEST(Finding, GivesTheWordsOfItsOutcome) {
  EXPECT_EQ(found(FindingTest::same, 0.0, 1.0).meaning, "so it is");
  EXPECT_EQ(found(FindingTest::same, 9.0, 1.0).meaning, "");
  EXPECT_EQ(found(FindingTest::same, 2.5, 5.0).meaning, "who knows");
  EXPECT_EQ(judged_with_an_unbroken_run(Measure::strength).meaning, "who knows");
}

}  // namespace
}  // namespace havers::calib
