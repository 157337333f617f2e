#include "calib/experiment/range_end.hpp"

#include <algorithm>
#include <cmath>

namespace havers::calib {

RangeEnd end_of_range(std::span<const double> values) {
  constexpr std::size_t fewest = 10;
  constexpr double nearly_all = 0.8, steps = 20.0, least_rise = 0.01;
  const auto top = std::ranges::max_element(values);
  const auto first = static_cast<std::size_t>(top - values.begin());
  std::size_t last = first, alike = 0;
  for (std::size_t row = first; row < values.size(); ++row) {
    if (values[row] != *top) continue;
    ++alike;
    last = row;
  }
  const std::size_t rows = last - first + 1, before = std::min(rows, first);
  if (before < fewest || static_cast<double>(alike) < nearly_all * static_cast<double>(rows))
    return {};
  double step = *top;  // the smallest that the record shows
  std::size_t changes = 0;
  for (std::size_t row = 1; row <= first; ++row) {
    const double change = std::abs(values[row] - values[row - 1]);
    if (change == 0.0) continue;
    step = std::min(step, change);
    if (row + before > first) ++changes;
  }
  // An instrument that renews its value every so many rows holds each of them as long.
  if (2 * changes < before) return {};
  const bool rising = *top - values[first - before] > std::max(steps * step, least_rise * *top);
  return rising ? RangeEnd{first, rows, before} : RangeEnd{};
}

}  // namespace havers::calib
