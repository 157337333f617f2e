// The calibration with the real simulator, on studies whose truth is known.
#include "calib/synthetic/known_study.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "calib/fit/calibration.hpp"
#include "calib/synthetic/chain_benchmark.hpp"
#include "calib/synthetic/coverage.hpp"
#include "tests/support/slow.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

const Design along{.name = "along", .degrees = {0.0, 0.0, 0.0, 0.0}};
const Design one_bar{.name = "one", .degrees = {0.0}};

void expect_left_out(const CalibrationResult& result, const std::string& name) {
  const auto parameter = test::parameter_of(result, name);
  EXPECT_FALSE(parameter.identifiable) << parameter.value;
  EXPECT_TRUE(std::isnan(parameter.standard_error));
  EXPECT_TRUE(std::isnan(parameter.interval_95[0]) && std::isnan(parameter.interval_95[1]));
  EXPECT_THAT(parameter.left_out_because, testing::HasSubstr("unidentifiable"));
  EXPECT_EQ(std::ranges::count(result.fitted, name), 0);
  const auto check = std::ranges::find(result.verdict, "identifiable", &Check::check);
  EXPECT_EQ(check->outcome, Outcome::warn);
  EXPECT_THAT(check->text, testing::HasSubstr(name + " is left out"));
}

// Flanks that are weak beside the head-tail joints: along the fibres only the latter decide.
TEST(KnownStudy, AlongTheFibresTheRatioCannotBeToldWhereItIsWellAboveOne) {
  HAVERS_SLOW;
  KnownStudy known = known_study(along, 1, {15.0, 80.0, 4.0});
  known.study.calibrate.parameters = {"young_GPa", "head_tail_MPa", "ratio"};
  known.study.model.joints.flank =
      sim::flank_from_ratio(known.study.model.assembly, known.study.model.joints.head_tail, 4.0);
  const auto result = calibrate(known.study);
  expect_left_out(result, "ratio");
  EXPECT_TRUE(test::parameter_of(result, "young_GPa").identifiable);
  EXPECT_TRUE(test::parameter_of(result, "head_tail_MPa").identifiable);
}

// Soft fibres reach the strain limit first.
TEST(KnownStudy, HasNoSpecimensThatDidNotBreak) {
  EXPECT_TRUE(known_study(along, 1, {0.5, 80.0, 1.0}).study.specimens.empty());
}

TEST(KnownStudy, OneSpecimenDoesNotTellTheScatter) {
  HAVERS_SLOW;
  KnownStudy known = known_study(one_bar, 1);
  known.study.calibrate.parameters = {"young_GPa", "head_tail_MPa", "scatter"};
  const auto result = calibrate(known.study);
  expect_left_out(result, "scatter");
  const auto spread = std::ranges::find(result.verdict, "spread between specimens", &Check::check);
  EXPECT_EQ(spread->outcome, Outcome::warn);
}

// A few studies of what havers bench --coverage does a hundred times. Of 18 intervals fewer than 14
// would hold by chance once in a thousand.
TEST(Coverage, OfAFewStudiesHoldsTheTruth) {
  HAVERS_SLOW;
  const Coverage coverage = measure_coverage({three_orientations()}, 6, 1, [] { return true; });
  ASSERT_EQ(coverage.rows.size(), 18U);
  EXPECT_TRUE(coverage.complete);
  ASSERT_EQ(coverage.summaries.size(), 3U);
  int informed = 0, inside = 0;
  for (const CoverageRow& row : coverage.rows) {
    EXPECT_EQ(row.informed, std::isfinite(row.lower) && std::isfinite(row.upper));
    EXPECT_EQ(row.inside, row.lower <= row.truth && row.truth <= row.upper);
    informed += row.informed ? 1 : 0;
    inside += row.inside ? 1 : 0;
  }
  EXPECT_GE(informed, 16);
  EXPECT_GE(inside, informed - 4);
}

TEST(Coverage, StopsWhenTold) {
  HAVERS_SLOW;
  int asked = 0;
  const Coverage coverage = measure_coverage({one_bar}, 6, 1, [&] { return ++asked < 2; });
  EXPECT_EQ(coverage.rows.size(), 3U);
  EXPECT_FALSE(coverage.complete);
}

TEST(Coverage, StopsInsideAFitWithoutItsRows) {
  HAVERS_SLOW;
  int fits = 0;
  const Coverage coverage = measure_coverage(
      {three_orientations()}, 6, 1, [&] { return ++fits > 0; }, [] { return true; });
  EXPECT_EQ(fits, 1);
  EXPECT_TRUE(coverage.rows.empty());
  EXPECT_FALSE(coverage.complete);
}

Coverage shares_of(const std::vector<int>& held, int informed) {
  Coverage coverage;
  for (const int part : held)
    coverage.summaries.push_back({.design = "d",
                                  .parameter = "p",
                                  .studies = informed,
                                  .informed = informed,
                                  .inside = rate_of(part, informed),
                                  .half_width = {}});
  return coverage;
}

// Twelve misses in a hundred are chance where they are the most of twelve shares, but not alone.
TEST(Coverage, IsJudgedByAllSharesTogether) {
  const auto width_of_first = [](const Coverage& coverage) {
    return coverage.width_of(coverage.summaries.front());
  };
  std::vector<int> twelve(12, 95);
  twelve.front() = 88;
  EXPECT_EQ(width_of_first(shares_of(twelve, 100)), IntervalWidth::perhaps_too_narrow);
  EXPECT_TRUE(shares_of(twelve, 100).holds());
  EXPECT_EQ(width_of_first(shares_of({88}, 100)), IntervalWidth::too_narrow);
  twelve.front() = 87;
  EXPECT_EQ(width_of_first(shares_of(twelve, 100)), IntervalWidth::too_narrow);
  EXPECT_FALSE(shares_of(twelve, 100).holds());
  EXPECT_EQ(width_of_first(shares_of(std::vector<int>(12, 1), 1)), IntervalWidth::too_few);
  EXPECT_TRUE(shares_of({0}, 1).holds()) << "one study says nothing";
  EXPECT_TRUE(shares_of({0}, 0).holds());
}

