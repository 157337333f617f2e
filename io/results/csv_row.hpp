// Rows of a table whose columns are named by the keys of its items.
#pragma once

#include <fmt/format.h>

#include <iomanip>
#include <sstream>
#include <string>
#include <type_traits>

#include "io/config/words.hpp"
#include "io/results/csv_numbers.hpp"

namespace havers::io {

/// Collects the keys of one row. It serves as `Table` for keys() without units, so that the columns
/// have the names of the JSON.
class CsvRow {
 public:
  /// The first column, which tells what the row is about.
  CsvRow(const char* name, const std::string& value) : names_(name), cells_(quoted(value)) {}

  /// One more column: a number as `csv_number` writes it, a text in quotes where it needs them, the
  /// word of an enumeration, a whole number, or 1 and 0 for true and false.
  template <class T>
  void key(const char* name, const T& value) {
    names_ += fmt::format(",{}", name);
    cells_ += ',';
    if constexpr (std::is_same_v<T, double>)
      cells_ += csv_number(value);
    else if constexpr (std::is_same_v<T, std::string>)
      cells_ += quoted(value);
    else if constexpr (Worded<T>)
      cells_ += word(value);
    else
      cells_ += fmt::format("{:d}", value);
  }

  /// The header and the row, each with its line end.
  [[nodiscard]] std::string names() const { return names_ + "\n"; }
  [[nodiscard]] std::string cells() const { return cells_ + "\n"; }

 private:
  /// Quotes inside are doubled, as libcsv reads them.
  static std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::ostringstream result;
    result << std::quoted(text, '"', '"');
    return result.str();
  }

  std::string names_, cells_;
};

/// Rows below the names of the first; empty without rows. All rows must have the same keys.
struct CsvTable {
  std::string text{};

  void add(const CsvRow& row) {
    if (text.empty()) text = row.names();
    text += row.cells();
  }
};

}  // namespace havers::io
