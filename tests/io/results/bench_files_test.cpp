// The tables of havers bench, read back by a reader of CSV.
#include "io/results/bench_files.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

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
  study.rows.emplace_back();
  const Rows rows = rows_of(work_precision_csv(study));
  ASSERT_EQ(rows.front().size(), rows.back().size());
  EXPECT_EQ(rows.front().front(), "setting");
  EXPECT_EQ(rows.front()[1], "regime");
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
