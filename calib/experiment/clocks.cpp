// (X17), (X18) The first guess comes from the correlation of the signals' rates or, where that is
// refused, from a break that is plain in both records; least squares over the rows and the break
// follow. What leaves the offset too uncertain is refused.
#include "calib/experiment/clocks.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "calib/experiment/channel_noise.hpp"
#include "calib/experiment/clock_break.hpp"
#include "calib/experiment/clock_refinement.hpp"
#include "calib/experiment/robust_line.hpp"
#include "calib/experiment/signal_rates.hpp"

namespace havers::calib {
namespace {

constexpr std::size_t fewest_rows = 20;
constexpr double smallest_overlap = 0.5;  // of the shorter record
// Slack and seating may move one signal and not the other: what a toe could reach is not compared.
constexpr double above_toe = 0.15;  // of the range
// What counts as a match (X18).
constexpr double smallest_correlation = 0.7;  // of the rates, at the best offset
constexpr double closest_rival = 0.95;  // correlation elsewhere that leaves it open, of the best
constexpr double largest_shift = 0.05;  // of the range, that the offset's error may move

double correlation(std::span<const double> a, std::span<const double> b) {
  if (a.empty()) return 0.0;
  const auto n = static_cast<Eigen::Index>(a.size());
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), n), y(b.data(), n);
  const double vx = (x - x.mean()).square().mean(), vy = (y - y.mean()).square().mean();
  constexpr double constant = 1e-12;  // a rate that never changes tells nothing
  if (vx <= constant * x.square().mean() || vy <= constant * y.square().mean()) return 0.0;
  return ((x - x.mean()) * (y - y.mean())).mean() / std::sqrt(vx * vy);
}

double extent_of(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  return high - low;
}

// The correlation at every lag, in steps, from `first`; at lag k the first of b meets a[k]. Cost
// O(n²) for a grid of n steps; `telling_step` allows no more than 4000.
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

// Of the rates at the fit, on the machine's clock.
double correlation_at(const SignalRates& machine, const SignalRates& logger, const ClockFit& fit) {
  std::vector<double> a, b;
  const double end = logger.start + logger.step * static_cast<double>(logger.value.size() - 1);
  for (std::size_t i = 0; i < machine.value.size(); ++i) {
    const double at = fit.logger_time(machine.start + machine.step * static_cast<double>(i));
    if (at < logger.start || at > end) continue;
    a.push_back(machine.value[i]);
    b.push_back(logger.at(at));
  }
  return correlation(a, b);
}

constexpr const char* what_helps =
    "; record some rows after the break with both, or a hold on the way, or export both signals in "
    "one file";

// (X18)
std::string doubt_of_rates(const ClockFit& fit) {
  if (fit.correlation >= smallest_correlation) return {};
  return fmt::format("the rates of the two signals correlate by {:.2f} at best", fit.correlation);
}

std::string doubt_of_offset(const ClockFit& fit, double shift) {
  if (shift <= largest_shift) return {};
  return fmt::format("the offset is known to ± {:.2g} s only", fit.offset_standard_error);
}

constexpr double smallest_jump = 0.2;  // of the range

// A gauge may move little in the break, and stay there. Where the break has to be, what stands out
// from noise and from the fastest loading is it.
double least_jump(const Signal& logger, const SignalRates& rates, double step) {
  constexpr double noises = 10.0,
                   changes = 2.0;  // of rates that are clipped at twice the loading's
  return std::min(
      smallest_jump * extent_of(logger.value),
      std::max(noises * noise_of(logger.value), changes * step * std::ranges::max(rates.value)));
}

// Keeps the rows up to the break in both records. Where too few would be left, all rows stay and
// nothing is returned.
std::optional<CommonBreak> cut_at(const SeenBreak& seen, const SeenBreak& logged,
                                  ClockEvidence& evidence) {
  if (std::min(seen.rows_before, logged.rows_before) < fewest_rows) return std::nullopt;
  const auto cut = [](Signal& signal, std::size_t rows) {
    signal = {signal.time.first(rows), signal.value.first(rows)};
  };
  cut(evidence.machine, seen.rows_before);
  cut(evidence.logger, logged.rows_before);
  return CommonBreak{seen.time, logged.time,
                     std::hypot(seen.standard_error, logged.standard_error)};
}

// The break in both records, where the logger's is about where the machine's lets expect it.
std::optional<CommonBreak> cut_at_break(double difference, const SignalRates& logger_rates,
                                        ClockEvidence& evidence) {
  const Signal &machine = evidence.machine, &logger = evidence.logger;
  constexpr double near = 5.0;  // steps
  const double step = evidence.step;
  const auto seen = find_break(machine, {.window = step,
                                         .from = machine.time.front(),
                                         .to = machine.time.back(),
                                         .least = smallest_jump * extent_of(machine.value)});
  if (!seen) return std::nullopt;
  const double about = seen->time - difference;
  const auto logged = find_break(logger, {.window = step,
                                          .from = about - near * step,
                                          .to = about + near * step,
                                          .least = least_jump(logger, logger_rates, step)});
  return logged ? cut_at(*seen, *logged, evidence) : std::nullopt;
}

