#include "io/machine/guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "io/machine/number.hpp"

namespace havers::io {
namespace {

// The column's numbers in the preview, below the names. Faults are ignored, as this is for a guess.
std::vector<double> numbers_of_column(const Preview& preview, const Table& table, std::size_t i) {
  std::vector<double> numbers;
  for (const PreviewRow& row : preview.rows)
    if (row.line >= table.first_line && i < row.cells.size())
      numbers.push_back(parse_number(row.cells[i], preview.dialect.decimal).value);
  return numbers;
}

// Whether the steps are even but for the digits that the file cut off: each within a fifth of the
// mean step. Two rows have only one step, which tells nothing.
bool may_be_time(const std::vector<double>& numbers) {
  if (numbers.size() < 3) return false;
  const double step = (numbers.back() - numbers.front()) / static_cast<double>(numbers.size() - 1);
  for (std::size_t i = 1; i < numbers.size(); ++i)
    if (std::abs(numbers[i] - numbers[i - 1] - step) > 0.2 * step) return false;
  return step > 0.0;
}

double range(const std::vector<double>& numbers) {
  if (numbers.empty()) return 0.0;
  const auto [low, high] = std::ranges::minmax(numbers);
  return high - low;
}

}  // namespace

std::string guess_columns(const Preview& preview, const Table& table) {
  const auto first = std::ranges::find(preview.rows, table.first_line, &PreviewRow::line);
  std::vector<std::size_t> others;
  std::string text;
  for (std::size_t i = 0; i < first->cells.size(); ++i) {
    if (text.empty() && first->cells.size() > 2 &&
        may_be_time(numbers_of_column(preview, table, i)))
      text = fmt::format("time = \"{}\", ", i + 1);
    else
      others.push_back(i);
  }
  // Sorted by range; the column with the largest is taken for the force.
  std::ranges::stable_sort(others, std::greater{}, [&](std::size_t i) {
    return range(numbers_of_column(preview, table, i));
  });
  if (!others.empty()) text += fmt::format("force = \"{}\"", others[0] + 1);
  if (others.size() > 1) text += fmt::format(", extension = \"{}\"", others[1] + 1);
  return text;
}

}  // namespace havers::io
