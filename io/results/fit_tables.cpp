// The tables of a fit: one row per term or replicate, in the keys of result.json.
#include "io/results/csv_row.hpp"
#include "io/results/result_files.hpp"
#include "io/results/result_keys.hpp"

namespace havers::io {
namespace {

template <class Item>
std::string table_of(const std::vector<calib::SpecimenResult>& specimens,
                     std::vector<Item> calib::SpecimenResult::*items) {
  CsvTable table;
  for (const calib::SpecimenResult& specimen : specimens)
    // A copy, as keys() needs a value that it could also read into.
    for (Item item : specimen.*items) {
      CsvRow row("specimen", specimen.id);
      keys(row, item);
      table.add(row);
    }
  return table.text;
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

}  // namespace havers::io
