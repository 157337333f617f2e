#include "io/sweep/sweep_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>

#include "io/input_error.hpp"
#include "io/read_text.hpp"
#include "io/results/csv_row.hpp"
#include "io/results/json_table.hpp"
#include "io/sweep/sweep_keys.hpp"

namespace havers::io {
namespace {

using calib::Measure;

// A row with the columns that both tables begin with: point, level, and the keys of the sweep.
CsvRow row_of(const calib::Sweep& sweep, const calib::SweepPoint& point, std::size_t index) {
  CsvRow row("point", std::to_string(index));
  row.key("level", point.level);
  for (std::size_t k = 0; k < point.values.size(); ++k)
    row.key(sweep.plan.keys[k].name.c_str(), point.values[k]);
  return row;
}

// A number, a truth value or a list, as far as JSON writes it like TOML; anything else is a word.
nlohmann::json json_of_value(const std::string& value) {
  nlohmann::json json = nlohmann::json::parse(value, nullptr, false);
  return json.is_discarded() ? nlohmann::json(value) : json;
}

}  // namespace

std::string name_of(Measure m) {
  const bool stress = m == Measure::strength || m == Measure::modulus;
  return fmt::format("{}{}", word(m), stress ? "_Pa" : "");
}

std::string runs_csv(const calib::Sweep& sweep, const calib::SweepResult& result) {
  // All rows have the same columns: a measure that no point tells has none.
  const std::vector<Measure> known = result.known();
  CsvTable table;
  // In the order of points and seeds.
  for (const calib::SweepRun& run : result.runs) {
    CsvRow row = row_of(sweep, result.points[run.point], run.point);
    row.key("seed", run.seed);
    row.key("outcome", std::string(run.failed ? "failed" : run.broke ? "broken" : "unbroken"));
    for (const Measure m : known) row.key(name_of(m).c_str(), run[m]);
    row.key("why", run.why);
    table.add(row);
  }
  return table.text;
}

std::string summary_csv(const calib::Sweep& sweep, const calib::SweepResult& result) {
  CsvTable table;
  for (std::size_t point = 0; point < result.points.size(); ++point)
    for (const Measure m : calib::all_measures) {
      const calib::Statistics& s = result.summaries[point][m];
      CsvRow row = row_of(sweep, result.points[point], point);
      row.key("inertia_number", result.points[point].inertia_number);
      row.key("measure", name_of(m));
      row.key("n", s.n);
      row.key("mean", s.mean);
      row.key("sd", s.sd);
      row.key("standard_error", s.standard_error());
      if (table.text.empty()) table.text = row.names();  // also where all runs failed
      if (s.n > 0) table.add(row);
    }
  return table.text;
}

nlohmann::json laws_json(const calib::SweepResult& result) {
  return {{"form",
           "response = sum of coefficients[i] * terms[i] + coefficients.back(); the "
           "terms as in a scene file, the response in SI units"},
          {"laws", json_of(result.laws)}};
}

std::vector<calib::SweepLaw> read_laws(const std::filesystem::path& file) {
  const char* const advice = "name the laws.json of a sweep";
  const auto json = nlohmann::json::parse(read_text(file, advice), nullptr, false);
  std::vector<calib::SweepLaw> laws;
  try {
    for (const nlohmann::json& one : json.at("laws")) {
      calib::Law law;
      JsonReader table(one);
      keys(table, law);
      const calib::LawRequest& asked = law.request;
      const bool known = std::ranges::all_of(asked.terms, [](const std::string& term) {
        return term == "joints.scatter" || term == "joints.ratio";
      });
      // Only laws that a specimen can be put into: of one, orientation, scatter and ratio are
      // known, but nothing else that a sweep may vary.
      const bool somewhere = asked.per.empty() || asked.per == "assembly.orientation_deg" ||
                             asked.per == "joints.ratio";
      // Others are passed over: a sweep may have laws of anything.
      if (asked.response == Measure::strength && law.status == calib::LawStatus::fitted && known &&
          somewhere && law.coefficients.size() == asked.terms.size() + 1)
        laws.push_back({asked.per, asked.per.empty() ? 0.0 : std::stod(law.at), asked.terms,
                        law.coefficients});
    }
  } catch (const std::exception&) {
    // From nlohmann::json or std::stod: whatever is wrong, it is no such file.
    throw InputError(file.string(), "is no file of laws", advice);
  }
  if (laws.empty())
    throw InputError(
        file.string(),
        "has no law of strength in joints.scatter or joints.ratio, per orientation, per "
        "ratio or for all",
        R"(ask for one in the sweep file: [[law]] response = "strength")");
  return laws;
}

nlohmann::json sweep_json(const calib::Sweep& sweep, const calib::SweepResult& result) {
  nlohmann::json points = nlohmann::json::array();
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const calib::SweepPoint& point = result.points[i];
    const calib::PointSummary& summary = result.summaries[i];
    nlohmann::json values, measures;
    for (std::size_t k = 0; k < point.values.size(); ++k)
      values[sweep.plan.keys[k].name] = json_of_value(point.values[k]);
    for (const Measure m : calib::all_measures) {
      const calib::Statistics& s = summary[m];
      if (s.n > 0)
        measures[name_of(m)] = {{"n", s.n},
                                {"mean", json_of(s.mean)},
                                {"sd", json_of(s.sd)},
                                {"standard_error", json_of(s.standard_error())}};
    }
    const calib::StrengthLaw& strength = result.strengths[i];
    points.push_back({{"level", point.level},
                      {"keys", values},
                      {"inertia_number", point.inertia_number},
                      {"runs", summary.runs},
                      {"failed", summary.failed},
                      {"unbroken", summary.unbroken},
                      {"with_reservation", summary.reserved},
                      {"measures", measures},
                      {"strength_law", strength.runs > 0 ? json_of(strength) : nlohmann::json()}});
  }
  return {{"name", sweep.name},
          {"trusted", result.trusted()},
          {"points", points},
          {"laws", json_of(result.laws)},
          {"findings", json_of(result.findings)},
          {"evaluations", result.runs.size()},
          {"simulated", result.simulated},
          {"failed_simulations", result.failed},
          {"most_failed_because", result.most_failed_because},
          {"most_reserved_because", result.most_reserved_because},
          {"scene", scene_json(sweep.points.front().scene)}};
}

}  // namespace havers::io
