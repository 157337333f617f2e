// The beginning of a test file, cut into cells.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/machine/csv_rows.hpp"

namespace havers::io {

/// How the cells of a file are separated and its numbers written.
struct Dialect {
  char delimiter = ',';
  char decimal = '.';
  bool requoted = false;                    ///< A spreadsheet has quoted whole lines.
  std::vector<std::size_t> text_columns{};  ///< Of text beside the numbers, in order; from 0.
};

/// Like `Row`, but it owns its cells.
struct PreviewRow {
  std::size_t line = 0;  ///< From 1.
  std::vector<std::string> cells;
};

/// What the layout of a file is found from.
struct Preview {
  Dialect dialect;
  std::vector<PreviewRow> rows;     ///< Without the blank ones.
  std::size_t open_quote_line = 0;  ///< Of a quote that is never closed; 0 where there is none.
};

/// Rows as the dialect cuts them, handed to `take`; false from it ends the reading.
CsvRows rows_of(const Dialect& dialect, std::function<bool(const Row&)> take);

/// Cuts the first lines of `text` with the delimiter and decimal mark that make the most rows of
/// numbers; columns of text are allowed for where there are no such rows without.
Preview make_preview(std::string_view text);

/// Whether the row holds two numbers or more, of which one may be a clock's time, and no text but
/// in the columns of text.
bool is_number_row(const PreviewRow& row, const Dialect& dialect);

/// The text that keeps a row with two numbers or more from being one of numbers; null where there
/// is none.
const std::string* text_among_numbers(const PreviewRow& row, char decimal);

}  // namespace havers::io
