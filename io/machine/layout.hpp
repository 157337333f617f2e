// Where the table of a test file is, and what stands above it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/machine/preview.hpp"

namespace havers::io {

/// A recognised table. Column by column: name and unit, as in the file; the unit may be empty.
struct Table {
  std::string layout;                     ///< "table", "Bluehill raw data" or `results_layout`.
  std::vector<std::string> names, units;  ///< `names` is empty where the file has none.
  std::size_t header_rows = 0;      ///< Rows of the preview above the names: facts of the specimen.
  std::size_t first_line = 0;       ///< Of the numbers, from 1.
  std::size_t first_column = 0;     ///< Of `names`, where specimens stand side by side.
  std::string title;                ///< Name of the specimen, from the row above the names.
  std::vector<std::string> titles;  ///< That row.
  std::string guess;  ///< What the columns may hold by their numbers (`guess_columns`).
};

/// The layout of a table with one row per specimen: results, not raw data.
inline constexpr std::string_view results_layout = "results";

/// The tables of specimens that stand side by side under the same names; the table itself where
/// there is one.
std::vector<Table> side_by_side(const Table& table);

/// Any table of numbers: names above it or not, units in a row, in the names, or absent. A table of
/// results only where no other follows.
std::optional<Table> recognise_table(const Preview& preview);

}  // namespace havers::io
