// The numbers of a row, put into the channels of the specimens that stand side by side in it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "io/input_error.hpp"
#include "io/machine/channels.hpp"
#include "io/machine/csv_rows.hpp"
#include "io/machine/number.hpp"

namespace havers::io {

/// One specimen of a file: which of its columns are read, and what was read.
struct SpecimenColumns {
  TestFile file;
  std::vector<Channel> channels;
  std::vector<std::vector<double>> values;  ///< As `channels`, in SI units.
  bool ended = false;                       ///< Its cells were empty in a row.
  bool clock = false;                       ///< Its time was written as that of a clock.
  bool told = false;                        ///< Its gauge has had a reading.
  std::optional<Problem> lost{};            ///< The first cell since then where it has none.
};

/// Reads a cell of the channel, in SI units. A time may also be a clock's, which is in s whatever
/// the column's unit. A number that its unit makes infinite is `too_large`.
Number read_cell(std::string_view cell, char decimal, const Channel& channel);

/// Appends a row to the specimens' values. A specimen that ended before its neighbours has empty
/// cells. What is wrong with the row is added to `problems`; the values are then of no use, as
/// channels may differ in length.
void take_numbers(const Row& row, char decimal, std::span<SpecimenColumns> side_by_side,
                  std::vector<Problem>& problems);

/// The complaint about a cell that is no number.
Problem bad_cell(const TestFile& file, std::size_t line, const Column& column,
                 std::string_view cell, NumberFault fault);

}  // namespace havers::io
