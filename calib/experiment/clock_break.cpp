#include "calib/experiment/clock_break.hpp"

#include <algorithm>
#include <cmath>

namespace havers::calib {
namespace {

// Rows [first, last] between which the signal changes by `size`, in its unit.
struct Jump {
  std::size_t first = 0, last = 0;
  double size = 0.0;
};

// The largest change within a window that slides over the rows, in O(rows). A spike returns in the
// next row, a break does not: the smaller of the changes to the window's last row and to the next
// counts.
Jump largest_jump(const Signal& signal, const BreakSearch& search) {
  const auto& [time, value] = signal;
  Jump jump;
  for (std::size_t i = 0, end = 0; i + 1 < time.size(); ++i) {
    if (time[i] < search.from || time[i] > search.to) continue;
    end = std::max(end, i + 1);
    while (end + 1 < time.size() && time[end + 1] <= time[i] + search.window) ++end;
    const std::size_t after = std::min(end + 1, time.size() - 1);
    const double size =
        std::min(std::abs(value[end] - value[i]), std::abs(value[after] - value[i]));
    if (size > jump.size) jump = {i, end, size};
  }
  return jump;
}

}  // namespace

std::optional<SeenBreak> find_break(const Signal& signal, const BreakSearch& search) {
  Jump jump = largest_jump(signal, search);
  if (!(jump.size > search.least)) return std::nullopt;
  // The window may hold more rows than the break itself. Rows with less than a tenth of the jump
  // are still before the break, rows with more than nine tenths are after it.
  const auto jumped = [&, start = signal.value[jump.first]](std::size_t row) {
    return std::abs(signal.value[row] - start) / jump.size;
  };
  while (jump.first + 1 < jump.last && jumped(jump.first + 1) < 0.1) ++jump.first;
  while (jump.last > jump.first + 1 && jumped(jump.last - 1) > 0.9) --jump.last;
  const double before = signal.time[jump.first], after = signal.time[jump.last];
  // All instants between the two rows are equally likely: the standard error of a uniform law.
  return SeenBreak{.time = 0.5 * (before + after),
                   .standard_error = (after - before) / std::sqrt(12.0),
                   .rows_before = jump.first + 1,
                   .first_after = jump.last};
}

std::optional<SeenBreak> find_plain_break(const Signal& signal, double window) {
  constexpr double most_of_it = 0.5, another = 0.2;  // of the range
  const auto [low, high] = std::ranges::minmax(signal.value);
  const double start = signal.time.front(), extent = high - low;
  const auto seen = find_break(
      signal,
      {.window = window, .from = start, .to = signal.time.back(), .least = most_of_it * extent});
  if (!seen) return std::nullopt;
  const double before = signal.value[seen->rows_before - 1];
  const bool for_good = std::ranges::all_of(
      signal.value.subspan(seen->first_after),
      [&](double value) { return std::abs(value - before) > 0.5 * most_of_it * extent; });
  // Another jump is sought only where no window reaches the break that was found.
  const double end = signal.time[seen->rows_before - 1] - 2.0 * window;
  const bool only =
      !find_break(signal, {.window = window, .from = start, .to = end, .least = another * extent});
  return for_good && only ? seen : std::nullopt;
}

}  // namespace havers::calib
