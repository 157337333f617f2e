#include "calib/experiment/join_logger.hpp"

#include <fmt/format.h>

#include <array>

#include "calib/experiment/robust_line.hpp"
#include "calib/experiment/signal_rates.hpp"

namespace havers::calib {
namespace {

// The first channel that was recorded.
const std::vector<double>& first_of(std::initializer_list<const std::vector<double>*> channels) {
  for (const std::vector<double>* channel : channels)
    if (!channel->empty()) return *channel;
  return **channels.begin();
}

// Keeps the rows whose time the logger saw.
void keep_common_rows(RawTest& test, const ClockFit& clocks, const std::vector<double>& logged) {
  std::vector<bool> seen;
  for (const double time : test.time) {
    const double at = clocks.logger_time(time);
    seen.push_back(at >= logged.front() && at <= logged.back());
  }
  for (std::vector<double>* channel :
       std::array{&test.force, &test.extension, &test.strain, &test.stress, &test.time}) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < channel->size(); ++i)
      if (seen[i]) (*channel)[kept++] = (*channel)[i];
    channel->resize(kept);
  }
}

// (X19)
void turn_volts_into_strain(const std::vector<double>& volts, JoinedTest& joined) {
  RawTest& test = joined.test;
  const Line line = fit_robust_line(volts, test.strain);
  if (!line.fitted || line.slope == 0.0) {
    joined.problems.emplace_back(
        "the logger's signal is in volts, and the test has no strain that tells what a volt is: "
        "give strain_unit, as in \"0.001 mm/mm/V\"");
    return;
  }
  for (std::size_t i = 0; i < volts.size(); ++i)
    test.strain[i] = line.intercept + line.slope * volts[i];
  test.corrections.push_back(
      {"gauge factor", fmt::format("a volt is a strain of {:.5g} ± {:.2g} %, fitted to the test's "
                                   "own strain",
                                   100.0 * line.slope, 100.0 * line.slope_standard_error)});
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

}  // namespace

JoinedTest join_logger(const RawTest& machine, const RawTest& logger, const ClockOptions& options) {
  JoinedTest joined{.test = machine, .clocks = {}, .problems = {}};
  RawTest& test = joined.test;
  const auto& load = first_of({&machine.force, &machine.stress, &machine.extension});
  const auto& gauge = first_of({&logger.strain, &logger.volts, &logger.extension});
  const auto& signal = first_of({&logger.force, &gauge});
  if (machine.time.empty() || load.empty() || signal.empty() || gauge.empty()) {
    joined.problems.emplace_back(
        "to join a logger, the test needs time and force, the logger time and a gauge");
    return joined;
  }
  joined.clocks = fit_clocks({machine.time, load}, {logger.time, signal}, options);
  if (!joined.clocks.problem.empty()) {
    joined.problems.push_back(joined.clocks.problem);
    return joined;
  }
  keep_common_rows(test, joined.clocks, logger.time);
  std::vector<double> gauged;
  for (const double time : test.time)
    gauged.push_back(value_at({logger.time, gauge}, joined.clocks.logger_time(time)));
  if (!logger.volts.empty() && logger.strain.empty()) {
    test.strain.resize(gauged.size());  // zeros, which no line can be fitted to, where it has none
    turn_volts_into_strain(gauged, joined);
  } else {
    test.strain = std::move(gauged);
  }
  list_clocks(joined.clocks, test);
  return joined;
}

}  // namespace havers::calib
