// The break as a recorder saw it: the one instant that two clocks are sure to share.
#pragma once

#include <optional>

#include "calib/experiment/clocks.hpp"

namespace havers::calib {

/// A jump of the signal, somewhere between two rows.
struct SeenBreak {
  double time = 0.0;            ///< Middle of the two. [s]
  double standard_error = 0.0;  ///< Of any instant between them. [s]
  std::size_t rows_before = 0;  ///< Rows up to the first of the two.
};

/// The largest change within `window` [s] that lasts, of rows at times in [from, to] [s]; nothing
/// where none is a fifth of the signal's range.
std::optional<SeenBreak> find_break(const Signal& signal, double window, double from, double to);

}  // namespace havers::calib
