#include "calib/experiment/gauge_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace havers::calib {
namespace {

// What a gauge grew by in two equal parts of the loading.
struct GaugeGrowth {
  double early = 0.0, late = 0.0;
  bool whole = false;  // no reading is missing

  // A gauge that stands still, fell off or jumps.
  [[nodiscard]] bool failed() const {
    constexpr double most = 5.0;
    // Below 0 where the gauge goes back, NaN where it does not move at all: both have failed.
    const double part = late / early;
    return !whole || !(part >= 1.0 / most && part <= most);
  }
};

// What tells how far the loading is; a logger has nothing but its gauges.
std::vector<double> loading_of(const RawTest& raw, const std::vector<double>& other) {
  if (!raw.load().empty()) return raw.load();
  std::vector<double> sum = raw.strain;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += other[i];
  return sum;
}

// The rows at which the loading first has 0.1, 0.5 and 0.9 of its largest value.
std::array<std::size_t, 3> rows_at_parts(const std::vector<double>& loading) {
  double largest = 0.0;
  for (const double one : loading) largest = std::fmax(largest, std::abs(one));
  std::array<std::size_t, 3> rows{};
  constexpr std::array<double, 3> parts{0.1, 0.5, 0.9};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto row = std::ranges::find_if(
        loading, [&](double one) { return std::abs(one) >= parts[k] * largest; });
    rows[k] = static_cast<std::size_t>(std::min(row, loading.end() - 1) - loading.begin());
  }
  return rows;
}

GaugeGrowth growth_of(const std::vector<double>& strain, const std::array<std::size_t, 3>& rows) {
  return {strain[rows[1]] - strain[rows[0]], strain[rows[2]] - strain[rows[1]],
          std::ranges::all_of(strain, [](double one) { return std::isfinite(one); })};
}

}  // namespace

// (X23)
std::string join_gauge_pair(RawTest& raw, const std::vector<double>& other, const std::string& a,
                            const std::string& b) {
  if (raw.strain.empty()) return fmt::format(R"("{}" is used)", a);
  const auto rows = rows_at_parts(loading_of(raw, other));
  const GaugeGrowth first = growth_of(raw.strain, rows), second = growth_of(other, rows);
  if (first.failed() != second.failed()) {
    if (first.failed()) raw.strain = other;
    return fmt::format(R"("{}" has gaps, stands still or jumps, and "{}" alone is used)",
                       first.failed() ? a : b, first.failed() ? b : a);
  }
  // (X23) Outside [0, 1) where a gauge shrinks, as one across the load does.
  const double bending = std::abs(first.early - second.early) / (first.early + second.early);
  if (first.failed() || !(bending >= 0.0 && bending < 1.0))
    return fmt::format(R"(they do not both stretch, and "{}" is used)", a);
  for (std::size_t i = 0; i < other.size(); ++i) raw.strain[i] = 0.5 * (raw.strain[i] + other[i]);
  return fmt::format(
      "their mean is used, which bending does not move; it adds {:.2g} % to the strain at a face",
      100.0 * bending);
}

}  // namespace havers::calib
