// The result of a fit and its curves, written and read back: result.json holds all but the curves,
// which are in a CSV file for each specimen.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "io/input_error.hpp"
#include "io/results/csv_numbers.hpp"
#include "io/results/json_table.hpp"
#include "io/results/result_files.hpp"
#include "io/results/result_keys.hpp"

namespace havers::io {
namespace {

const std::vector<std::string> band_columns{
    "strain",     "measured_Pa", "simulated_median_Pa", "simulated_lower_Pa", "simulated_upper_Pa",
    "residual_Pa"};
const std::vector<std::string> measured_columns{"strain", "stress_Pa"};

// Column by column, in the order of the names.
std::vector<std::vector<double>> read_columns(const std::filesystem::path& file,
                                              const std::vector<std::string>& names) {
  std::vector<std::vector<double>> columns(names.size());
  for (const CsvNumbers& row : read_csv_numbers(file, names))
    for (std::size_t i = 0; i < names.size(); ++i) columns[i].push_back(row.values[i]);
  return columns;
}

// The file's columns are in the order of band_columns, not in that of the members.
calib::CurveBand read_band(const std::filesystem::path& file) {
  std::vector<std::vector<double>> columns = read_columns(file, band_columns);
  return {.strain = columns[0],
          .median = columns[2],
          .lower = columns[3],
          .upper = columns[4],
          .measured = columns[1],
          .residual = columns[5]};
}

// Refuses, in this order, a file that is not there, is not JSON, or is not of a fit.
nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw InputError(file.string(), "is not there", "name a fit's folder or its result.json");
  nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  if (json.is_discarded())
    throw InputError(file.string(), "is not JSON", "name a fit's folder or its result.json");
  if (!json.is_object() || !json.contains("verdict") || !json.contains("study"))
    throw InputError(file.string(), "is not the result of a fit",
                     "havers fit STUDY.toml -o DIR writes one; the page of another run is in its "
                     "folder");
  return json;
}

// Reads what `calibration_json` wrote. A value of another type throws; an absent key does not.
FitFolder fit_of(const nlohmann::json& json) {
  FitFolder fit;
  JsonReader table(json);
  keys(table, fit.result);
  table.key("study", fit.study);
  table.key("provenance", fit.provenance);
  return fit;
}

[[noreturn]] void refuse_result(const std::filesystem::path& file) {
  throw InputError(file.string(), "lacks what the result of a fit has, or has it otherwise",
                   "run the fit again with this version of havers");
}

// Whether lists that belong together are as long as each other, and parameters have names.
bool is_whole(const calib::CalibrationResult& result) {
  const std::size_t fitted = result.fitted.size();
  const auto has_a_name = [](const auto& parameter) { return !parameter.name.empty(); };
  return std::ranges::all_of(result.parameters, has_a_name) &&
         (result.correlation.empty() || result.correlation.size() == fitted);
}

void read_curves(const std::filesystem::path& folder, calib::SpecimenResult& specimen) {
  specimen.band = read_band(folder / band_file(specimen.id));
  std::vector<std::vector<double>> measured =
      read_columns(folder / measured_file(specimen.id), measured_columns);
  specimen.measured.strain = std::move(measured[0]);
  specimen.measured.stress = std::move(measured[1]);
}

}  // namespace

nlohmann::json calibration_json(const calib::Study& study, const calib::CalibrationResult& result,
                                const calib::Provenance& provenance) {
  // The keys of the result, and beside them what follows from it, for users.
  nlohmann::json json = json_of(result);
  json["status_text"] = calib::explain(result.status);
  json["trusted"] = result.trusted();
  json["wall_s"] = provenance.wall_seconds;
  json["scene"] = scene_json(result.scene);
  json["study"] = json_of(study);
  json["provenance"] = provenance_object(provenance);
  return json;
}

std::string band_file(const std::string& id) {
  return fmt::format("curves/{}.csv", id);
}
std::string measured_file(const std::string& id) {
  return fmt::format("curves/{}_measured.csv", id);
}

void write_band(const std::filesystem::path& file, const calib::CurveBand& band) {
  write_file(file, csv_text(band_columns, {band.strain, band.measured, band.median, band.lower,
                                           band.upper, band.residual}));
}

void write_measured(const std::filesystem::path& file, const calib::MeasuredTest& test) {
  write_file(file, csv_text(measured_columns, {test.strain, test.stress}));
}

FitFolder read_fit_folder(const std::filesystem::path& folder_or_result) {
  const bool is_folder = std::filesystem::is_directory(folder_or_result);
  const std::filesystem::path file =
      is_folder ? folder_or_result / "result.json" : folder_or_result;
  const std::filesystem::path folder = file.parent_path();
  FitFolder fit;
  try {
    fit = fit_of(read_json(file));
  } catch (const nlohmann::json::exception&) {
    refuse_result(file);
  }
  if (!is_whole(fit.result)) refuse_result(file);
  // Said once of the folder, and not of each file in it.
  if (!fit.result.specimens.empty() && !std::filesystem::exists(folder / "curves"))
    throw InputError(file.string(), "has no curves beside it",
                     "leave it in the fit's folder, or copy curves with it");
  for (calib::SpecimenResult& specimen : fit.result.specimens) read_curves(folder, specimen);
  // A test is written only with the specimen's result; the study's specimen gets a copy.
  for (calib::Specimen& specimen : fit.study.specimens) {
    const auto found =
        std::ranges::find(fit.result.specimens, specimen.id, &calib::SpecimenResult::id);
    if (found != fit.result.specimens.end()) specimen.test = found->measured;
  }
  return fit;
}

}  // namespace havers::io
