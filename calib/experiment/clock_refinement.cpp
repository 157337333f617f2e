// The method of Gauss and Newton for the coefficients of a spline, in which the model is linear,
// and the offset and rate of the clocks. Each step eliminates the spline from the normal equations,
// solves for the clocks, and then for the spline.
#include "calib/experiment/clock_refinement.hpp"

#include <gsl/gsl_bspline.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "calib/experiment/channel_noise.hpp"
#include "calib/experiment/signal_rates.hpp"

namespace havers::calib {
namespace {

// `spline` is the number of coefficients of the spline.
constexpr std::size_t order = 4, knots = 13, spline = knots + order - 2;  // cubic
// Steps of the grid over which a slope of the logger's signal is taken.
constexpr double slope_steps = 5.0;

// Cubic B-splines on [0, 1], with knots that lie closer towards 0, where a toe bends the curve.
class Splines {
 public:
  Splines() {
    std::array<double, knots> places{};
    for (std::size_t i = 0; i < knots; ++i)
      places.at(i) = std::pow(static_cast<double>(i) / (knots - 1), 2);
    const auto view = gsl_vector_view_array(places.data(), knots);
    gsl_bspline_knots(&view.vector, work_.get());
  }

  Eigen::VectorXd at(double x) {
    Eigen::VectorXd values(spline);
    auto view = gsl_vector_view_array(values.data(), spline);
    gsl_bspline_eval(std::clamp(x, 0.0, 1.0), &view.vector, work_.get());
    return values;
  }

  Eigen::VectorXd slope_at(double x) {
    Eigen::Matrix<double, spline, 2, Eigen::RowMajor> both;  // values, slopes
    auto view = gsl_matrix_view_array(both.data(), spline, 2);
    gsl_bspline_deriv_eval(std::clamp(x, 0.0, 1.0), 1, &view.matrix, work_.get());
    return both.col(1);
  }

 private:
  std::unique_ptr<gsl_bspline_workspace, decltype(&gsl_bspline_free)> work_{
      gsl_bspline_alloc(order, knots), gsl_bspline_free};
};

// Maps the values of a signal to parts of its range: 0 at the lowest, 1 at the largest.
struct ValueRange {
  double low, extent;
  explicit ValueRange(std::span<const double> values) {
    const auto [least, most] = std::ranges::minmax(values);
    low = least;
    extent = most - least;
  }
  [[nodiscard]] double part(double value) const { return (value - low) / extent; }
};

// Normal equations: sums over rows of splines by splines, splines by (offset, rate), (offset, rate)
// by itself, and of both by what is left of the signal (`_right`).
struct RowSums {
  Eigen::MatrixXd splines = Eigen::MatrixXd::Zero(spline, spline);
  Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(spline, 2);
  Eigen::Matrix2d clocks = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d of_noise = Eigen::Matrix2d::Zero();  // what noise adds to `clocks`
  Eigen::VectorXd splines_right = Eigen::VectorXd::Zero(spline);
  Eigen::Vector2d clocks_right = Eigen::Vector2d::Zero();
};

// Normal equations of offset and rate over the variance, with the noise of the slopes and without.
struct ClockSums {
  Eigen::Matrix2d rows = Eigen::Matrix2d::Zero(), told = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
};

class Refinement {
 public:
  explicit Refinement(const ClockEvidence& evidence)
      : evidence_(evidence), machine_(evidence.machine.value), logger_(evidence.logger.value) {
    const double noise = noise_of(evidence.logger.value) / logger_.extent;
    // (X17) Variance of the difference of two readings over the time between them.
    slope_variance_ = 2.0 * std::pow(noise / (slope_steps * evidence.step), 2);
  }

  // `clocks`: 0 the spline alone, 1 the offset too, 2 the rate too.
  void refine(ClockFit& fit, int clocks) {
    // A fixed number, without a test of convergence; each moves the offset by one step of the grid
    // at most.
    constexpr int steps = 15;
    for (int i = 0; i < steps; ++i) take_step(fit, clocks);
  }

  [[nodiscard]] double machine_part(double value) const { return machine_.part(value); }
  [[nodiscard]] double gauge(double at) const {
    return logger_.part(value_at(evidence_.logger, at));
  }
  [[nodiscard]] double of_gauge(double g) { return splines_.at(g).dot(coefficients_); }

