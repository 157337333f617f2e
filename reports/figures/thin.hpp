// Fewer points for a plot, the extremes kept.
#pragma once

#include <span>
#include <vector>

namespace havers::reports {

/// Points of a curve: as many x as y.
struct Points {
  std::vector<double> x, y;
};

/// At most `limit` points of a curve: the smallest and the largest y of equal stretches, in their
/// order, so that neither peak nor noise is lost. Points that are not finite are dropped.
Points thin(std::span<const double> x, std::span<const double> y, std::size_t limit = 400);

}  // namespace havers::reports
