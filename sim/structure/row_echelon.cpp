// Gauss's elimination of one row at a time, kept sparse by maps. Pivots are the largest entries of
// what is left of a row.
#include "sim/structure/row_echelon.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace havers::sim {

int RowEchelon::add(const Row& row) {
  std::map<int, double> free;                       // by column
  std::map<int, std::pair<int, double>> reducible;  // by their pivots' number
  const auto add_to = [&](int column, double value) {
    const auto pivot = pivots_.find(column);
    if (pivot == pivots_.end())
      free[column] += value;
    else
      (reducible[pivot->second.number] = {column, reducible[pivot->second.number].second + value});
  };
  for (const auto& [column, value] : row) add_to(column, value);
  // What a pivot's row puts in its place are columns without pivots, and those of later ones.
  while (!reducible.empty()) {
    const auto [column, value] = reducible.extract(reducible.begin()).mapped();
    for (const auto& [other, part] : pivots_.at(column).rest) add_to(other, -value * part);
  }
  const auto largest =
      std::ranges::max_element(free, {}, [](const auto& entry) { return std::abs(entry.second); });
  if (largest == free.end() || std::abs(largest->second) < least_) return -1;
  const auto [column, value] = *largest;
  Pivot pivot{static_cast<int>(pivots_.size()), {}};
  for (const auto& [other, entry] : free)
    if (other != column && entry != 0.0) pivot.rest.emplace_back(other, entry / value);
  pivots_.emplace(column, std::move(pivot));
  return column;
}

}  // namespace havers::sim
