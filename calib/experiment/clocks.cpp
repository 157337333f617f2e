#include "calib/experiment/clocks.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calib/experiment/signal_rates.hpp"

namespace havers::calib {
namespace {

constexpr std::size_t fewest_rows = 20;
constexpr double smallest_overlap = 0.5;  // of the shorter record

double correlation(std::span<const double> a, std::span<const double> b) {
  if (a.empty()) return 0.0;
  const auto n = static_cast<Eigen::Index>(a.size());
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), n), y(b.data(), n);
  const double vx = (x - x.mean()).square().mean(), vy = (y - y.mean()).square().mean();
  constexpr double constant = 1e-12;  // a rate that never changes tells nothing
  if (vx <= constant * x.square().mean() || vy <= constant * y.square().mean()) return 0.0;
  return ((x - x.mean()) * (y - y.mean())).mean() / std::sqrt(vx * vy);
}

// The correlation at every lag, in steps, from `first`.
struct Correlogram {
  std::ptrdiff_t first = 0;
  std::vector<double> value;
};

Correlogram correlate(const std::vector<double>& a, const std::vector<double>& b) {
  const auto na = static_cast<std::ptrdiff_t>(a.size()), nb = static_cast<std::ptrdiff_t>(b.size());
  const auto least =
      static_cast<std::ptrdiff_t>(smallest_overlap * static_cast<double>(std::min(na, nb)));
  Correlogram result{.first = least - nb, .value = {}};
  for (std::ptrdiff_t lag = least - nb; lag <= na - least; ++lag) {
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, lag), to = std::min(na, nb + lag);
    const auto rows = static_cast<std::size_t>(to - from);
    result.value.push_back(
        correlation(std::span(a).subspan(static_cast<std::size_t>(from), rows),
                    std::span(b).subspan(static_cast<std::size_t>(from - lag), rows)));
  }
  return result;
}

// The best correlation beyond the hill around the best of all.
double rival_of(const std::vector<double>& value, std::size_t best) {
  const double foot = 0.7 * value[best];
  std::size_t low = best, high = best;
  while (low > 0 && value[low] > foot) --low;
  while (high + 1 < value.size() && value[high] > foot) ++high;
  double rival = 0.0;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (i < low || i > high) rival = std::max(rival, value[i]);
  return rival;
}

// (X17) Machine's signal = cubic of the logger's at the logger's time, so that no straight material
// is assumed; by Gauss and Newton over the cubic, the offset and the rate. Rows at the break, where
// a sampling interval decides, do not count.
struct Refinement {
  static constexpr int cubic = 4, with_offset = 5, with_rate = 6;  // how many unknowns are free
  using Unknowns = Eigen::Matrix<double, with_rate, 1>;

  const Signal& machine;
  const Signal& logger;
  double step;  // over which the logger's slope is taken [s]
  ClockFit& fit;
  Eigen::Vector4d coefficients = Eigen::Vector4d::Zero();
  double machine_range = 1.0, logger_low = 0.0, logger_range = 1.0;

  [[nodiscard]] double gauge(double at) const {
    return (value_at(logger, at) - logger_low) / logger_range;
  }
  [[nodiscard]] bool both_saw(double at) const {
    return at > logger.time.front() + step && at < logger.time.back() - step;
  }

  [[nodiscard]] bool breaks(double time, double at) const {
    constexpr double jump = 0.2;  // of the range, within a step
    const double a = value_at(machine, time + step) - value_at(machine, time - step);
    const double b = gauge(at + step) - gauge(at - step);
    return std::abs(a) > jump * machine_range || std::abs(b) > jump;
  }

  // Residual of a row and its derivatives, in parts of the machine's range.
  double row_of(std::size_t i, double at, Unknowns& row) const {
    const double g = gauge(at);
    const double slope = (gauge(at + 0.5 * step) - gauge(at - 0.5 * step)) / step;
    row.head<4>() << 1.0, g, g * g, g * g * g;
    const double steepness =
        coefficients[1] + g * (2.0 * coefficients[2] + 3.0 * g * coefficients[3]);
    row[4] = -steepness * slope / fit.rate;
    row[5] = row[4] * (at - fit.reference);
    return machine.value[i] / machine_range - row.head<4>().dot(coefficients);
  }

  void take(int unknowns) {
    Eigen::Matrix<double, with_rate, with_rate> normal;
    normal.setIdentity();
    normal.topLeftCorner(unknowns, unknowns).setZero();
    Unknowns right = Unknowns::Zero(), row;
    double squares = 0.0;
    int rows = 0;
    for (std::size_t i = 0; i < machine.time.size(); ++i) {
      const double at = fit.logger_time(machine.time[i]);
      if (!both_saw(at) || breaks(machine.time[i], at)) continue;
      const double residual = row_of(i, at, row);
      normal.topLeftCorner(unknowns, unknowns) +=
          row.head(unknowns) * row.head(unknowns).transpose();
      right.head(unknowns) += residual * row.head(unknowns);
      squares += residual * residual;
      ++rows;
    }
    const Eigen::Matrix<double, with_rate, with_rate> inverse = normal.inverse();
    if (!inverse.allFinite()) return;
    apply(inverse * right);
    const double variance = squares / std::max(1, rows - unknowns);
    fit.offset_standard_error = std::sqrt(std::max(0.0, inverse(4, 4)) * variance);
    fit.rate_fitted = unknowns == with_rate;
    fit.rate_standard_error =
        fit.rate_fitted ? std::sqrt(std::max(0.0, inverse(5, 5)) * variance) : 0.0;
  }

