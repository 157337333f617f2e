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

/// Collects the keys of one row.
class CsvRow {
 public:
  CsvRow(const char* name, const std::string& value) : names_(name), cells_(quoted(value)) {}

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

  [[nodiscard]] std::string names() const { return names_ + "\n"; }
  [[nodiscard]] std::string cells() const { return cells_ + "\n"; }

 private:
  static std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::ostringstream result;
    result << std::quoted(text, '"', '"');
    return result.str();
  }

  std::string names_, cells_;
};

/// Rows below the names of the first.
struct CsvTable {
  std::string text{};

  void add(const CsvRow& row) {
    if (text.empty()) text = row.names();
    text += row.cells();
  }
};

}  // namespace havers::io