// Whether the break took both signals back to where they came from: the line of their rows before
// it goes through what they show after. A gauge that was lost did that while the load went on.
bool fell_alike(const ClockEvidence& before, const SeenBreak& seen, const SeenBreak& logged,
                const Signal& machine, const Signal& logger) {
  const double difference = seen.time - logged.time;
  std::vector<double> load, strain;
  for (std::size_t i = 0; i < before.machine.time.size(); ++i) {
    const double at = before.machine.time[i] - difference;
    if (at < before.logger.time.front() || at > before.logger.time.back()) continue;
    load.push_back(before.machine.value[i]);
    strain.push_back(value_at(before.logger, at));
  }
  const Line line = fit_robust_line(strain, load);
  const auto after = [](const Signal& signal, const SeenBreak& broke) {
    const auto values = signal.value.subspan(broke.first_after);
    return median({values.begin(), values.end()});
  };
  const double expected = line.intercept + line.slope * after(logger, logged);
  const double shown = after(machine, seen);
  return line.fitted && std::abs(expected - shown) <= above_toe * extent_of(machine.value);
}

// Where steady loading is all there is before it, the break alone tells the offset, if it is plain
// in both records.
std::optional<CommonBreak> cut_at_plain_break(ClockEvidence& evidence) {
  const Signal machine = evidence.machine, logger = evidence.logger;
  const auto seen = find_plain_break(machine, evidence.step);
  const auto logged = find_plain_break(logger, evidence.step);
  if (!seen || !logged) return std::nullopt;
  const auto common = cut_at(*seen, *logged, evidence);
  return common && fell_alike(evidence, *seen, *logged, machine, logger) ? common : std::nullopt;
}

// The offset in whole steps at the middle of what both saw, or at the break.
void set_lag(const ClockEvidence& evidence, double difference, ClockFit& fit) {
  const Signal &machine = evidence.machine, &logger = evidence.logger;
  const double from = std::max(logger.time.front(), machine.time.front() - difference);
  const double to = std::min(logger.time.back(), machine.time.back() - difference);
  fit.reference = 0.5 * (from + to);
  fit.offset = fit.reference + difference;
  if (!evidence.broke) return;
  fit.reference = evidence.broke->logger_time;
  fit.offset = evidence.broke->machine_time;
}

// The offset at which the rates correlate best; why there is none in `problem`.
double best_difference(const SignalRates& machine, const SignalRates& logger, ClockFit& fit) {
  const Correlogram lags = correlate(machine.value, logger.value);
  const auto best =
      static_cast<std::size_t>(std::ranges::max_element(lags.value) - lags.value.begin());
  fit.correlation = lags.value[best];
  fit.problem = doubt_of_rates(fit);
  if (fit.problem.empty() && rival_of(lags.value, best) > closest_rival * fit.correlation)
    fit.problem = "several offsets fit alike";
  const auto lag = static_cast<double>(lags.first + static_cast<std::ptrdiff_t>(best));
  return machine.start + lag * machine.step - logger.start;
}

// The whole records, and their rates over the steps that both can tell.
struct ClockRecords {
  Signal machine, logger;
  double step;
  SignalRates machine_rates = rates_of(machine, step), logger_rates = rates_of(logger, step);
};

// From the lag, or the break, to the least squares.
ClockFit fit_from(double difference, const ClockEvidence& evidence, const ClockRecords& whole) {
  ClockFit fit;
  set_lag(evidence, difference, fit);
  fit = refine_clocks(evidence, fit);
  draw_clocks(evidence, whole.machine, whole.logger, fit);
  fit.correlation = correlation_at(whole.machine_rates, whole.logger_rates, fit);
  return fit;
}

// By the rates; why not, else.
std::string match_rates(const ClockRecords& whole, ClockEvidence evidence, ClockFit& fit) {
  const double difference = best_difference(whole.machine_rates, whole.logger_rates, fit);
  if (!fit.problem.empty()) return fit.problem;
  evidence.broke = cut_at_break(difference, whole.logger_rates, evidence);
  fit = fit_from(difference, evidence, whole);
  return doubt_of_rates(fit);
}

std::string match(const Signal& machine, const Signal& logger, ClockFit& fit) {
  if (machine.time.size() < fewest_rows || logger.time.size() < fewest_rows)
    return "there are too few rows";
  // The coarser of the two steps: in a finer one the other signal shows noise, or only what is
  // interpolated between its rows.
  const double step = std::max(telling_step(machine), telling_step(logger));
  if (!(step > 0.0)) return "the time is the same in all rows of both";
  const ClockRecords whole{machine, logger, step};
  if (std::min(whole.machine_rates.value.size(), whole.logger_rates.value.size()) < fewest_rows)
    return "one of the records is too short for the steps of the other";
  ClockEvidence evidence{
      .machine = machine, .logger = logger, .broke = {}, .step = whole.step, .lowest = above_toe};
  // Where the rates do not match, a plain break may do alone; without one the user is told what the
  // rates lack.
  std::string why = match_rates(whole, evidence, fit);
  if (!why.empty()) {
    const auto broke = evidence.broke = cut_at_plain_break(evidence);
    if (!broke) return why + what_helps;
    fit = fit_from(broke->machine_time - broke->logger_time, evidence, whole);
  }
  // (X18) By how much the error of the offset moves the machine's signal where it is fastest.
  const double fastest =
      std::ranges::max(whole.machine_rates.value) / extent_of(evidence.machine.value);
  why = doubt_of_offset(fit, fit.offset_standard_error * fastest);
  return why.empty() ? why : why + what_helps;
}

}  // namespace

ClockFit fit_clocks(const Signal& machine, const Signal& logger) {
  ClockFit fit;
  const std::string why = match(machine, logger, fit);
  fit.problem = why.empty() ? "" : "the signals do not determine the two clocks: " + why;
  return fit;
}

}  // namespace havers::calib
