#include "io/results/bench_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/results/csv_row.hpp"
#include "io/results/json_table.hpp"

namespace havers::io {
namespace {

// Names with values, in the order of the columns; JSON and CSV have the same.
using Cells = std::vector<std::pair<std::string, nlohmann::json>>;

Cells setting_cells(const sim::BenchSetting& setting) {
  return {{"regime", word(setting.regime)},   {"contact", word(setting.contact)},
          {"tolerance", setting.tolerance},   {"step_s", json_of(setting.step)},
          {"refinement", setting.refinement}, {"leave_out", setting.leave_out}};
}

// What a row is computed with; its numbers, the median over the seeds, with the extremes of what
// the figure shows.
Cells row_cells(const sim::BenchRow& row) {
  Cells cells = setting_cells(row.setting);
  const auto add_range = [&](const std::string& name, sim::BenchSpread spread) {
    cells.insert(cells.end(), {{name, json_of(spread.median)},
                               {name + "_low", json_of(spread.low)},
                               {name + "_high", json_of(spread.high)}});
  };
  add_range("joint_force_error", row.errors.bonded_forces);
  add_range("last_common_break_force_error", row.errors.forces);
  add_range("strength_error", row.errors.strength);
  add_range("failure_strain_error", row.errors.failure_strain);
  add_range("curve_error", row.errors.curve);
  add_range("wall_s", row.wall);
  add_range("cpu_s", row.cpu);
  const auto add = [&](const char* name, double value) {
    cells.emplace_back(name, json_of(value));
  };
  add("steps", row.steps.median);
  add("iterations", row.iterations.median);
  add("common_breaks", row.same_breaks.median);
  add("runs", row.runs);
  add("trusted_runs", row.trusted);
  add("runs_out_of_time", row.out_of_time);
  add("last_strain", row.reached.median);
  return cells;
}

nlohmann::json object_of(const Cells::value_type& first, const Cells& cells) {
  nlohmann::json object{{first.first, first.second}};
  for (const auto& [name, value] : cells) object[name] = value;
  return object;
}

nlohmann::json omissions_json(const std::optional<sim::Omissions>& omissions) {
  if (!omissions) return nullptr;
  return {{"setting", to_string(omissions->setting)},
          {"largest_change", omissions->change},
          {"cpu_ratio", omissions->cpu_ratio},
          {"until_strain", json_of(omissions->until_strain)}};
}

void add_cell(CsvRow& row, const std::string& name, const nlohmann::json& value) {
  if (value.is_string())
    row.key(name.c_str(), value.get<std::string>());
  else if (value.is_boolean())
    row.key(name.c_str(), value.get<bool>());
  else
    row.key(name.c_str(), value.is_null() ? NAN : value.get<double>());
}

// All but the name; the reason, which may be long, at the end.
Cells stability_cells(const sim::StabilityResult& result) {
  return {{"outcome", to_string(result.outcome)},
          {"as_it_must", result.as_it_must},
          {"error", json_of(result.error)},
          {"residual", json_of(result.residual)},
          {"energy_defect", json_of(result.energy_defect)},
          {"penetration", json_of(result.penetration)},
          {"wall_s", json_of(result.wall)},
          {"reason", result.reason}};
}

CsvRow row_of(const sim::BenchRow& one) {
  CsvRow row("setting", to_string(one.setting));
  for (const auto& [name, value] : row_cells(one)) add_cell(row, name, value);
  return row;
}

CsvRow row_of(const sim::StabilityResult& result) {
  CsvRow row("scene", result.name);
  for (const auto& [name, value] : stability_cells(result)) add_cell(row, name, value);
  return row;
}

nlohmann::json summaries_of(
    const std::array<calib::MethodSummary, calib::porosity_methods>& methods) {
  nlohmann::json all = nlohmann::json::array();
  for (const calib::MethodSummary& method : methods)
    all.push_back({{"method", to_string(method.method)},
                   {"median_error", method.median_error},
                   {"worst_error", method.worst_error},
                   {"worst_error_without_pores", method.worst_if_none},
                   {"megapixels_per_second", 1e-6 / method.cpu_per_pixel}});
  return all;
}

}  // namespace

nlohmann::json work_precision_json(const sim::Scene& scene, const sim::WorkPrecision& study,
                                   const calib::Provenance& provenance) {
  nlohmann::json rows = nlohmann::json::array(), cheapest = nlohmann::json::array();
  for (const sim::BenchRow& row : study.rows)
    rows.push_back(object_of({"text", to_string(row.setting)}, row_cells(row)));
  for (const sim::CheapestSetting& entry : study.cheapest)
    cheapest.push_back(
        {{"quantity", entry.quantity},
         {"error_below", entry.target},
         {"reference_error", json_of(entry.reference_error)},
         {"setting", entry.row ? nlohmann::json(to_string(study.rows[*entry.row].setting))
                               : nlohmann::json()}});
  return {{"complete", study.complete},
          {"summary", summary(study)},
          {"reference",
           object_of({"text", to_string(study.reference)}, setting_cells(study.reference))},
          {"reference_ground", study.reference_ground},
          {"joint_forces_at_strain", study.bonded_strain},
          {"seeds", study.seeds},
          {"cheapest", cheapest},
          {"omissions", omissions_json(study.omissions)},
          {"rows", rows},
          {"scene", scene_json(scene)},
          {"provenance", provenance_object(provenance)}};
}

nlohmann::json stability_json(const sim::StabilityBench& bench,
                              const calib::Provenance& provenance) {
  nlohmann::json scenes = nlohmann::json::array();
  for (const sim::StabilityResult& result : bench.scenes)
    scenes.push_back(object_of({"name", result.name}, stability_cells(result)));
  return {{"summary", summary(bench)},
          {"complete", bench.complete},
          {"scenes", scenes},
          {"provenance", provenance_object(provenance)}};
}

std::string work_precision_csv(const sim::WorkPrecision& study) {
  std::string text = row_of(sim::BenchRow{}).names();
  for (const sim::BenchRow& row : study.rows) text += row_of(row).cells();
  return text;
}

std::string stability_csv(const std::vector<sim::StabilityResult>& results) {
  std::string text = row_of(sim::StabilityResult{}).names();
  for (const sim::StabilityResult& result : results) text += row_of(result).cells();
  return text;
}

nlohmann::json methods_json(const calib::MethodComparison& comparison,
                            const calib::Provenance& provenance) {
  nlohmann::json hardships;
  for (const auto& [hardship, methods] : comparison.hardships)
    hardships.push_back({{"hardship", hardship}, {"methods", summaries_of(methods)}});
  return {{"complete", comparison.complete},
          {"sections", comparison.trials.size()},
          {"methods", summaries_of(comparison.methods)},
          {"hardships", hardships},
          {"provenance", provenance_object(provenance)}};
}

std::string methods_csv(const calib::MethodComparison& comparison) {
  CsvTable table;
  for (const calib::PorosityTrial& trial : comparison.trials)
    for (std::size_t i = 0; i < trial.readings.size(); ++i) {
      const auto method = static_cast<calib::PorosityMethod>(i);
      CsvRow row("hardship", trial.hardship);
      row.key("ring", trial.ring);
      row.key("pixels", trial.pixels);
      row.key("truth", trial.truth);
      row.key("method", to_string(method));
      row.key("porosity", trial.readings.at(i).porosity);
      row.key("cpu_s", trial.readings.at(i).cpu);
      row.key("standard_error", method == calib::PorosityMethod::ours ? trial.standard_error : NAN);
      table.add(row);
    }
  return table.text;
}

}  // namespace havers::io
