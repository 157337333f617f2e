// The tables of a fit: one row per term or replicate, in the keys of result.json.
#include <fmt/format.h>

#include <iomanip>
#include <sstream>

#include "io/results/csv_numbers.hpp"
#include "io/results/json_table.hpp"
#include "io/results/result_files.hpp"
#include "io/results/result_keys.hpp"

namespace havers::io {
namespace {

/// Collects the keys of one row.
class CsvRow {
 public:
  CsvRow(const char* name, const std::string& value) : names_(name), cells_(quoted(value)) {}

  template <class T>
  void key(const char* name, T& value) {
    names_ += fmt::format(",{}", name);
    cells_ += ',';
    if constexpr (std::is_same_v<T, double>)
      cells_ += csv_number(value);
    else if constexpr (std::is_same_v<T, std::string>)
      cells_ += quoted(value);
    else
      cells_ += fmt::format("{:d}", value);
  }

  [[nodiscard]] std::string names() const { return names_ + "\n"; }
  [[nodiscard]] std::string cells() const { return cells_ + "\n"; }

 private:
  static std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::ostringstream result;
    result << std::quoted(text, '"', '"');
    return result.str();
  }

  std::string names_, cells_;
};

template <class Item>
std::string table_of(const std::vector<calib::SpecimenResult>& specimens,
                     std::vector<Item> calib::SpecimenResult::*items) {
  std::string text;
  for (const calib::SpecimenResult& specimen : specimens)
    for (Item item : specimen.*items) {
      CsvRow row("specimen", specimen.id);
      keys(row, item);
      if (text.empty()) text = row.names();
      text += row.cells();
    }
  return text;
}

}  // namespace

void write_terms(const std::filesystem::path& file,
                 const std::vector<calib::SpecimenResult>& specimens) {
  write_file(file, table_of(specimens, &calib::SpecimenResult::terms));
}

void write_replicates(const std::filesystem::path& file,
                      const std::vector<calib::SpecimenResult>& specimens) {
  write_file(file, table_of(specimens, &calib::SpecimenResult::replicates));
}

std::string chains_csv(const calib::ChainBenchmark& benchmark) {
  std::string text;
  for (calib::ChainRow one : benchmark.rows) {
    CsvRow row("chain", one.chain);
    row.key("study", one.study);
    row.key("error", one.error);
    row.key("cost", one.cost);
    row.key("informed", one.informed);
    row.key("simulations", one.simulations);
    row.key("wall_s", one.seconds);
    row.key("success", one.success);
    if (text.empty()) text = row.names();
    text += row.cells();
  }
  return text;
}

nlohmann::json chains_json(const calib::ChainBenchmark& benchmark, const Provenance& provenance) {
  nlohmann::json chains = nlohmann::json::array();
  for (const calib::ChainSummary& summary : benchmark.summaries)
    chains.push_back({{"chain", summary.chain},
                      {"error_10_50_90", summary.error},
                      {"simulations_10_50_90", summary.simulations},
                      {"wall_s_10_50_90", summary.seconds},
                      {"success", summary.success},
                      {"success_95", summary.success_95}});
  Provenance origin = provenance;
  return {{"chains", chains},
          {"fits", benchmark.rows.size()},
          {"wall_s", provenance.wall_seconds},
          {"provenance", json_of(origin)}};
}

}  // namespace havers::io
