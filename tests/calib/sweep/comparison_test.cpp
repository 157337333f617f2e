#include "calib/sweep/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/calib/student_tail.hpp"
#include "tests/support/sweeps.hpp"

namespace havers::calib {
namespace {

using test::deviation;
using test::KnownSweep;

// Strengths that fall with d and are four times as high at 0°, the points in this order.
Finding falling_in_a_list(const std::vector<std::string>& angles,
                          const std::vector<std::string>& scatters) {
  const KnownSweep known(
      {{"angle", angles}, {"d", scatters}}, 20,
      [](const SweepPoint& p, int k) {
        return (p.numbers[0] > 45.0 ? 100.0 : 400.0) * (1.0 - 0.2 * p.numbers[1]) + deviation(k);
      },
      Sampling::list);
  return judge({.test = FindingTest::falls, .keys = {"d"}}, known.plan, known.points, known.runs)
      .front();
}

TEST(Comparison, OfAListIsBetweenPointsThatDifferInTheKeyAlone) {
  for (const Finding& finding :
       {falling_in_a_list({"90", "0", "90", "0"}, {"0.1", "0.1", "0.5", "0.5"}),
        falling_in_a_list({"0", "0", "90", "90"}, {"0.5", "0.1", "0.1", "0.5"})}) {
    EXPECT_EQ(finding.outcome, FindingOutcome::agrees);
    EXPECT_EQ(finding.comparisons, 2);
    EXPECT_EQ(to_string(finding.compared), "d = 0.5 against 0.1, angle = 90");
  }
}

TEST(Comparison, OfAListIsBetweenAllPointsWhereKeysGoTogether) {
  const Finding finding = falling_in_a_list({"0", "30", "90"}, {"0.1", "0.3", "0.5"});
  EXPECT_EQ(finding.outcome, FindingOutcome::agrees);
  EXPECT_EQ(finding.comparisons, 3);
  EXPECT_EQ(to_string(finding.compared), "d = 0.5 against 0.1");
}

TEST(Comparison, OfAListSaysWhichPointsItLeavesAlone) {
  const Finding some = falling_in_a_list({"90", "90", "0"}, {"0.1", "0.5", "0.1"});
  EXPECT_EQ(some.comparisons, 1);
  EXPECT_EQ(some.runs, 40);
  EXPECT_NE(some.ground.find("; not compared: 1 point that no other"), std::string::npos);
  const Finding all = falling_in_a_list({"90", "90"}, {"0.1", "0.5"});
  EXPECT_EQ(all.runs, 40);
  EXPECT_EQ(all.ground.find("not compared"), std::string::npos);
}

TEST(Comparison, IsNotBetweenEqualValues) {
  const KnownSweep known({{"x", {"1", "2", "1", "1.0"}}}, 20,
                         [](const SweepPoint& p, int k) { return p.numbers[0] + deviation(k); });
  for (const FindingTest test : {FindingTest::same, FindingTest::rises})
    EXPECT_EQ(judge({.test = test, .keys = {"x"}}, known.plan, known.points, known.runs)
                  .front()
                  .comparisons,
              3);
}

bool has_nothing_to_compare(const FindingRequest& request, const std::vector<SweepKey>& keys,
                            Sampling sampling) {
  const KnownSweep known(
      keys, 2, [](const SweepPoint&, int) { return 1.0; }, sampling);
  return group_without_comparison(request, known.plan, known.points).has_value();
}

TEST(Comparison, IsMissingInASampleOfTwoKeysButForALine) {
  const std::vector<SweepKey> keys{{"x", {"0", "1"}}, {"y", {"0", "1"}}};
  FindingRequest request{.keys = {"x"}};
  for (const FindingTest test :
       {FindingTest::same, FindingTest::matters, FindingTest::rises, FindingTest::falls}) {
    request.test = test;
    EXPECT_TRUE(has_nothing_to_compare(request, keys, Sampling::sobol));
    EXPECT_TRUE(has_nothing_to_compare(request, keys, Sampling::latin_hypercube));
    EXPECT_FALSE(has_nothing_to_compare(request, keys, Sampling::grid));
    EXPECT_FALSE(has_nothing_to_compare(request, keys, Sampling::list));
  }
  request = {.test = FindingTest::linear, .keys = {"x", "y"}};
  EXPECT_FALSE(has_nothing_to_compare(request, keys, Sampling::sobol));
  EXPECT_TRUE(has_nothing_to_compare(request, keys, Sampling::list));
}

TEST(Comparison, IsMissingWhereTheKeyStandsStillInOneGroup) {
  const std::vector<SweepKey> keys{{"x", {"1", "1", "2"}}, {"y", {"0", "5", "5"}}};
  EXPECT_FALSE(has_nothing_to_compare({.keys = {"x"}}, keys, Sampling::list));
  EXPECT_TRUE(has_nothing_to_compare({.keys = {"x"}, .per = "y"}, keys, Sampling::list));
  EXPECT_TRUE(has_nothing_to_compare({.keys = {"x"}}, {{"x", {"1", "1.0"}}}, Sampling::grid));
  EXPECT_FALSE(has_nothing_to_compare({.test = FindingTest::above}, keys, Sampling::list));
}

// Of a sweep without `per`, in the order of its points.
std::vector<Comparison> all_comparisons(const FindingRequest& request, const KnownSweep& known) {
  const auto groups = groups_of(known.points, known.plan, "");
  return comparisons_of({request, known.plan, known.points, known.runs}, groups.front());
}

// Values 1 % above and below the mean, in turn.
double one_percent_about(double mean, int k) {
  return mean * (k % 2 == 0 ? 1.01 : 0.99);
}

// Three points with two runs each: a relative standard error of 1 %, 1 degree of freedom.
KnownSweep three_points(double middle) {
  return {{{"x", {"0", "1", "2"}}}, 2, [middle](const SweepPoint& p, int k) {
            return one_percent_about(p.numbers[0] == 1.0 ? middle : 100.0, k);
          }};
}

// (W3) Two runs against four. With relative variances a and b of the means, b = (√12 − 3) a,
// Welch's degrees of freedom (a + b)²/(a² + b²/3) are 2.
TEST(Comparison, OfTwoPointsIsWelchs) {
  const double b_over_a = std::sqrt(12.0) - 3.0;
  // The standard error of two values m ± s is s, that of four is s/√3.
  const double second_spread = 130.0 * 0.01 * std::sqrt(3.0 * b_over_a);
  KnownSweep known({{"x", {"0", "1"}}}, 4, [&](const SweepPoint& p, int k) {
    return p.numbers[0] == 0.0 ? one_percent_about(100.0, k)
                               : 130.0 + (k % 2 == 0 ? 1.0 : -1.0) * second_spread;
  });
  known.runs[2].failed = known.runs[3].failed = true;
  const auto all = all_comparisons({.test = FindingTest::same, .keys = {"x"}}, known);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_NEAR(all[0].value, 0.3, 1e-12);
  const double error = 0.01 * std::sqrt(1.0 + b_over_a);
  const double up = std::log((1.0 + all[0].high) / 1.3);
  const double down = std::log(1.3 / (1.0 + all[0].low));
  EXPECT_NEAR(test::student_tail(up / error, 2), 0.025, 1e-12);
  EXPECT_NEAR(down, up, 1e-12);
}

// Equal relative variances of two means of two runs: 2 degrees of freedom.
TEST(Comparison, OfThreePairsTakesAThirdOfTheRiskEach) {
  const auto all = all_comparisons({.test = FindingTest::same, .keys = {"x"}}, three_points(100.0));
  ASSERT_EQ(all.size(), 3U);
  for (const Comparison& one : all) {
    const double up = std::log1p(one.high) / (0.01 * std::sqrt(2.0));
    EXPECT_NEAR(test::student_tail(up, 2), 0.025 / 3.0, 1e-12);
  }
}

TEST(Comparison, OfThreeMeansTakesAThirdOfTheRiskEach) {
  const auto all = all_comparisons({.test = FindingTest::above}, three_points(200.0));
  ASSERT_EQ(all.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double mean = i == 1 ? 200.0 : 100.0;
    EXPECT_NEAR(all[i].value, mean, 1e-12 * mean);
    EXPECT_NEAR(test::student_tail((all[i].high - mean) / (0.01 * mean), 1), 0.025 / 3.0, 1e-12);
    EXPECT_NEAR(mean - all[i].low, all[i].high - mean, 1e-12 * mean);
  }
}

// (W4) χ² of 2 degrees of freedom lies beyond x with the probability exp(−x/2).
TEST(Comparison, OfVariationsIsByChiSquared) {
  const KnownSweep known({{"x", {"0", "1", "2"}}}, 3,
                         [](const SweepPoint&, int k) { return 50.0 + 2.0 * (k - 1); });
  const double share = 0.05 / 3.0, cv = 2.0 / 50.0;
  const auto all = all_comparisons({.test = FindingTest::steady}, known);
  ASSERT_EQ(all.size(), 3U);
  for (const Comparison& one : all) {
    EXPECT_NEAR(one.value, cv, 1e-12);
    EXPECT_NEAR(one.low, cv / std::sqrt(-std::log(0.5 * share)), 1e-12);
    EXPECT_NEAR(one.high, cv / std::sqrt(-std::log(1.0 - 0.5 * share)), 1e-11);
  }
}

// (W5) Through 100, 130, 100 goes the level line at 110, the mean of all.
TEST(Comparison, OfALineIsThatOfTheMeansOverTheMeanOfAll) {
  const auto all =
      all_comparisons({.test = FindingTest::linear, .keys = {"x"}}, three_points(130.0));
  ASSERT_EQ(all.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(all[i].value, (i == 1 ? 20.0 : -10.0) / 110.0, 1e-12);
    const double error = (i == 1 ? 1.3 : 1.0) / 110.0;
    EXPECT_NEAR(test::student_tail((all[i].high - all[i].value) / error, 1), 0.025 / 3.0, 1e-12);
    EXPECT_NEAR(all[i].value - all[i].low, all[i].high - all[i].value, 1e-12);
  }
}

}  // namespace
}  // namespace havers::calib
