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
  std::size_t first_after = 0;  ///< Row of the second.
};

/// Rows at times in [from, to] [s], and the least change within `window` [s] that counts.
struct BreakSearch {
  double window = 0.0, from = 0.0, to = 0.0, least = 0.0;
};

/// The largest change that lasts; nothing where none counts.
std::optional<SeenBreak> find_break(const Signal& signal, const BreakSearch& search);

/// One that nobody takes for anything else: a change by half of the range within `window` [s], for
/// good, and none before it by a fifth.
std::optional<SeenBreak> find_plain_break(const Signal& signal, double window);

}  // namespace havers::calib
