// A straight line through points of which some may be wrong.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace havers::calib {

/// y = intercept + slope x.
struct Line {
  double slope = 0.0;
  double slope_standard_error = 0.0;
  double intercept = 0.0;
  bool fitted = false;  ///< False where fewer than three points, or one x only, leave it open.
};

/// How many successive rows of so many have their mean fitted as one point: as leave 2048 at most
/// (X4).
std::size_t rows_per_point(std::size_t rows);

/// Iteratively reweighted least squares with Tukey's bisquare (X4): points far off the line do not
/// count.
Line fit_robust_line(std::span<const double> x, std::span<const double> y);

/// Ordinary least squares: every point counts.
Line fit_plain_line(std::span<const double> x, std::span<const double> y);

/// What a line leaves of y at the points that are fitted: the rows, or means of them.
std::vector<double> residuals_of(const Line& line, std::span<const double> x,
                                 std::span<const double> y);

/// The line with the error of its slope as points that err alike have it: they are fewer, and what
/// few scatter about a line is itself uncertain, by the variance of Student's t (X4).
Line with_true_error(Line line, std::span<const double> x, std::span<const double> y);

}  // namespace havers::calib
