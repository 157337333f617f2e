// The specimens of a test file, read in one pass.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_error.hpp"
#include "io/machine/number_columns.hpp"
#include "io/machine/preview.hpp"
#include "io/machine/text_source.hpp"

namespace havers::io {

/// The complaint about a quote that is never closed; `line` is where it opens.
InputError open_quote(const std::string& file, std::size_t line);

/// Reads the tables of a file, each with one specimen or several side by side; where a row of text
/// follows the numbers, the next table is looked for. Memory is that of the numbers kept.
class SpecimenTables {
 public:
  /// `common` says what all specimens share: file, encoding, delimiter, decimal mark.
  SpecimenTables(TestFile common, Dialect dialect, const ReadOptions& options);

  /// The next table begins, below the header's rows.
  void begin(const Table& table, std::span<const PreviewRow> header);
  /// Reads `beginning`, then the rest of the source. @throws InputError with the first few
  /// problems.
  void read(std::string_view beginning, TextSource& source);
  /// The specimens, moved out, with channels in their tests. To be called once, after `read`.
  /// @throws InputError when a gauge lacks readings that nothing else tells.
  std::vector<TestFile> take();

 private:
  /// The specimens of the table that is being read.
  std::span<SpecimenColumns> current() { return std::span(specimens_).subspan(current_); }
  /// Reserves memory for a file that is `blocks` times as long as its first block.
  void make_room(double blocks);
  /// False when there are enough problems and no more rows are wanted.
  bool take_row(const Row& row);
  [[nodiscard]] bool begins_header(const Row& row) const;
  void take_header_row(const Row& row);
  [[nodiscard]] bool names_a_specimen(const Table& table) const;
  /// Whether the table is a further page of the specimen before it.
  [[nodiscard]] bool goes_on(const Table& table, const Preview& preview) const;
  /// Decides what the rows held back in `header_` are.
  void end_header();
  /// The same at the end of the file, where these rows may be a text below the last numbers.
  void end_file();
  void take_held_back_numbers(const std::vector<PreviewRow>& rows, std::size_t first_line);

  TestFile common_;
  Dialect dialect_;
  const ReadOptions& options_;              // the caller's, who must keep them
  std::vector<SpecimenColumns> specimens_;  // of all tables so far, in the order of the file
  std::size_t current_ = 0;                 // the first specimen of the table that is being read
  std::size_t first_line_ = 0;              // of its numbers
  std::vector<PreviewRow> header_;          // held back; empty while numbers are read
  std::vector<Problem> problems_;           // of the numbers
};

}  // namespace havers::io
