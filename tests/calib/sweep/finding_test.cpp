#include "calib/sweep/finding.hpp"

#include <gmock/gmock.h>

#include "tests/support/sweeps.hpp"

namespace havers::calib {
namespace {

using support::deviation;
using support::KnownSweep;

// Strengths of mean 100 + slope x with the standard deviation sd.
Finding found(FindingTest test, double slope, double sd, double margin = 0.05) {
  const KnownSweep known({{"x", {"0", "1", "2"}}}, 20, [&](const SweepPoint& p, int k) {
    return 100.0 + slope * p.numbers[0] + sd * deviation(k);
  });
  FindingRequest request;
  request.id = "R";
  request.test = test;
  request.keys = {"x"};
  request.margin = margin;
  request.if_agrees = "so it is";
  const auto findings = judge(request, known.plan, known.points, known.runs);
  EXPECT_EQ(findings.size(), 1U);
  return findings.front();
}

TEST(Finding, SameAgreesWithinTheMarginDisagreesBeyondAndElseIsUndecided) {
  EXPECT_EQ(found(FindingTest::same, 1.0, 1.0).outcome, FindingOutcome::agrees);
  EXPECT_EQ(found(FindingTest::same, 5.0, 1.0).outcome, FindingOutcome::disagrees);
  EXPECT_EQ(found(FindingTest::same, 2.5, 5.0).outcome, FindingOutcome::undecided);
}

TEST(Finding, ShowsTheComparisonThatSpeaksMostAgainstTheClaim) {
  const Finding finding = found(FindingTest::same, 5.0, 1.0);
  EXPECT_EQ(finding.what, "x = 2 against 0");
  EXPECT_NEAR(finding.value, 0.10, 1e-3);
  EXPECT_LT(finding.low, finding.value);
  EXPECT_GT(finding.high, finding.value);
  EXPECT_EQ(finding.comparisons, 3);
  EXPECT_EQ(finding.runs, 60);
}

TEST(Finding, MattersIsTheOppositeOfSame) {
  EXPECT_EQ(found(FindingTest::matters, 1.0, 1.0).outcome, FindingOutcome::disagrees);
  EXPECT_EQ(found(FindingTest::matters, 5.0, 1.0).outcome, FindingOutcome::agrees);
  EXPECT_EQ(found(FindingTest::matters, 2.5, 5.0).outcome, FindingOutcome::undecided);
}

TEST(Finding, RisesAndFallsTellTheSign) {
  EXPECT_EQ(found(FindingTest::rises, 3.0, 1.0).outcome, FindingOutcome::agrees);
  EXPECT_EQ(found(FindingTest::falls, 3.0, 1.0).outcome, FindingOutcome::disagrees);
  EXPECT_EQ(found(FindingTest::falls, -3.0, 1.0).outcome, FindingOutcome::agrees);
  EXPECT_EQ(found(FindingTest::rises, 0.0, 1.0).outcome, FindingOutcome::undecided);
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

TEST(Finding, LinearAgreesWithALine) {
  EXPECT_EQ(found(FindingTest::linear, 10.0, 1.0).outcome, FindingOutcome::agrees);
}

TEST(Finding, LinearDisagreesWithAParabola) {
  const KnownSweep known({{"x", {"0", "1", "2"}}}, 20, [](const SweepPoint& p, int k) {
    return 100.0 + 30.0 * p.numbers[0] * p.numbers[0] + deviation(k);
  });
  FindingRequest request;
  request.test = FindingTest::linear;
  request.keys = {"x"};
  EXPECT_EQ(judge(request, known.plan, known.points, known.runs).front().outcome,
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

TEST(Finding, GivesTheWordsOfItsOutcome) {
  EXPECT_EQ(found(FindingTest::same, 0.0, 1.0).meaning, "so it is");
  EXPECT_EQ(found(FindingTest::same, 9.0, 1.0).meaning, "");
}

}  // namespace
}  // namespace havers::calib
