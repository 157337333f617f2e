#include "reports/figures/thin.hpp"

#include <algorithm>
#include <cmath>

namespace havers::reports {
namespace {

Points finite_points(std::span<const double> x, std::span<const double> y) {
  Points points;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    points.x.push_back(x[i]);
    points.y.push_back(y[i]);
  }
  return points;
}

}  // namespace

Points thin(std::span<const double> x, std::span<const double> y, std::size_t limit) {
  Points all = finite_points(x, y);
  if (all.x.size() <= limit) return all;
  Points kept;
  const auto keep = [&](std::size_t i) {
    kept.x.push_back(all.x[i]);
    kept.y.push_back(all.y[i]);
  };
  // Each stretch keeps two points.
  const std::size_t stretches = limit / 2;
  for (std::size_t s = 0; s < stretches; ++s) {
    const auto begin = all.y.begin() + static_cast<std::ptrdiff_t>(s * all.y.size() / stretches);
    const auto end =
        all.y.begin() + static_cast<std::ptrdiff_t>((s + 1) * all.y.size() / stretches);
    const auto [low, high] = std::minmax_element(begin, end);
    keep(static_cast<std::size_t>(std::min(low, high) - all.y.begin()));
    if (low != high) keep(static_cast<std::size_t>(std::max(low, high) - all.y.begin()));
  }
  return kept;
}

}  // namespace havers::reports
