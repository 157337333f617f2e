#include "calib/experiment/damped_wave.hpp"

#include <ceres/tiny_solver.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "calib/experiment/channel_noise.hpp"

namespace havers::calib {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

// With fewer rows no wave is sought; more than the most are fitted by their means.
constexpr std::size_t fewest_wave_points = 24, most_wave_points = 512;
// The grid from which the fit starts, in periods along the points.
constexpr double fewest_periods = 0.75, most_periods = 8.0, period_step = 0.25;
constexpr double shortest_told = 0.8;  // periods; a bend is as good an account of less
constexpr double least_fading = -0.5, most_fading = 12.0;  // of a wave, e-folds along the points
constexpr double least_f = 25.0;                           // of the F test of a wave beside a bend
constexpr double most_unexplained = 0.1;                   // part of what the bend leaves
constexpr double turn = 2.0 * std::numbers::pi;

// What y = a + b x + exp(−g x) (c cos ωx + s sin ωx) leaves of the points; parameters a, b, c, s,
// ω, g.
struct LineAndWave {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };
  VectorXd x, y;

  [[nodiscard]] int NumResiduals() const { return static_cast<int>(x.size()); }
  [[nodiscard]] static int NumParameters() { return 6; }

  // The columns are the derivatives by the parameters. The model is linear in the first four, so
  // that these columns serve to evaluate it too.
  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Eigen::Map<const VectorXd> p(parameters, NumParameters());
    MatrixXd columns(x.size(), p.size());
    columns.leftCols(4) = basis(p[4], p[5]);
    const auto cosine = columns.col(2).array(), sine = columns.col(3).array();
    columns.col(4) = x.array() * (p[3] * cosine - p[2] * sine);
    columns.col(5) = -x.array() * (p[2] * cosine + p[3] * sine);
    Eigen::Map<VectorXd>(residuals, x.size()) = columns.leftCols(4) * p.head(4) - y;
    if (jacobian != nullptr) Eigen::Map<MatrixXd>(jacobian, x.size(), p.size()) = columns;
    return true;
  }

  // 1, x, and the faded cosine and sine: a column each.
  [[nodiscard]] MatrixXd basis(double frequency, double fading) const {
    MatrixXd columns(x.size(), 4);
    const Eigen::ArrayXd fade = (-fading * x.array()).exp();
    columns.col(0).setOnes();
    columns.col(1) = x;
    columns.col(2) = fade * (frequency * x.array()).cos();
    columns.col(3) = fade * (frequency * x.array()).sin();
    return columns;
  }
};

// Means of successive rows, mapped to [0, 1], as stress and strain differ by many orders of
// magnitude. Rows at the end that do not fill a block are left out.
struct Mapped {
  double low = 0.0, extent = 0.0;
  VectorXd points;
};

Mapped mapped(std::span<const double> values) {
  const std::size_t rows = (values.size() + most_wave_points - 1) / most_wave_points;
  VectorXd points(static_cast<Eigen::Index>(values.size() / rows));
  for (Eigen::Index i = 0; i < points.size(); ++i)
    points[i] = Eigen::Map<const VectorXd>(&values[static_cast<std::size_t>(i) * rows],
                                           static_cast<Eigen::Index>(rows))
                    .mean();
  const double low = points.minCoeff(), extent = points.maxCoeff() - low;
  points = (points.array() - low) / extent;
  return {low, extent, points};
}

// Sum of squares that a bend without waves leaves: a cubic can follow a toe and yielding.
double squares_of_bend(const LineAndWave& points) {
  MatrixXd columns(points.x.size(), 4);
  for (int power = 0; power < 4; ++power) columns.col(power) = points.x.array().pow(power);
  const VectorXd answer = columns.colPivHouseholderQr().solve(points.y);
  return (columns * answer - points.y).squaredNorm();
}

// The sum of squares may have many minima over the frequency. So a grid of frequency and fading is
// searched, at each point of which the other four parameters are found by linear least squares; the
// solver starts from the best.
VectorXd best_wave(const LineAndWave& points) {
  VectorXd best(LineAndWave::NumParameters());
  double least = std::numeric_limits<double>::infinity();
  for (double periods = fewest_periods; periods <= most_periods; periods += period_step)
    for (const double fading : {0.0, 1.0, 2.0, 4.0}) {
      const MatrixXd columns = points.basis(turn * periods, fading);
      const VectorXd answer = columns.colPivHouseholderQr().solve(points.y);
      const double squares = (columns * answer - points.y).squaredNorm();
      if (squares >= least) continue;
      least = squares;
      best << answer, turn * periods, fading;
    }
  ceres::TinySolver<LineAndWave> solver;
  solver.Solve(points, &best);
  return best;
}

}  // namespace

std::optional<CarriedWave> find_damped_wave(std::span<const double> x, std::span<const double> y) {
  if (x.size() < fewest_wave_points) return {};
  const Mapped mx = mapped(x), my = mapped(y);
  if (!(mx.extent > 0.0 && my.extent > 0.0)) return {};
  const LineAndWave points{mx.points, my.points};
  const auto count = static_cast<double>(points.x.size());
  const double noise = noise_of(std::span(my.points.data(), my.points.data() + my.points.size()));
  const double of_noise = count * noise * noise;
  const double of_bend = squares_of_bend(points);
  // What the F test asks of a wave, which has two parameters more than the four of a cubic.
  const double certain = 1.0 + 2.0 * least_f / count;
  // A bend that leaves hardly more than noise leaves a wave nothing to explain.
  if (of_bend < certain * of_noise) return {};

  const VectorXd wave = best_wave(points);
  std::vector<double> left(static_cast<std::size_t>(points.x.size()));
  MatrixXd columns(points.x.size(), wave.size());
  points(wave.data(), left.data(), columns.data());
  const double squares = Eigen::Map<VectorXd>(left.data(), points.x.size()).squaredNorm();
  // (X24) A wave is long enough, hardly grows and does not fade at once. It is better than a bend
  // by the F test, and leaves, beyond the noise, a small part of what the bend leaves.
  const bool is_wave =
      wave[4] >= shortest_told * turn && wave[5] >= least_fading && wave[5] <= most_fading;
  if (!is_wave || of_bend < certain * squares ||
      squares - of_noise > most_unexplained * (of_bend - of_noise))
    return {};

  // (X4) As for a robust line: rows that err alike count as fewer, and Student's t is wider.
  const MatrixXd normal = columns.transpose() * columns;
  const double variance = normal.ldlt().solve(VectorXd::Unit(normal.rows(), 1))[1];
  const double freedom = std::max(count / rows_per_independent(left) - 6.0, 3.0);
  CarriedWave found;
  found.line.fitted = true;
  // Back from [0, 1] to the units of x and y.
  found.line.slope = wave[1] * my.extent / mx.extent;
  found.line.slope_standard_error =
      std::sqrt(variance * squares / (freedom - 2.0)) * my.extent / mx.extent;
  found.line.intercept = my.low + wave[0] * my.extent - found.line.slope * mx.low;
  found.periods = wave[4] / turn;
  found.amplitude = std::hypot(wave[2], wave[3]) * my.extent;
  return found;
}

}  // namespace havers::calib
