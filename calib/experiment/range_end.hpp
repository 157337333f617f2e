// A channel that has come to the end of its instrument's range.
#pragma once

#include <cstddef>
#include <span>

namespace havers::calib {

/// Rows of a channel from the first to the last of its largest value.
struct RangeEnd {
  std::size_t first = 0;
  std::size_t rows = 0;    ///< 0 where the channel has not come to the end of a range.
  std::size_t before = 0;  ///< As many rows before, or all that there are: it rose in them.
};

/// (X20) Nearly all of the rows, ten or more, show the largest value to the last digit, and those
/// before were rising to it, with a new value in every second row at least.
RangeEnd end_of_range(std::span<const double> values);

}  // namespace havers::calib
