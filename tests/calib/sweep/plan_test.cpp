#include "calib/sweep/plan.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace havers::calib {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Plan, GridHoldsEveryCombinationTheLastKeyFastest) {
  const SweepPlan plan{.keys = {{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}}};
  const auto rows = points_of(plan);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_THAT(rows[1], ElementsAre("1", "y"));
  EXPECT_THAT(rows[5], ElementsAre("2", "z"));
}

TEST(Plan, ListTakesTheValuesTogether) {
  const SweepPlan plan{.sampling = Sampling::list, .keys = {{"a", {"1", "2"}}, {"b", {"3", "4"}}}};
  EXPECT_THAT(points_of(plan), ElementsAre(ElementsAre("1", "3"), ElementsAre("2", "4")));
}

TEST(Plan, LatinHypercubeHasOnePointInEveryStratumOfEveryKey) {
  const SweepPlan plan{.sampling = Sampling::latin_hypercube,
                       .keys = {{"a", {"0", "20"}}, {"b", {"0", "20"}}},
                       .points = 20};
  const auto rows = points_of(plan);
  for (std::size_t key = 0; key < 2; ++key) {
    std::vector<int> strata;
    for (const auto& row : rows) strata.push_back(static_cast<int>(std::stod(row[key])));
    std::ranges::sort(strata);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(strata[static_cast<std::size_t>(i)], i);
  }
}

TEST(Plan, LatinHypercubePairsTheKeysByTheSeed) {
  SweepPlan plan{.sampling = Sampling::latin_hypercube,
                 .keys = {{"a", {"0", "1"}}, {"b", {"0", "1"}}},
                 .points = 20};
  const auto first = points_of(plan);
  EXPECT_EQ(first, points_of(plan));
  plan.seed = 2;
  EXPECT_NE(first, points_of(plan));
}

TEST(Plan, SobolFillsEveryQuarterOfTheSquareAlike) {
  const SweepPlan plan{
      .sampling = Sampling::sobol, .keys = {{"a", {"0", "2"}}, {"b", {"0", "2"}}}, .points = 63};
  std::array<int, 4> quarters{};
  for (const auto& row : points_of(plan))
    ++quarters.at(static_cast<std::size_t>(2 * static_cast<int>(std::stod(row[0])) +
                                           static_cast<int>(std::stod(row[1]))));
  for (const int count : quarters) EXPECT_NEAR(count, 16, 1);
}

TEST(Plan, BoundsFarApartAreSampledByTheirLogarithm) {
  const SweepPlan plan{.sampling = Sampling::sobol, .keys = {{"a", {"1", "10000"}}}, .points = 1};
  EXPECT_NEAR(std::stod(points_of(plan)[0][0]), 100.0, 1e-6);
}

auto Complains(const std::string& key, const std::string& words) {
  return testing::AllOf(testing::Field(&SweepPlan::Problem::key, key),
                        testing::Field(&SweepPlan::Problem::what, HasSubstr(words)));
}

TEST(Plan, TextsAreNumbersOnlyAsAWhole) {
  EXPECT_EQ(number_in("1e3"), 1000.0);
  for (const char* const text : {"", "1e999", "3 mm", "free"})
    EXPECT_TRUE(std::isnan(number_in(text))) << text;
}

TEST(Plan, EveryComplaintIsMade) {
  const SweepPlan unequal{
      .sampling = Sampling::list, .keys = {{"a", {"1"}}, {"b", {"1", "2"}}}, .seeds = 0};
  EXPECT_THAT(unequal.problems(), ElementsAre(Complains("seeds", "is 0, must be 1 or more"),
                                              Complains("keys", "b has 2 values and a has 1")));
  const SweepPlan lone{.sampling = Sampling::list, .keys = {{"a", {"1", "2"}}, {"b", {"1"}}}};
  EXPECT_THAT(lone.problems(), ElementsAre(Complains("keys", "b has 1 value and a has 2")));
  const SweepPlan turned{.sampling = Sampling::sobol, .keys = {{"a", {"2", "1"}}}, .points = 0};
  EXPECT_THAT(turned.problems(), ElementsAre(Complains("points", "is 0, must be from 1 to 100000"),
                                             Complains("keys", "no lower and upper bound")));
  const SweepPlan endless{.keys = {{"a", {"1", "2", "3"}}}, .seeds = 1'000'000'000};
  EXPECT_THAT(endless.problems(),
              ElementsAre(Complains("seeds", "all points make 3e+09 runs, must be at most 1e+06")));
  EXPECT_THAT(SweepPlan{}.problems(), ElementsAre(Complains("keys", "names no keys to vary")));
}

}  // namespace
}  // namespace havers::calib
