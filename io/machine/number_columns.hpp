// The numbers of a test file, read in one pass.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/input_error.hpp"
#include "io/machine/channels.hpp"
#include "io/machine/csv_rows.hpp"
#include "io/machine/text_source.hpp"

namespace havers::io {

/// The complaint about a quote that is never closed.
InputError open_quote(const std::string& file, std::size_t line);

/// Reads the channels' columns into arrays, converted to SI. Memory is that of the numbers kept.
class NumberColumns {
 public:
  NumberColumns(const TestFile& file, std::size_t first_line, const Dialect& dialect,
                const std::vector<Channel>& channels);

  /// Reads `beginning`, then the rest of the source. @throws InputError with the first few
  /// problems.
  void read(std::string_view beginning, TextSource& source);

  /// The numbers of channel `i`, moved out.
  std::vector<double> take(std::size_t i) { return std::move(values_[i]); }

 private:
  bool take_row(const Row& row);
  void take_cells(const Row& row);
  void check_time(const Row& row);
  void complain(const Row& row, std::string what, std::string hint = {});

  const TestFile& file_;
  std::size_t first_line_;
  Dialect dialect_;
  const std::vector<Channel>& channels_;
  std::vector<std::vector<double>> values_;
  std::vector<Problem> problems_;
};

}  // namespace havers::io
