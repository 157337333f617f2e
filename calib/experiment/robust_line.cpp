#include "calib/experiment/robust_line.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>

#include "calib/experiment/channel_noise.hpp"

namespace havers::calib {
namespace {

// Stress is 1e8 and strain 1e-3: the fit works on x and y mapped to [0, 1].
struct Range {
  double low = 0.0, extent = 0.0;
};
Range range_of(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  return {low, high - low};
}

// (X4) A line of means is the line of the rows, and no more points are needed for it.
constexpr std::size_t most_points = 2048;

// Means of blocks of successive rows, of which the last may be shorter. Where rows are few, a block
// is one row.
std::vector<double> means(std::span<const double> values) {
  const std::size_t rows = rows_per_point(values.size());
  std::vector<double> result;
  for (; !values.empty(); values = values.subspan(std::min(rows, values.size()))) {
    const auto block = values.first(std::min(rows, values.size()));
    result.push_back(std::reduce(block.begin(), block.end()) / static_cast<double>(block.size()));
  }
  return result;
}

// The line by GSL through all points, as they are. `weighting` is the bisquare or none.
Line fit_all(std::span<const double> x, std::span<const double> y,
             const gsl_multifit_robust_type* weighting) {
  assert(x.size() == y.size());
  if (x.size() < 3) return {};
  const Range rx = range_of(x), ry = range_of(y);
  if (rx.extent <= 0.0) return {};
  // All points have one y: the line is level, and there is no range to map.
  if (ry.extent <= 0.0) return {.intercept = ry.low, .fitted = true};

  // A fit that stops at its last iteration is still an answer. Once, as threads are here.
  [[maybe_unused]] static auto* const handler = gsl_set_error_handler_off();
  std::vector<double> design, values;
  for (std::size_t i = 0; i < x.size(); ++i) {
    design.insert(design.end(), {1.0, (x[i] - rx.low) / rx.extent});
    values.push_back((y[i] - ry.low) / ry.extent);
  }
  std::array<double, 2> answer{};
  std::array<double, 4> covariance{};
  const auto all_x = gsl_matrix_view_array(design.data(), x.size(), 2);
  const auto all_y = gsl_vector_view_array(values.data(), x.size());
  auto c = gsl_vector_view_array(answer.data(), 2);
  auto of_c = gsl_matrix_view_array(covariance.data(), 2, 2);
  const std::unique_ptr<gsl_multifit_robust_workspace, decltype(&gsl_multifit_robust_free)> work(
      gsl_multifit_robust_alloc(weighting, x.size(), 2), gsl_multifit_robust_free);
  gsl_multifit_robust(&all_x.matrix, &all_y.vector, &c.vector, &of_c.matrix, work.get());

  // Back to the units of x and y; the last entry of the covariance is the slope's.
  Line line{.fitted = true};
  line.slope = answer[1] * ry.extent / rx.extent;
  line.slope_standard_error = std::sqrt(std::max(0.0, covariance[3])) * ry.extent / rx.extent;
  line.intercept = ry.low + answer[0] * ry.extent - line.slope * rx.low;
  return line;
}

Line fit(std::span<const double> x, std::span<const double> y,
         const gsl_multifit_robust_type* weighting) {
  return x.size() > most_points ? fit_all(means(x), means(y), weighting) : fit_all(x, y, weighting);
}

}  // namespace

std::size_t rows_per_point(std::size_t rows) {
  return rows > most_points ? 1 + (rows - 1) / most_points : 1;
}

Line fit_robust_line(std::span<const double> x, std::span<const double> y) {
  return fit(x, y, gsl_multifit_robust_bisquare);
}

Line fit_plain_line(std::span<const double> x, std::span<const double> y) {
  return fit(x, y, gsl_multifit_robust_ols);
}

std::vector<double> residuals_of(const Line& line, std::span<const double> x,
                                 std::span<const double> y) {
  std::vector<double> residuals = means(y);
  const std::vector<double> points = means(x);
  for (std::size_t i = 0; i < residuals.size(); ++i)
    residuals[i] -= line.intercept + line.slope * points[i];
  return residuals;
}

Line with_true_error(Line line, std::span<const double> x, std::span<const double> y) {
  // (X4) With fewer, ν/(ν − 2) would grow without bound.
  constexpr double fewest_freedom = 3.0;
  if (!line.fitted) return line;
  const std::vector<double> residuals = residuals_of(line, x, y);
  const double alike = rows_per_independent(residuals);
  const double independent = static_cast<double>(residuals.size()) / alike;
  const double freedom = std::max(independent - 2.0, fewest_freedom);
  line.slope_standard_error *= std::sqrt(alike * freedom / (freedom - 2.0));
  return line;
}

}  // namespace havers::calib