  void apply(const Unknowns& change) {
    coefficients += change.head<4>();
    fit.offset += std::clamp(change[4], -step, step);
    fit.rate += std::clamp(change[5], -0.01, 0.01);
  }

  void refine(int unknowns) {
    constexpr int steps = 15;
    for (int i = 0; i < steps; ++i) take(unknowns);
  }
};

void fill_figure(const SignalRates& machine, const SignalRates& logger, ClockFit& fit) {
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < machine.value.size(); ++i) {
    const double time = machine.start + machine.step * static_cast<double>(i);
    const double at = fit.logger_time(time);
    if (at < logger.start ||
        at > logger.start + logger.step * static_cast<double>(logger.value.size() - 1))
      continue;
    fit.time.push_back(time);
    fit.machine.push_back(machine.value[i]);
    fit.logger.push_back(logger.at(at));
    products += fit.machine.back() * fit.logger.back();
    squares += fit.logger.back() * fit.logger.back();
  }
  for (double& rate : fit.logger) rate *= squares > 0.0 ? products / squares : 0.0;
  fit.correlation = correlation(fit.machine, fit.logger);
}

// (X18)
std::string doubt(const ClockFit& fit, const ClockOptions& options, double shift) {
  if (fit.correlation < options.smallest_correlation)
    return fmt::format("the rates of the two signals correlate by {:.2f} at best", fit.correlation);
  if (!(shift <= options.largest_shift))
    return fmt::format("the offset is known to ± {:.2g} s only", fit.offset_standard_error);
  return {};
}

}  // namespace

ClockFit fit_clocks(const Signal& machine, const Signal& logger, const ClockOptions& options) {
  ClockFit fit;
  const auto refuse = [&](const std::string& why) {
    fit.problem = "the signals do not determine the two clocks: " + why;
    return fit;
  };
  if (machine.time.size() < fewest_rows || logger.time.size() < fewest_rows)
    return refuse("there are too few rows");
  const double step = std::max(telling_step(machine), telling_step(logger));
  const SignalRates a = rates_of(machine, step), b = rates_of(logger, step);
  if (a.value.size() < fewest_rows || b.value.size() < fewest_rows)
    return refuse("one of the records is too short for the steps of the other");

  const Correlogram lags = correlate(a.value, b.value);
  const auto best =
      static_cast<std::size_t>(std::ranges::max_element(lags.value) - lags.value.begin());
  fit.correlation = lags.value[best];
  if (const std::string why = doubt(fit, options, 0.0); !why.empty()) return refuse(why);
  if (rival_of(lags.value, best) > options.closest_rival * fit.correlation)
    return refuse("several offsets fit alike");

  const auto lag = static_cast<double>(lags.first + static_cast<std::ptrdiff_t>(best));
  const double difference = a.start + lag * step - b.start;
  const double from = std::max(logger.time.front(), machine.time.front() - difference);
  const double to = std::min(logger.time.back(), machine.time.back() - difference);
  fit.reference = 0.5 * (from + to);
  fit.offset = fit.reference + difference;
  const auto [low, high] = std::ranges::minmax(machine.value);
  const auto [logger_low, logger_high] = std::ranges::minmax(logger.value);
  Refinement refinement{.machine = machine, .logger = logger, .step = step, .fit = fit};
  refinement.machine_range = high - low;
  refinement.logger_low = logger_low;
  refinement.logger_range = logger_high - logger_low;
  refinement.refine(Refinement::cubic);
  fit.offset_standard_error = step / std::sqrt(12.0);  // of a lag in whole steps
  const ClockFit whole_steps = fit;
  refinement.refine(Refinement::with_offset);
  // Where only the break is in both records, the lag is all that can be known.
  if (!(fit.offset_standard_error < whole_steps.offset_standard_error)) fit = whole_steps;
  const ClockFit equal_rates = fit;
  refinement.refine(Refinement::with_rate);
  if (!(fit.rate_standard_error < options.largest_rate_error) ||
      std::abs(fit.rate - 1.0) > 5.0 * options.largest_rate_error) {
    fit = equal_rates;
  }
  fill_figure(a, b, fit);
  const double fastest = std::ranges::max(a.value);
  const std::string why = doubt(fit, options, fit.offset_standard_error * fastest / (high - low));
  return why.empty() ? fit : refuse(why);
}

}  // namespace havers::calib
