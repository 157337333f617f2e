#include "io/sweep/sweep_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/input_error.hpp"
#include "io/results/csv_numbers.hpp"
#include "io/results/json_table.hpp"
#include "io/sweep/sweep_keys.hpp"

namespace havers::io {
namespace {

using calib::Measure;

// TOML texts keep their quotes, which hold a comma together in CSV as well.
std::string point_cells(const calib::SweepPoint& point, std::size_t index) {
  std::string cells = fmt::format("{},{}", index, point.level);
  for (const std::string& value : point.values) cells += "," + value;
  return cells;
}

std::string point_header(const calib::Sweep& sweep) {
  std::string header = "point,level";
  for (const calib::SweepKey& key : sweep.plan.keys) header += "," + key.name;
  return header;
}

}  // namespace

std::string name_of(Measure m) {
  const bool stress = m == Measure::strength || m == Measure::modulus;
  return fmt::format("{}{}", word(m), stress ? "_Pa" : "");
}

std::string runs_csv(const calib::Sweep& sweep, const calib::SweepResult& result) {
  const std::vector<Measure> known = result.known();
  std::string text = point_header(sweep) + ",seed,outcome";
  for (const Measure m : known) text += fmt::format(",{}", name_of(m));
  text += '\n';
  for (const calib::SweepRun& run : result.runs) {
    const std::string_view outcome = run.failed ? "failed" : run.broke ? "broken" : "unbroken";
    text += fmt::format("{},{},{}", point_cells(result.points[run.point], run.point), run.seed,
                        outcome);
    for (const Measure m : known) text += fmt::format(",{}", csv_number(run[m]));
    text += '\n';
  }
  return text;
}

std::string summary_csv(const calib::Sweep& sweep, const calib::SweepResult& result) {
  std::string text = point_header(sweep) + ",inertia_number,measure,n,mean,sd,standard_error\n";
  for (std::size_t point = 0; point < result.points.size(); ++point)
    for (const Measure m : calib::all_measures) {
      const calib::Statistics& s = result.summaries[point][m];
      if (s.n == 0) continue;
      text += fmt::format("{},{},{},{},{},{},{}\n", point_cells(result.points[point], point),
                          csv_number(result.points[point].inertia_number), name_of(m), s.n,
                          csv_number(s.mean), csv_number(s.sd), csv_number(s.standard_error()));
    }
  return text;
}

nlohmann::json laws_json(const calib::SweepResult& result) {
  std::vector<calib::Law> laws = result.laws;
  return {{"form",
           "response = sum of coefficients[i] * terms[i] + coefficients.back(); the "
           "terms as in a scene file, the response in SI units"},
          {"laws", json_of(laws)}};
}

std::vector<calib::SweepLaw> read_laws(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
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
      const bool somewhere = asked.per.empty() || asked.per == "assembly.orientation_deg" ||
                             asked.per == "joints.ratio";
      if (asked.response == Measure::strength && law.status == calib::LawStatus::fitted && known &&
          somewhere && law.coefficients.size() == asked.terms.size() + 1)
        laws.push_back({asked.per, asked.per.empty() ? 0.0 : std::stod(law.at), asked.terms,
                        law.coefficients});
    }
  } catch (const std::exception&) {
    throw InputError(file.string(), "is no file of laws", "name the laws.json of a sweep");
  }
  if (laws.empty())
    throw InputError(file.string(), "has no law of strength in joints.scatter or joints.ratio",
                     "ask for one in the sweep file: [[law]] response = \"strength\"");
  return laws;
}

nlohmann::json sweep_json(const calib::Sweep& sweep, const calib::SweepResult& result) {
  nlohmann::json points = nlohmann::json::array();
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const calib::SweepPoint& point = result.points[i];
    const calib::PointSummary& summary = result.summaries[i];
    nlohmann::json values, measures;
    for (std::size_t k = 0; k < point.values.size(); ++k)
      values[sweep.plan.keys[k].name] =
          point.values[k].front() == '"' || point.values[k].front() == '\''
              ? nlohmann::json(point.values[k].substr(1, point.values[k].size() - 2))
              : nlohmann::json::parse(point.values[k], nullptr, false);
    for (const Measure m : calib::all_measures) {
      const calib::Statistics& s = summary[m];
      if (s.n > 0)
        measures[name_of(m)] = {{"n", s.n},
                                {"mean", json_of(s.mean)},
                                {"sd", json_of(s.sd)},
                                {"standard_error", json_of(s.standard_error())}};
    }
    calib::StrengthLaw strength = result.strengths[i];
    points.push_back({{"level", point.level},
                      {"keys", values},
                      {"inertia_number", point.inertia_number},
                      {"runs", summary.runs},
                      {"failed", summary.failed},
                      {"unbroken", summary.unbroken},
                      {"measures", measures},
                      {"strength_law", json_of(strength)}});
  }
  std::vector<calib::Law> laws = result.laws;
  std::vector<calib::Finding> findings = result.findings;
  return {{"name", sweep.name},
          {"trusted", result.trusted()},
          {"points", points},
          {"laws", json_of(laws)},
          {"findings", json_of(findings)},
          {"evaluations", result.runs.size()},
          {"simulated", result.simulated},
          {"failed_simulations", result.failed},
          {"most_failed_because", result.most_failed_because},
          {"scene", scene_json(sweep.points.front().scene)}};
}

}  // namespace havers::io
