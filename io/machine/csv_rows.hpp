// Rows of a delimited text, with their line numbers (libcsv inside).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>

namespace havers::io {

/// One row. Cells are without quotes and outer blanks; they live until the callback returns.
struct Row {
  std::size_t line = 0;  ///< Where it begins, from 1.
  std::span<const std::string_view> cells;
};

/// Cuts blocks of text into rows. Line ends LF, CRLF, CR and CR CR LF; quotes may span lines. Blank
/// lines are counted but not handed on.
class CsvRows {
 public:
  struct State;  ///< What libcsv's callbacks share.
  /// `take` is called once per row; false: no more rows are wanted.
  CsvRows(char delimiter, std::function<bool(const Row&)> take);
  ~CsvRows();
  CsvRows(const CsvRows&) = delete;
  CsvRows& operator=(const CsvRows&) = delete;
  CsvRows(CsvRows&&) = delete;
  CsvRows& operator=(CsvRows&&) = delete;

  /// Takes the next block, which may end anywhere; false when no more is wanted, or a quote has
  /// swallowed more than a megabyte. The first block tells which line end the file has.
  bool feed(std::string_view block);
  /// Hands on the last row, which may lack its line end. To be called once, after the last block.
  void finish();
  /// Line of a quote that is still open, or has swallowed more than a megabyte; 0 where there is
  /// none.
  [[nodiscard]] std::size_t open_quote_line() const;

 private:
  std::unique_ptr<State> state_;
};

/// A `take` for lines that a spreadsheet has quoted as a whole, `"a,""1.0"",mm"`: cut them with
/// `no_delimiter`, and this cuts them again.
std::function<bool(const Row&)> requoted(char delimiter, std::function<bool(const Row&)> take);
/// A control character, which files of text do not have.
inline constexpr char no_delimiter = '\x1F';

}  // namespace havers::io
