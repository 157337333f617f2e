// How many decimals a number with an error is shown with.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace havers::calib {

/// Exponent of ten after rounding to `digits`, so that 9.9996 counts as 10.00. Of a finite value.
inline int exponent_of(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

/// Decimals that show two significant digits of `width`, which is finite; none where it is wide.
inline int decimals_for(double width) {
  return std::max(0, 1 - exponent_of(width, 2));
}

}  // namespace havers::calib
