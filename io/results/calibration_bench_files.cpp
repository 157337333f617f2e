// What havers bench --calibration and --coverage leave.
#include <nlohmann/json.hpp>

#include "io/results/bench_files.hpp"
#include "io/results/csv_row.hpp"

namespace havers::io {
namespace {

// The error of a chain against the cost so far; `cost` is the key of that cost.
nlohmann::json progress_json(const std::vector<calib::Progress>& progress, const char* cost) {
  nlohmann::json steps = nlohmann::json::array();
  for (const calib::Progress& step : progress)
    steps.push_back({{cost, step.cost}, {"error_10_50_90", step.error}});
  return steps;
}

}  // namespace

std::string chains_csv(const calib::ChainBenchmark& benchmark) {
  CsvTable table;
  for (const calib::ChainRow& one : benchmark.rows) {
    CsvRow row("chain", one.chain);
    row.key("study", one.study);
    row.key("error", one.error);
    row.key("cost", one.cost);
    row.key("informed", one.informed);
    row.key("simulations", one.simulations);
    row.key("wall_s", one.seconds);
    row.key("success", one.success);
    table.add(row);
  }
  return table.text;
}

nlohmann::json chains_json(const calib::ChainBenchmark& benchmark,
                           const calib::Provenance& provenance) {
  nlohmann::json chains = nlohmann::json::array();
  for (const calib::ChainSummary& summary : benchmark.summaries)
    chains.push_back({{"chain", summary.chain},
                      {"error_10_50_90", summary.error},
                      {"simulations_10_50_90", summary.simulations},
                      {"wall_s_10_50_90", summary.seconds},
                      {"success", summary.success.part},
                      {"success_95", summary.success.interval_95},
                      {"by_simulations", progress_json(summary.by_simulations, "simulations")},
                      {"by_wall_s", progress_json(summary.by_seconds, "wall_s")}});
  // A stopped bench has rows without summaries.
  return {{"complete", !chains.empty()},
          {"chains", chains},
          {"winner", chains.empty() ? "" : benchmark.winner().chain},
          {"fits", benchmark.rows.size()},
          {"wall_s", provenance.wall_seconds},
          {"provenance", provenance_object(provenance)}};
}

std::string coverage_csv(const calib::Coverage& coverage) {
  CsvTable table;
  for (const calib::CoverageRow& one : coverage.rows) {
    CsvRow row("design", one.design);
    row.key("study", one.study);
    row.key("parameter", one.parameter);
    row.key("truth", one.truth);
    row.key("value", one.value);
    row.key("lower", one.lower);
    row.key("upper", one.upper);
    row.key("informed", one.informed);
    row.key("inside", one.inside);
    table.add(row);
  }
  return table.text;
}

nlohmann::json coverage_json(const calib::Coverage& coverage, const calib::Provenance& provenance) {
  nlohmann::json summaries = nlohmann::json::array();
  for (const calib::CoverageSummary& summary : coverage.summaries) {
    summaries.push_back({{"design", summary.design},
                         {"parameter", summary.parameter},
                         {"studies", summary.studies},
                         {"informed", summary.informed},
                         {"inside", summary.inside.part},
                         {"inside_95", summary.inside.interval_95},
                         {"intervals", to_string(coverage.width_of(summary))},
                         {"half_width_10_50_90", summary.half_width}});
  }
  return {{"complete", coverage.complete},
          {"coverage", summaries},
          {"wall_s", provenance.wall_seconds},
          {"provenance", provenance_object(provenance)}};
}

}  // namespace havers::io
