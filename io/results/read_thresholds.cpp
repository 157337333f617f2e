#include <fmt/format.h>

#include <cmath>

#include "io/input_error.hpp"
#include "io/results/csv_numbers.hpp"
#include "io/results/result_files.hpp"

namespace havers::io {

// Rows may come in any order; the joints must be 0 to n - 1, each once. Scene::problems() asks
// whether the assembly has as many.
GivenThresholds read_thresholds(const std::filesystem::path& file) {
  const std::vector<std::string> names{"joint", "f_N", "f_T", "length_m"};
  const std::vector<CsvNumbers> rows = read_csv_numbers(file, names, 1);
  if (rows.empty())
    throw InputError(file.string(), "holds no joint", "give a row for each, as in joints.csv");
  GivenThresholds given;
  given.thresholds.resize(rows.size());
  given.lengths.resize(rows.size());
  std::vector<std::size_t> line_of(rows.size(), 0);  // where each joint was named; 0: not yet
  std::vector<Problem> problems;
  const auto complain = [&](std::size_t line, std::string what) {
    problems.push_back({at_line(file.string(), line), std::move(what), ""});
  };
  for (const CsvNumbers& row : rows) {
    const double joint = row.values[0];
    for (std::size_t i = 0; i < 3; ++i)
      if (std::isnan(row.values[i]))
        complain(row.line, fmt::format("column {} is empty, must be a number", names[i]));
    // An empty number of a joint was said above.
    if (std::isnan(joint)) continue;
    if (!(joint >= 0.0 && joint < static_cast<double>(rows.size()) && joint == std::floor(joint))) {
      complain(row.line,
               fmt::format("joint is {}, must be a whole number from 0 to {}, as many as rows",
                           joint, rows.size() - 1));
      continue;
    }
    const auto index = static_cast<std::size_t>(joint);
    if (line_of[index] != 0)
      complain(row.line, fmt::format("names joint {} again, after line {}", index, line_of[index]));
    line_of[index] = row.line;
    given.thresholds[index] = {.normal = row.values[1], .tangent = row.values[2]};
    given.lengths[index] = row.values[3];
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return given;
}

}  // namespace havers::io
