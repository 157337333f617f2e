// What havers bench SCENE, --stability and --porosity leave. Rows are declared once, as keys, for
// JSON and for CSV.
#include "io/results/bench_files.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/results/csv_row.hpp"
#include "io/results/json_table.hpp"

namespace havers::io {
namespace {

// In the order of the columns; JSON and CSV have the same.
template <class Table>
void keys(Table& table, sim::BenchSetting& setting) {
  // NaN where no step is given, so that the key is still there: empty in CSV, null in JSON.
  double step = setting.step.value_or(NAN);
  table.key("regime", setting.regime);
  table.key("contact", setting.contact);
  table.key("tolerance", setting.tolerance);
  table.key("step_s", step);
  table.key("refinement", setting.refinement);
  table.key("leave_out", setting.leave_out);
  table.key("leap", setting.leap);
}

// The median over the seeds, with the extremes.
template <class Table>
void range_keys(Table& table, const std::string& name, sim::BenchSpread& spread) {
  table.key(name.c_str(), spread.median);
  table.key((name + "_low").c_str(), spread.low);
  table.key((name + "_high").c_str(), spread.high);
}

// What a row is computed with; its numbers, with the extremes of what the figure shows.
template <class Table>
void keys(Table& table, sim::BenchRow& row) {
  keys(table, row.setting);
  range_keys(table, "joint_force_error", row.errors.bonded_forces);
  range_keys(table, "last_common_break_force_error", row.errors.forces);
  range_keys(table, "strength_error", row.errors.strength);
  range_keys(table, "strength_without_ringing_error", row.errors.strength_without_ringing);
  range_keys(table, "failure_strain_error", row.errors.failure_strain);
  range_keys(table, "curve_error", row.errors.curve);
  range_keys(table, "wall_s", row.wall);
  range_keys(table, "cpu_s", row.cpu);
  table.key("steps", row.steps.median);
  table.key("iterations", row.iterations.median);
  table.key("common_breaks", row.same_breaks.median);
  table.key("runs", row.runs);
  table.key("trusted_runs", row.trusted);
  table.key("runs_out_of_time", row.out_of_time);
  table.key("last_strain", row.reached.median);
}

// All but the name; the reason, which may be long, at the end.
template <class Table>
void keys(Table& table, sim::StabilityResult& result) {
  std::string outcome = to_string(result.outcome);
  table.key("outcome", outcome);
  table.key("as_it_must", result.as_it_must);
  table.key("error", result.error);
  table.key("residual", result.residual);
  table.key("energy_defect", result.energy_defect);
  table.key("penetration", result.penetration);
  table.key("wall_s", result.wall);
  table.key("reason", result.reason);
}

// An item with its name, here as an object and below as a row. `item` is a copy, as keys() needs a
// value that it could also read into.
template <class Item>
nlohmann::json object_of(const char* title, const std::string& name, Item item) {
  nlohmann::json object{{title, name}};
  JsonWriter table(object);
  keys(table, item);
  return object;
}

template <class Item>
CsvRow row_of(const char* title, const std::string& name, Item item) {
  CsvRow row(title, name);
  keys(row, item);
  return row;
}

// null where there is no such comparison.
nlohmann::json omissions_json(const std::optional<sim::Omissions>& omissions) {
  if (!omissions) return nullptr;
  return {{"setting", to_string(omissions->setting)},
          {"largest_change", omissions->change},
          {"cpu_ratio", omissions->cpu_ratio},
          {"until_strain", json_of(omissions->until_strain)}};
}

// In the order of PorosityMethod.
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
    rows.push_back(object_of("text", to_string(row.setting), row));
  for (const sim::CheapestSetting& entry : study.cheapest)
    // An entry without a row means that no setting reaches the target.
    cheapest.push_back(
        {{"quantity", entry.quantity},
         {"error_below", entry.target},
         {"reference_error", json_of(entry.reference_error)},
         {"setting", entry.row ? nlohmann::json(to_string(study.rows[*entry.row].setting))
                               : nlohmann::json()}});
  return {{"complete", study.complete},
          {"summary", summary(study)},
          {"reference", study.rows.empty()
                            ? nlohmann::json()
                            : object_of("text", to_string(study.reference), study.reference)},
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
    scenes.push_back(object_of("name", result.name, result));
  return {{"summary", summary(bench)},
          {"complete", bench.complete},
          {"scenes", scenes},
          {"provenance", provenance_object(provenance)}};
}

std::string work_precision_csv(const sim::WorkPrecision& study) {
  // The names come from an empty row, so that they are there even where no row follows.
  std::string text = row_of("setting", "", sim::BenchRow{}).names();
  for (const sim::BenchRow& row : study.rows)
    text += row_of("setting", to_string(row.setting), row).cells();
  return text;
}

std::string stability_csv(const std::vector<sim::StabilityResult>& results) {
  std::string text = row_of("scene", "", sim::StabilityResult{}).names();
  for (const sim::StabilityResult& result : results)
    text += row_of("scene", result.name, result).cells();
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
    // One reading for each method, in the order of PorosityMethod.
    for (std::size_t i = 0; i < trial.readings.size(); ++i) {
      const auto method = static_cast<calib::PorosityMethod>(i);
      CsvRow row("hardship", trial.hardship);
      row.key("ring", trial.ring);
      row.key("pixels", trial.pixels);
      row.key("truth", trial.truth);
      row.key("method", to_string(method));
      row.key("porosity", trial.readings.at(i).porosity);
      row.key("cpu_s", trial.readings.at(i).cpu);
      // Only havers' own method gives a standard error.
      row.key("standard_error", method == calib::PorosityMethod::ours ? trial.standard_error : NAN);
      table.add(row);
    }
  return table.text;
}

}  // namespace havers::io