TEST(Coverage, CallsNoShareAsPromisedThatMayBeMuchPoorer) {
  const auto width_of = [](int held, int informed) {
    const Coverage coverage = shares_of({held}, informed);
    return coverage.width_of(coverage.summaries.front());
  };
  EXPECT_EQ(width_of(4, 4), IntervalWidth::too_few);
  EXPECT_EQ(width_of(19, 20), IntervalWidth::too_few);
  EXPECT_EQ(width_of(95, 100), IntervalWidth::as_promised);
  EXPECT_EQ(width_of(0, 4), IntervalWidth::too_narrow);
}

TEST(Coverage, OfTooWideIntervalsHolds) {
  const Coverage coverage = shares_of({100}, 100);
  EXPECT_EQ(coverage.width_of(coverage.summaries.front()), IntervalWidth::too_wide);
  EXPECT_TRUE(coverage.holds());
}

// Wilson's interval for 19 of 20: (0.7639, 0.9911).
TEST(Rate, HasWilsonsInterval) {
  const Rate rate = rate_of(19, 20);
  EXPECT_NEAR(rate.part, 0.95, 1e-12);
  EXPECT_NEAR(rate.interval_95[0], 0.7639, 5e-5);
  EXPECT_NEAR(rate.interval_95[1], 0.9911, 5e-5);
  EXPECT_TRUE(std::isnan(rate_of(0, 0).part));
}

ChainRow row_of(const Chain& chain, int study, double cost, long simulations) {
  return {.chain = chain.name,
          .study = study,
          .error = 0.01,
          .cost = cost,
          .informed = 3,
          .simulations = simulations,
          .seconds = 1e-3 * static_cast<double>(simulations),
          .success = true,
          .trace = {{simulations / 4, 0.25e-3 * static_cast<double>(simulations), 0.2},
                    {simulations, 1e-3 * static_cast<double>(simulations), 0.01}}};
}

// The cheapest chain stops in a worse minimum in half of the studies, and so does not win.
TEST(ChainBenchmark, IsWonByTheFewestSimulationsAmongThoseThatSucceed) {
  const auto chains = all_chains();
  std::vector<ChainRow> rows;
  for (int study = 0; study < 20; ++study)
    for (std::size_t c = 0; c < chains.size(); ++c) {
      const double missed = c == 0 && study % 2 == 0 ? 1.0 : 0.0;
      rows.push_back(row_of(chains[c], study, 2.0 + missed, 100 + 100 * static_cast<long>(c)));
    }
  const ChainBenchmark benchmark = summarise(std::move(rows));
  EXPECT_EQ(benchmark.winner().chain, chains[1].name);
  const ChainSummary& first = benchmark.summaries.front();
  EXPECT_EQ(first.success.part, 0.5);
  EXPECT_EQ(first.by_simulations.front().cost, 25.0);
  EXPECT_EQ(first.by_simulations.front().error[1], 0.2);
  EXPECT_EQ(first.by_simulations.back().error[1], 0.01);
}

// One study lost, which others do not lose, is too many; so is twice the error, however cheap.
TEST(ChainBenchmark, IsNotWonByWhatLosesAStudyOrErrsMore) {
  const auto chains = all_chains();
  std::vector<ChainRow> rows;
  for (int study = 0; study < 20; ++study)
    for (std::size_t c = 0; c < chains.size(); ++c) {
      const double missed = c == 0 && study == 7 ? 1.0 : 0.0;
      rows.push_back(row_of(chains[c], study, 2.0 + missed, 100 + 100 * static_cast<long>(c)));
      if (c == 1) rows.back().error *= 2.0;
    }
  EXPECT_EQ(summarise(std::move(rows)).winner().chain, chains[2].name);
}

// What BOBYQA is for: ratio and scatter both move the order of breaks.
TEST(ChainBenchmark, HasStudiesInWhichTwoUnknownsCostSimulations) {
  HAVERS_SLOW;
  KnownStudy known = known_study(unknown_scatter(), 1);
  known.study.calibrate.threads = 1;
  const auto result = calibrate(known.study);
  EXPECT_EQ(result.fitted, (std::vector<std::string>{"young_GPa", "ratio", "scatter"}));
  EXPECT_TRUE(std::ranges::any_of(
      result.stages, [](const StageLog& stage) { return stage.optimiser == "NLopt BOBYQA"; }));
  EXPECT_EQ(all_chains(CostlyUnknowns::two).front().name, "starts, BOBYQA, least squares");
  for (std::size_t k = 0; k < known.truth.size(); ++k) {
    const auto parameter = test::parameter_of(result, known.parameters.at(k));
    EXPECT_NEAR(parameter.value, known.truth.at(k), 5.0 * parameter.standard_error);
  }
}

TEST(ChainBenchmark, KeepsTheRowsOfAnUnfinishedOne) {
  HAVERS_SLOW;
  int asked = 0;
  const auto benchmark = benchmark_chains(CostlyUnknowns::one, 1, 1, [&] { return ++asked < 3; });
  EXPECT_EQ(benchmark.rows.size(), 2U);
  EXPECT_TRUE(benchmark.summaries.empty());
  EXPECT_EQ(benchmark.rows.front().trace.back().simulations <= benchmark.rows.front().simulations,
            true);
}

}  // namespace
}  // namespace havers::calib
