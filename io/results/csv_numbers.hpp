// CSV files of numbers with a header row: written and read back without loss.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace havers::io {

/// The shortest text that reads back as the same number; empty for a number that is not finite. -0
/// is written as 0.
std::string csv_number(double value);

/// A header and rows, comma-separated; `columns` are in the order of the header. Precondition:
/// there is a column, all are of equal length, and no name needs quotes.
std::string csv_text(const std::vector<std::string>& header,
                     const std::vector<std::vector<double>>& columns);

/// The chosen columns of one row; an empty cell is NaN.
struct CsvNumbers {
  std::size_t line = 0;        ///< Of the file, from 1.
  std::vector<double> values;  ///< In the order of the names asked for.
};

/// Reads columns by the names in the header row; other columns may hold anything.
/// @param optional  that many of the names, the last ones: NaN where there is no such column
/// @throws InputError naming missing columns and the lines of cells that are not numbers.
std::vector<CsvNumbers> read_csv_numbers(const std::filesystem::path& file,
                                         const std::vector<std::string>& names,
                                         std::size_t optional = 0);

}  // namespace havers::io
