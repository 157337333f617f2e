#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "calib/sweep/finding.hpp"
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

}  // namespace
}  // namespace havers::calib
