#include "calib/experiment/join_logger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "calib/experiment/channel_noise.hpp"
#include "calib/experiment/clean_channels.hpp"
#include "calib/experiment/engineering_curve.hpp"
#include "calib/experiment/robust_line.hpp"
#include "calib/experiment/signal_rates.hpp"

namespace havers::calib {
namespace {

// The first channel that was recorded; an empty one where none was.
const std::vector<double>& first_of(std::initializer_list<const std::vector<double>*> channels) {
  for (const std::vector<double>* channel : channels)
    if (!channel->empty()) return *channel;
  return **channels.begin();
}

// How a signal in volts is told from one that is known: the title of its correction, and the words
// of the sentence that says what is missing.
struct Calibration {
  const char *name, *signal, *known, *hint, *unit;
  double scale;  // SI to unit
};

// Keeps the rows of the machine whose time the logger saw: outside of it the logger's signal would
// only be its first or last value.
void keep_common_rows(RawTest& test, const ClockFit& clocks, const std::vector<double>& logged) {
  std::vector<bool> seen;
  for (const double time : test.time) {
    const double at = clocks.logger_time(time);
    seen.push_back(at >= logged.front() && at <= logged.back());
  }
  for (std::vector<double>* channel : std::array{&test.force, &test.load_volts, &test.extension,
                                                 &test.strain, &test.stress, &test.time}) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < channel->size(); ++i)
      if (seen[i]) (*channel)[kept++] = (*channel)[i];
    channel->resize(kept);
  }
}

double largest_load(const RawTest& test) {
  return test.load().empty() ? 0.0 : std::ranges::max(test.load());
}

// Where the logger ends on the way up, the strength is not that of the specimen, and clocks that
// are matched wrongly look the same.
void doubt_common_rows(double largest, RawTest& test) {
  constexpr double least = 0.02;  // of the largest load
  const double part = largest_load(test) / largest;
  if (!(largest > 0.0) || part > 1.0 - least) return;
  test.warnings.push_back(
      fmt::format("by the two clocks the logger saw the load up to {:.0f} % of the largest in the "
                  "machine's record only, and rows beyond are left out: the strength is too low by "
                  "that, or the clocks are matched wrongly",
                  100.0 * part));
}

// (X19) Volts in the unit of a channel that was recorded beside them; nothing where they do not
// follow it.
std::vector<double> calibrated(const std::vector<double>& volts, const std::vector<double>& known,
                               const Calibration& calibration, JoinedTest& joined) {
  constexpr double largest_error = 0.05;  // of the factor
  const bool recorded = known.size() == volts.size();
  // (X4) The error counts rows that err alike as fewer.
  const Line line =
      recorded ? with_true_error(fit_robust_line(volts, known), volts, known) : Line{};
  if (!(line.slope_standard_error < largest_error * std::abs(line.slope))) {
    joined.problems.push_back(fmt::format("{} is in volts, and {} does not tell what a volt is: {}",
                                          calibration.signal, calibration.known, calibration.hint));
    return {};
  }
  std::vector<double> values;
  values.reserve(volts.size());
  for (const double volt : volts) values.push_back(line.intercept + line.slope * volt);
  joined.test.corrections.push_back(
      {calibration.name,
       fmt::format("a volt is {:.5g} ± {:.2g} {}, fitted to {}", line.slope * calibration.scale,
                   line.slope_standard_error * calibration.scale, calibration.unit,
                   calibration.known)});
  return values;
}

// Whether a row is the first after a jump ahead, alone among the steps beside it (X13).
std::vector<bool> ends_of_jumps(const std::vector<double>& channel) {
  constexpr double alone = 3.0, least_part = 0.01;
  const auto [low, high] = std::ranges::minmax(channel);
  const double least = std::max(10.0 * noise_of(channel), least_part * (high - low));
  std::vector<bool> ends(channel.size(), false);
  for (std::size_t i = 2; i + 1 < channel.size(); ++i) {
    const double before = channel[i - 1] - channel[i - 2], after = channel[i + 1] - channel[i];
    const double beside = std::max(std::abs(before), std::abs(after));
    ends[i] = channel[i] - channel[i - 1] > std::max(least, alone * beside);
  }
  return ends;
}

// The logger's channel at the rows of the machine, linear between its own; empty where it was not
// recorded. Up to the row after a jump ahead it goes on as before: between two rows a gauge slips
// or sees the specimen part at once, and rows of the machine on the way up would hide the jump.
std::vector<double> at_machine_rows(const std::vector<double>& time,
                                    const std::vector<double>& channel, const JoinedTest& joined) {
  std::vector<double> values;
  if (channel.empty()) return values;
  const std::vector<bool> ends = ends_of_jumps(channel);
  for (const double machine_time : joined.test.time) {
    const double at = joined.clocks.logger_time(machine_time);
    const auto i = static_cast<std::size_t>(std::ranges::upper_bound(time, at) - time.begin());
    const bool jumps = i < ends.size() && ends[i] && time[i - 1] > time[i - 2];
    const double rate =
        jumps ? (channel[i - 1] - channel[i - 2]) / (time[i - 1] - time[i - 2]) : 0.0;
    values.push_back(jumps ? channel[i - 1] + rate * (at - time[i - 1])
                           : value_at({time, channel}, at));
  }
  return values;
}

