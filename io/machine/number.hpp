// Numbers as testing machines write them.
#pragma once

#include <string>
#include <string_view>

namespace havers::io {

/// What keeps a cell from being a number that can be used.
enum class NumberFault { none, empty, text, not_finite, too_large };

/// The fault in words, to follow the cell's text: "is not a number", ...
std::string to_string(NumberFault fault);

/// A number, or why there is none: the value counts only without a fault.
struct Number {
  double value = 0.0;
  NumberFault fault = NumberFault::none;
};

/// Reads a number with the given decimal mark ('.' or ','); one too small for a double is 0. The
/// other mark, blanks, no-break blanks and apostrophes may group thousands, three digits a group:
/// `1,004.80328`, `1 000,34`, `1'000.5`.
Number parse_number(std::string_view cell, char decimal = '.');

/// Reads a number that stands alone and tells its decimal mark itself: a single `.` or `,` is the
/// decimal mark, and so is the last where there are both; several of one group thousands.
Number parse_lone_number(std::string_view cell);

/// A time of day or an elapsed time in s: `10:00:01`, `2026-05-01 10:00:01,25`, of a date nothing
/// is taken; `12:01.5`, minutes where the seconds have decimals; `1:00:01 PM`.
Number parse_clock(std::string_view cell);

/// "10:00:01" of "10:00:01 PM"; the whole cell where it names no half of a day.
std::string_view without_half_day(std::string_view cell);

/// Whether the cell is a finite number.
bool is_number(std::string_view cell, char decimal = '.');

}  // namespace havers::io
