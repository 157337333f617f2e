// Pages of havers bench that compare methods, chains and intervals.
#include "reports/bench_pages.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reports/figures/figures.hpp"
#include "tests/reports/sound_page.hpp"

namespace havers::reports {
namespace {

using test::contains;
using test::expect_sound;

calib::PorosityTrial trial_of(const std::string& hardship, double truth, double ours) {
  calib::PorosityTrial trial{.hardship = hardship, .pixels = 1e6, .truth = truth};
  trial.readings = {{{0.5, 1e-3}, {0.4, 2e-3}, {0.3, 1e-2}, {ours, 3e-2}}};
  trial.standard_error = 0.01;
  return trial;
}

TEST(MethodsPage, ComparesMethodsByErrorAndTime) {
  const auto comparison =
      calib::compare_methods({trial_of("blur", 0.0, 0.0), trial_of("noise", 0.05, 0.052)});
  const std::string page = methods_page(comparison, {});
  expect_sound(page);
  EXPECT_TRUE(contains(page, "On 2 drawn sections havers porosity errs by 0.20 points"));
  EXPECT_TRUE(contains(page, "Asked: at most 0.3 points"));
  EXPECT_FALSE(contains(page, "hold the truth"));
  EXPECT_TRUE(contains(page, "<th>noise</th>"));
  EXPECT_TRUE(contains(page, "33.3"));  // MPix/s of 0.03 s for a million pixels
}

TEST(MethodsPage, SaysThatItWasStopped) {
  auto comparison = calib::compare_methods({trial_of("blur", 0.0, 0.0)});
  EXPECT_TRUE(contains(methods_page(comparison, {}), "verdict good"));
  comparison.complete = false;
  const std::string page = methods_page(comparison, {});
  EXPECT_TRUE(contains(page, "verdict mixed"));
  EXPECT_TRUE(
      contains(page, "Stopped before all sections were measured. On 1 drawn section havers"));
}

calib::ChainRow chain_row(const std::string& chain, double error, long simulations) {
  return {.chain = chain,
          .study = 1,
          .error = error,
          .cost = 1.0,
          .informed = 3,
          .simulations = simulations,
          .seconds = 0.5,
          .success = true,
          .trace = {{simulations / 10, 0.1, 0.4}, {simulations, 0.5, error}}};
}

TEST(ChainsPage, NamesTheWinnerAndDrawsErrorAgainstCost) {
  std::vector<calib::ChainRow> rows;
  for (const calib::Chain& chain : calib::all_chains())
    rows.push_back(chain_row(chain.name, 0.0123, rows.empty() ? 300 : 400));
  const auto benchmark = calib::summarise(std::move(rows));
  const std::string page = chains_page(benchmark, {});
  expect_sound(page);
  EXPECT_TRUE(contains(page, "<p class=\"sentence\">The chain “" +
                                 calib::all_chains().front().name +
                                 "” needs the fewest simulations of those"));
  EXPECT_TRUE(contains(page, "It is the default."));
  EXPECT_TRUE(contains(page, "<td class=\"n\">1.2</td><td class=\"n\">300</td>"));
  EXPECT_TRUE(contains(page, "7 fits of 1 study of known truth."));
  EXPECT_TRUE(contains(page, "bysimulations"));
}

TEST(ChainsPage, ClaimsNoClearLeadWhereRangesMeet) {
  std::vector<calib::ChainRow> rows;
  for (const calib::Chain& chain : calib::all_chains())
    for (const int study : {1, 2}) {
      rows.push_back(chain_row(chain.name, 0.0123, (rows.size() < 2 ? 310 : 300) + 200 * study));
      rows.back().study = study;
    }
  const auto benchmark = calib::summarise(std::move(rows));
  const std::string page = chains_page(benchmark, {});
  EXPECT_TRUE(contains(page, "” needs the fewest simulations, though not clearly, of those"));
  EXPECT_TRUE(contains(page, "It is not the default. Its range meets that of “" +
                                 calib::all_chains().front().name + "”, “"));
  EXPECT_TRUE(contains(page, "verdict mixed"));
}

// Its lines begin at the left and end at the bottom, where the names would stand.
TEST(ChainsFigure, HasItsLegendOutside) {
  std::vector<calib::ChainRow> rows;
  for (const calib::Chain& chain : calib::all_chains())
    rows.push_back(chain_row(chain.name, 0.0123, 300));
  const auto benchmark = calib::summarise(std::move(rows));
  const Figure figure = chains_figure(benchmark, ChainCost::simulations, "c");
  EXPECT_FALSE(contains(figure.commands, "key inside"));
  EXPECT_EQ(figure.height, 380 + 4 * 18);
}

TEST(CoveragePage, SaysWhichIntervalsHoldLessThanTheyPromise) {
  calib::Coverage coverage;
  coverage.summaries = {
      {.design = "0, 90 deg",
       .parameter = "young_GPa",
       .studies = 100,
       .informed = 100,
       .inside = calib::rate_of(95, 100),
       .half_width = {0.01, 0.02, 0.03}},
      {.design = "0, 90 deg", .parameter = "ratio", .studies = 100, .half_width = {NAN, NAN, NAN}}};
  const std::string page = coverage_page(coverage, {});
  expect_sound(page);
  EXPECT_TRUE(contains(
      page, "Of 100 intervals 95.0 (88.8 to 97.8)\u00a0% hold the truth; 95\u00a0% should."));
  EXPECT_TRUE(contains(page, "<th>0, 90°</th><td>E</td>")) << page;
  EXPECT_TRUE(contains(page, "100 of 100"));
  EXPECT_TRUE(contains(page, "No share differs from 95\u00a0%"));
  EXPECT_TRUE(contains(page, "<td>as promised</td>"));
  coverage.summaries.front().inside = calib::rate_of(100, 100);
  const std::string wide = coverage_page(coverage, {});
  EXPECT_TRUE(contains(wide, "verdict good"));
  EXPECT_TRUE(contains(wide, "Some intervals are too wide by more than chance, none too narrow."));
  coverage.summaries.front().inside = calib::rate_of(80, 100);
  const std::string narrow = coverage_page(coverage, {});
  EXPECT_TRUE(contains(narrow, "verdict bad"));
  EXPECT_TRUE(contains(narrow, "Some intervals are too narrow by more than chance."));
  EXPECT_TRUE(contains(narrow, "<td>too narrow</td>"));
}

// Three shares of `all` intervals, of which the first holds as often as `held`.
calib::Coverage coverage_of(int held, int all) {
  calib::Coverage coverage;
  for (const char* parameter : {"young_GPa", "head_tail_MPa", "ratio"})
    coverage.summaries.push_back(
        {.design = "0, 90 deg",
         .parameter = parameter,
         .studies = all,
         .informed = all,
         .inside = calib::rate_of(coverage.summaries.empty() ? held : all * 19 / 20, all),
         .half_width = {0.01, 0.02, 0.03}});
  return coverage;
}

TEST(CoveragePage, SaysThatItWasStopped) {
  calib::Coverage coverage = coverage_of(95, 100);
  coverage.complete = false;
  const std::string page = coverage_page(coverage, {});
  EXPECT_TRUE(contains(page, "verdict mixed"));
  EXPECT_TRUE(contains(page, "Stopped before all studies were fitted. Of 300 intervals"));
}

TEST(CoveragePage, CallsNoRowAsPromisedWhoseIntervalLeavesOut95) {
  const std::string page = coverage_page(coverage_of(90, 100), {});
  EXPECT_TRUE(contains(page, "90.0 (82.6 to 94.5)")) << page;
  EXPECT_TRUE(contains(page, "<td>perhaps too narrow</td>"));
  EXPECT_TRUE(contains(page, "verdict good"));
}

TEST(CoveragePage, SaysWhereStudiesAreTooFewToTell) {
  const std::string page = coverage_page(coverage_of(1, 1), {});
  EXPECT_TRUE(contains(page, "<td>too few to tell</td>"));
  EXPECT_FALSE(contains(page, "<td>as promised</td>"));
  EXPECT_TRUE(contains(page, "Too few studies to tell the shares from 95\u00a0%."));
  EXPECT_TRUE(contains(page, "verdict mixed"));
}

}  // namespace
}  // namespace havers::reports