  // Whether the clocks can be told from a row of the machine, given by time and value. `at` is its
  // time on the logger's clock, around which the slope needs readings on both sides.
  [[nodiscard]] bool counts(double time, double value, double at) const {
    const Signal& logger = evidence_.logger;
    return time <= evidence_.machine.time.back() && at > logger.time.front() + evidence_.step &&
           at < logger.time.back() - evidence_.step && machine_part(value) >= evidence_.lowest &&
           gauge(at) >= evidence_.lowest;
  }

 private:
  [[nodiscard]] double slope_of(double at) const;
  double add_rows(const ClockFit& fit, RowSums& sums);
  [[nodiscard]] Eigen::Vector2d move_clocks(ClockSums sums, int clocks, ClockFit& fit) const;
  void take_step(ClockFit& fit, int clocks);

  const ClockEvidence& evidence_;
  ValueRange machine_, logger_;
  double slope_variance_;  // what the logger's noise makes of a slope [1/s²]
  Splines splines_;
  Eigen::VectorXd coefficients_ = Eigen::VectorXd::Zero(spline);
};

// Of the gauge, over so many steps that the noise of the logger is small against it. [1/s]
double Refinement::slope_of(double at) const {
  const double half = 0.5 * slope_steps * evidence_.step;
  return (gauge(at + half) - gauge(at - half)) / (2.0 * half);
}

// Sums over the rows that count; the variance of what the spline leaves of them.
double Refinement::add_rows(const ClockFit& fit, RowSums& sums) {
  constexpr std::size_t enough_rows = 20'000;
  const Signal& machine = evidence_.machine;
  std::vector<double> residuals;
  double squares = 0.0;
  for (std::size_t i = 0; i < machine.time.size(); i += 1 + machine.time.size() / enough_rows) {
    const double at = fit.logger_time(machine.time[i]);
    if (!counts(machine.time[i], machine.value[i], at)) continue;
    const Eigen::VectorXd basis = splines_.at(gauge(at));
    const double residual = machine_part(machine.value[i]) - basis.dot(coefficients_);
    const double steepness = splines_.slope_at(gauge(at)).dot(coefficients_);
    // Derivatives of c(g(s)) by offset and rate, with s = reference + (t − offset) / rate.
    const Eigen::Vector2d by_rate{1.0, at - fit.reference};
    const Eigen::Vector2d clocks = -steepness * slope_of(at) / fit.rate * by_rate;
    sums.splines += basis * basis.transpose();
    sums.mixed += basis * clocks.transpose();
    sums.clocks += clocks * clocks.transpose();
    sums.of_noise += steepness * steepness * slope_variance_ * by_rate * by_rate.transpose();
    sums.splines_right += residual * basis;
    sums.clocks_right += residual * clocks;
    residuals.push_back(residual);
    squares += residual * residual;
  }
  const auto surplus = static_cast<double>(residuals.size()) - static_cast<double>(spline) - 2.0;
  // Rows that are no more than the unknowns say nothing: divided by an infinite variance, their
  // sums vanish.
  if (surplus <= 0.0) return std::numeric_limits<double>::infinity();
  constexpr double finest = 1e-6;  // of the range: no recorder resolves less
  return std::max(finest * finest, squares / surplus * rows_per_independent(residuals));
}

// A symmetric matrix without its negative part.
Eigen::Matrix2d positive_part(const Eigen::Matrix2d& matrix) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(matrix);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

// What the rows say of the clocks beyond what the spline could: the Schur complement of the normal
// equations, with `shared` the solution of splines by (offset, rate). What noise in the slopes adds
// is taken off; where no more than as much again remains, the rows say nothing (X17).
ClockSums beyond_noise(const RowSums& sums, const Eigen::MatrixXd& shared, double variance) {
  const Eigen::Matrix2d rows = sums.clocks - sums.mixed.transpose() * shared;
  const Eigen::Matrix2d told = positive_part(rows - sums.of_noise);
  if (told(0, 0) <= sums.of_noise(0, 0)) return {};
  const Eigen::Vector2d right = sums.clocks_right - shared.transpose() * sums.splines_right;
  return {rows / variance, told / variance, right / variance};
}

// The rows, the break, and weak bounds on a step: what nothing tells stays where it is.
Eigen::Vector2d Refinement::move_clocks(ClockSums sums, int clocks, ClockFit& fit) const {
  const auto add = [&](const Eigen::Vector2d& row, double residual, double error) {
    const Eigen::Matrix2d information = row * row.transpose() / (error * error);
    sums.rows += information;
    sums.told += information;
    sums.right += residual / (error * error) * row;
  };
  // Weak bounds, as standard errors: of the offset the length of the record, of the rate 1.
  add({1.0, 0.0}, 0.0, evidence_.machine.time.back() - evidence_.machine.time.front());
  add({0.0, 1.0}, 0.0, 1.0);
  if (evidence_.broke) {
    const double since = evidence_.broke->logger_time - fit.reference;
    add({1.0, since}, evidence_.broke->machine_time - fit.offset - fit.rate * since,
        evidence_.broke->standard_error);
  }
  if (clocks == 1) {
    // The rate is left with an equation of its own without a right-hand side, and so stays.
    sums.told(0, 1) = sums.told(1, 0) = sums.right[1] = 0.0;
  }
  const Eigen::Matrix2d told = sums.told.inverse();
  // (X17) H⁻¹ G H⁻¹: H is the matrix without the noise of the slopes, G the one with it.
  const Eigen::Matrix2d covariance = told * sums.rows * told;
  Eigen::Vector2d change = told * sums.right;
  // The equations are linear in the clocks only near where the slopes were taken.
  change[0] = std::clamp(change[0], -evidence_.step, evidence_.step);
  change[1] = std::clamp(change[1], -0.01, 0.01);
  fit.offset += change[0];
  fit.offset_standard_error = std::sqrt(covariance(0, 0));
  fit.rate_fitted = clocks == 2;
  if (!fit.rate_fitted) return change;
  fit.rate += change[1];
  fit.rate_standard_error = std::sqrt(covariance(1, 1));
  return change;
}

// One step of Gauss and Newton over the spline and the first `clocks` of offset and rate.
void Refinement::take_step(ClockFit& fit, int clocks) {
  RowSums sums;
  const double variance = add_rows(fit, sums);
  // Where no row is, the spline stays as it is.
  sums.splines.diagonal().array() += 1e-9 * (1.0 + sums.splines.diagonal().maxCoeff());
  const auto splines = sums.splines.ldlt();
  const Eigen::MatrixXd shared = splines.solve(sums.mixed);
  Eigen::Vector2d change = Eigen::Vector2d::Zero();
  if (clocks > 0) change = move_clocks(beyond_noise(sums, shared, variance), clocks, fit);
  coefficients_ += splines.solve(sums.splines_right) - shared * change;
}

}  // namespace

// The offset is fitted first, the rate held. The rate is then tried from there, and kept only where
// the signals tell it and it is near 1.
ClockFit refine_clocks(const ClockEvidence& evidence, ClockFit fit) {
  constexpr double largest_rate_error = 0.01;  // beyond it the clocks' rates are taken as equal
  Refinement refinement(evidence);
  refinement.refine(fit, 1);
  ClockFit with_rate = fit;
  refinement.refine(with_rate, 2);
  const bool told = with_rate.rate_standard_error < largest_rate_error &&
                    std::abs(with_rate.rate - 1.0) < 5.0 * largest_rate_error;
  return told ? with_rate : fit;
}

void draw_clocks(ClockEvidence evidence, const Signal& machine, const Signal& logger,
                 ClockFit& fit) {
  // The figure shows the toe too: its spline is fitted to all rows, the clocks being held.
  evidence.lowest = -std::numeric_limits<double>::infinity();
  Refinement refinement(evidence);
  refinement.refine(fit, 0);
  const ValueRange range(evidence.logger.value);
  for (std::size_t i = 0; i < machine.time.size(); ++i) {
    const double time = machine.time[i], at = fit.logger_time(time);
    fit.machine.time.push_back(time);
    fit.machine.part.push_back(refinement.machine_part(machine.value[i]));
    if (at < logger.time.front() || at > logger.time.back()) continue;
    fit.aligned.time.push_back(time);
    fit.aligned.part.push_back(refinement.of_gauge(range.part(value_at(logger, at))));
    if (!refinement.counts(time, machine.value[i], at)) continue;
    fit.residual.time.push_back(time);
    fit.residual.part.push_back(fit.aligned.part.back() - fit.machine.part.back());
  }
  for (std::size_t i = 0; i < logger.time.size(); ++i) {
    fit.logger.time.push_back(logger.time[i]);
    fit.logger.part.push_back(range.part(logger.value[i]));
  }
}

}  // namespace havers::calib