constexpr Calibration gauge{"gauge factor",          "the logger's gauge",
                            "the test's own strain", "give strain_unit, as in \"0.001 mm/mm/V\"",
                            "% of strain",           100.0};
constexpr Calibration load_cell{"load cell factor",
                                "the test's force",
                                "the logger's force",
                                "give force_unit, as in \"500 N/V\"",
                                "N",
                                1.0};

// Of an extensometer whose length the logger's file or the user tells, io has made a strain.
void take_elongation(std::vector<double> elongation, JoinedTest& joined) {
  RawTest& test = joined.test;
  const std::optional<double>& length =
      test.extensometer_length ? test.extensometer_length : test.gauge_length;
  if (!length) {
    joined.problems.emplace_back(
        "the logger's gauge is an elongation, and the gauge length is unknown: "
        "give gauge_length_mm");
    return;
  }
  for (double& value : elongation) value /= *length;
  test.strain = std::move(elongation);
  test.crosshead_strain = false;
  test.warnings.push_back(fmt::format(
      "the logger's gauge is an elongation, divided by the gauge length of the machine's file, "
      "{:g} mm: of an extensometer of another length the strain is wrong (gauge_length_mm says it)",
      *length * 1e3));
}

// A logger's strain counts first, then an elongation, and volts only where there is neither. Volts
// are fitted to the test's own strain, which they then replace; of a crosshead's they keep the
// machine in it (X2).
void take_channels(const RawTest& logger, JoinedTest& joined) {
  RawTest& test = joined.test;
  if (test.force.empty() && !test.load_volts.empty())
    test.force = calibrated(test.load_volts, at_machine_rows(logger.time, logger.force, joined),
                            load_cell, joined);
  if (!logger.strain.empty()) {
    test.strain = at_machine_rows(logger.time, logger.strain, joined);
    test.crosshead_strain = logger.crosshead_strain;
  } else if (!logger.extension.empty()) {
    take_elongation(at_machine_rows(logger.time, logger.extension, joined), joined);
  } else if (!logger.volts.empty()) {
    test.strain =
        calibrated(at_machine_rows(logger.time, logger.volts, joined), test.strain, gauge, joined);
    test.fitted_strain = true;
  }
}

void list_clocks(const ClockFit& clocks, RawTest& test) {
  std::string detail =
      fmt::format("the machine's clock shows {:.4f} ± {:.2g} s when the logger's shows {:.4f} s",
                  clocks.offset, clocks.offset_standard_error, clocks.reference);
  if (clocks.rate_fitted)
    detail += fmt::format("; it runs {:.6f} ± {:.2g} times as fast", clocks.rate,
                          clocks.rate_standard_error);
  else
    test.warnings.emplace_back(
        "the signals do not tell the rate between the two clocks: it is taken as 1");
  test.corrections.push_back({"two clocks", detail});
}

// The clocks are matched by what the test is reduced to: one row that stands out stretches the
// range of a signal, and a load whose sign is turned falls where the gauge rises.
RawTest cleaned(RawTest record, const ReductionOptions& options) {
  clean_channels(record, options);
  turn_negative_load(record);
  return record;
}

// Whether the logger alone can tell tension from compression, and tells tension.
bool only_logger_stretches(const RawTest& machine, const RawTest& logger) {
  const std::vector<double>& signal = first_of({&logger.strain, &logger.extension});
  if (!machine.strain.empty() || !machine.extension.empty() || signal.empty()) return false;
  const double sum = std::accumulate(signal.begin(), signal.end(), 0.0);
  return sum > signal.front() * static_cast<double>(signal.size());
}

// Both records are mended alike, so the user is told that these repairs were in the logger's.
void list_repairs(const RawTest& logger, RawTest& test) {
  const std::string whose = "in the logger's record: ";
  for (const Correction& correction : logger.corrections)
    test.corrections.push_back({correction.what, whose + correction.detail});
  for (const std::string& warning : logger.warnings) test.warnings.push_back(whose + warning);
}

}  // namespace

JoinedTest join_logger(const RawTest& machine, const RawTest& recorded,
                       const ReductionOptions& options) {
  JoinedTest joined{.test = cleaned(machine, options), .clocks = {}, .problems = {}};
  RawTest& test = joined.test;
  const RawTest logger = cleaned(recorded, options);
  if (only_logger_stretches(test, logger)) turn_negative_load(test, true);
  list_repairs(logger, test);
  // Each record is compared by its load where it has one; its other channels only rise and fall
  // with the load.
  const auto& load = first_of({&test.force, &test.load_volts, &test.stress, &test.extension});
  const auto& signal = first_of(
      {&logger.force, &logger.load_volts, &logger.strain, &logger.volts, &logger.extension});
  if (test.time.empty() || load.empty() || logger.time.empty() || signal.empty()) {
    joined.problems.emplace_back(
        "to join a logger, the test needs time and force, the logger time and a gauge");
    return joined;
  }
  joined.clocks = fit_clocks({test.time, load}, {logger.time, signal});
  if (!joined.clocks.problem.empty()) {
    joined.problems.push_back(joined.clocks.problem);
    return joined;
  }
  const double largest = largest_load(test);
  keep_common_rows(test, joined.clocks, logger.time);
  doubt_common_rows(largest, test);
  take_channels(logger, joined);
  list_clocks(joined.clocks, test);
  return joined;
}

}  // namespace havers::calib
