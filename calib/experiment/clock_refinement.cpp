#include "calib/experiment/clock_refinement.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calib/experiment/signal_rates.hpp"

namespace havers::calib {

ClockRefinement::ClockRefinement(const Signal& machine, const Signal& logger, double step)
    : machine_(machine), logger_(logger), step_(step) {
  const auto [low, high] = std::ranges::minmax(machine.value);
  machine_low_ = low;
  machine_range_ = high - low;
  const auto [logger_low, logger_high] = std::ranges::minmax(logger.value);
  logger_low_ = logger_low;
  logger_range_ = logger_high - logger_low;
}

double ClockRefinement::gauge(double at) const {
  return (value_at(logger_, at) - logger_low_) / logger_range_;
}

double ClockRefinement::machine_part(double value) const {
  return (value - machine_low_) / machine_range_;
}

bool ClockRefinement::both_saw(double at) const {
  return at > logger_.time.front() + step_ && at < logger_.time.back() - step_;
}

bool ClockRefinement::breaks(double time, double at) const {
  constexpr double jump = 0.2;  // of the range, within a step
  const double a = value_at(machine_, time + step_) - value_at(machine_, time - step_);
  const double b = gauge(at + step_) - gauge(at - step_);
  return std::abs(a) > jump * machine_range_ || std::abs(b) > jump;
}

double ClockRefinement::of_gauge(double g) const {
  return coefficients_[0] + g * (coefficients_[1] + g * (coefficients_[2] + g * coefficients_[3]));
}

// Residual of a row and its derivatives, in parts of the machine's range.
double ClockRefinement::row_of(const ClockFit& fit, std::size_t i, Unknowns& row) const {
  const double at = fit.logger_time(machine_.time[i]);
  const double g = gauge(at);
  const double slope = (gauge(at + 0.5 * step_) - gauge(at - 0.5 * step_)) / step_;
  const double steepness =
      coefficients_[1] + g * (2.0 * coefficients_[2] + 3.0 * g * coefficients_[3]);
  row.head<4>() << 1.0, g, g * g, g * g * g;
  row[4] = -steepness * slope / fit.rate;
  row[5] = row[4] * (at - fit.reference);
  return machine_part(machine_.value[i]) - of_gauge(g);
}

void ClockRefinement::take_step(ClockFit& fit, Free free) {
  Eigen::Matrix<double, with_rate, with_rate> normal;
  normal.setIdentity();
  normal.topLeftCorner(free, free).setZero();
  Unknowns right = Unknowns::Zero(), row;
  double squares = 0.0;
  int rows = 0;
  for (std::size_t i = 0; i < machine_.time.size(); ++i) {
    const double at = fit.logger_time(machine_.time[i]);
    if (!both_saw(at) || breaks(machine_.time[i], at)) continue;
    const double residual = row_of(fit, i, row);
    normal.topLeftCorner(free, free) += row.head(free) * row.head(free).transpose();
    right.head(free) += residual * row.head(free);
    squares += residual * residual;
    ++rows;
  }
  const Eigen::Matrix<double, with_rate, with_rate> inverse = normal.inverse();
  if (!inverse.allFinite()) return;
  const Unknowns change = inverse * right;
  const double variance = squares / std::max(1, rows - static_cast<int>(free));
  const auto error = [&](int i) { return std::sqrt(std::max(0.0, inverse(i, i)) * variance); };
  coefficients_ += change.head<4>();
  fit.rate_fitted = free == with_rate;
  if (free == cubic) return;
  fit.offset += std::clamp(change[4], -step_, step_);
  fit.offset_standard_error = error(4);
  if (!fit.rate_fitted) return;
  fit.rate += std::clamp(change[5], -0.01, 0.01);
  fit.rate_standard_error = error(5);
}

void ClockRefinement::refine(ClockFit& fit, Free free) {
  constexpr int steps = 15;
  for (int i = 0; i < steps; ++i) take_step(fit, free);
}

void ClockRefinement::draw(ClockFit& fit) {
  ClockFit same_clocks = fit;
  refine(same_clocks, cubic);
  for (std::size_t i = 0; i < machine_.time.size(); ++i) {
    const double time = machine_.time[i], at = fit.logger_time(time);
    fit.machine.time.push_back(time);
    fit.machine.part.push_back(machine_part(machine_.value[i]));
    if (!both_saw(at)) continue;
    fit.aligned.time.push_back(time);
    fit.aligned.part.push_back(of_gauge(gauge(at)));
    if (breaks(time, at)) continue;
    fit.residual.time.push_back(time);
    fit.residual.part.push_back(fit.aligned.part.back() - fit.machine.part.back());
  }
  for (const double time : logger_.time) {
    fit.logger.time.push_back(time);
    fit.logger.part.push_back(gauge(time));
  }
}

}  // namespace havers::calib
