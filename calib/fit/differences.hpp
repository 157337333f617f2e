// Derivatives of the residuals by finite differences: batched, inside the bounds, with their noise.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/fit/trail.hpp"

namespace havers::calib {

/// Step of the searches' derivatives: 5 % of a parameter. Large enough to see through the
/// replicates' noise, which makes the residuals only piecewise smooth.
inline constexpr double slope_step = 0.05;

/// How the residuals change with the active unknowns (F8). Rows as Evaluation::residuals, columns
/// as `active`.
struct Differences {
  bool failed = true;
  Eigen::MatrixXd jacobian;
  Eigen::MatrixXd variance;  ///< Of each entry, from the spread of its replicates.
  /// Sum of the variances, and what it would be with seeds of their own at every point.
  double paired = 0.0, independent = 0.0;
};

/// The points of central differences: each active unknown in turn a step down, and up; cut at the
/// bounds.
std::vector<Point> moved_points(const std::vector<Unknown>& unknowns, const Point& at,
                                const Active& active, double step);

/// Two points for each unknown. Failed where an unknown has no two points that differ and answer.
/// @param at    a copy: the trail's best point, where the slopes are often asked for, may change
///              while they are made.
/// @param step  in the scale of the search, as slope_step; cut at the bounds.
Differences differentiate(Trail& trail, Evaluation at, const Active& active, double step);

}  // namespace havers::calib
