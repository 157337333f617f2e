// The tables of havers bench, read back by a reader of CSV.
#include "io/results/bench_files.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/machine/csv_rows.hpp"
#include "io/results/csv_row.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;
using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string& text) {
  Rows rows;
  CsvRows reader(',', [&rows](const Row& row) {
    rows.emplace_back(row.cells.begin(), row.cells.end());
    return true;
  });
  reader.feed(text);
  reader.finish();
  return rows;
}

TEST(BenchFiles, QuoteNamesAndReasonsAsCsvDoes) {
  sim::StabilityResult result{.name = "a \"soft\" wall, turned", .reason = "two\nlines"};
  const Rows stability = rows_of(stability_csv({result}));
  EXPECT_THAT(stability.front(), ElementsAre("scene", "outcome", "as_it_must", "error", "residual",
                                             "energy_defect", "penetration", "wall_s", "reason"));
  EXPECT_THAT(stability.back(),
              ElementsAre(result.name, "failed", "0", "0", "0", "0", "0", "0", result.reason));

  const calib::PorosityTrial trial{.hardship = "noise, \"salt\"", .ring = true, .pixels = 4194304};
  const Rows methods = rows_of(methods_csv(calib::compare_methods({trial})));
  EXPECT_THAT(methods.front(), ElementsAre("hardship", "ring", "pixels", "truth", "method",
                                           "porosity", "cpu_s", "standard_error"));
  EXPECT_THAT(methods[1], ElementsAre(trial.hardship, "1", "4194304", "0",
                                      "middle of the grey scale, whole image", "0", "0", ""));
  EXPECT_THAT(methods.back(),
              ElementsAre(trial.hardship, "1", "4194304", "0", "havers porosity", "0", "0", "0"));
}

TEST(BenchFiles, HaveAColumnForEveryPartOfASetting) {
  sim::WorkPrecision study;
  study.rows.push_back({.errors = {.strength = {0.25}, .strength_without_ringing = {0.125}}});
  const Rows rows = rows_of(work_precision_csv(study));
  ASSERT_EQ(rows.front().size(), rows.back().size());
  const std::vector<std::string> names(rows.front().begin(), rows.front().begin() + 8);
  EXPECT_THAT(names, testing::ElementsAre("setting", "regime", "contact", "tolerance", "step_s",
                                          "refinement", "leave_out", "leap"));
  const auto value = [&](const std::string& name) {
    return rows.back().at(
        static_cast<std::size_t>(std::ranges::find(rows.front(), name) - rows.front().begin()));
  };
  EXPECT_EQ(value("strength_error"), "0.25");
  EXPECT_EQ(value("strength_without_ringing_error"), "0.125");
  EXPECT_EQ(rows.back()[0], to_string(study.rows.front().setting));
}

TEST(BenchFiles, SayWhetherABenchWasCompleted) {
  EXPECT_EQ(chains_json({}, {})["complete"], false);
  EXPECT_EQ(coverage_json({.rows = {}, .summaries = {}, .complete = false}, {})["complete"], false);
  EXPECT_EQ(coverage_json({}, {})["complete"], true);
  calib::MethodComparison methods = calib::compare_methods({{.hardship = "noise"}});
  EXPECT_EQ(methods_json(methods, {})["complete"], true);
  methods.complete = false;
  EXPECT_EQ(methods_json(methods, {})["complete"], false);
}

TEST(BenchFiles, HaveAHeaderWithoutRows) {
  EXPECT_EQ(rows_of(stability_csv({})).size(), 1U);
  EXPECT_EQ(rows_of(work_precision_csv({})).size(), 1U);
}

}  // namespace
}  // namespace havers::io
