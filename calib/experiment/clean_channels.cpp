#include "calib/experiment/clean_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "calib/count.hpp"
#include "calib/experiment/channel_noise.hpp"

namespace havers::calib {
namespace {

// (X11) Far from its neighbours, by what the noise, the range and their own wandering allow: the
// tip of a steep test that breaks is no spike. `y` points into a channel, two rows or more from its
// ends.
bool is_spike(const double* y, double threshold) {
  const double distance = std::abs(y[0] - 0.5 * (y[-1] + y[1]));
  // Written so that a distance that is NaN makes no spike.
  if (!(distance > threshold)) return false;
  const double wander =
      std::max({std::abs(y[-1] - y[-2]), std::abs(y[1] - y[-1]), std::abs(y[2] - y[1])});
  return distance > 5.0 * wander;
}

// (X12) A clock that stands still, or is written with too few digits, tells no rate.
void drop_standing_time(RawTest& test) {
  const std::vector<double>& time = test.time;
  const bool loaded = !test.force.empty() || !test.stress.empty() || !test.load_volts.empty();
  if (!loaded || time.size() < 2 ||
      std::ranges::any_of(time, [&](double t) { return t != time.front(); }))
    return;
  test.warnings.emplace_back("the time is the same in all rows: it is taken as not recorded");
  test.time.clear();
}

}  // namespace

std::size_t remove_spikes(std::vector<double>& values) {
  if (values.size() < 5) return 0;
  const auto [low, high] = std::ranges::minmax(values);
  const double threshold = std::max(10.0 * noise_of(values), 0.01 * (high - low));
  std::size_t removed = 0;
  for (std::size_t i = 2; i + 2 < values.size(); ++i) {
    // Replaced in place, so that the rows after a spike are not compared with it.
    if (!is_spike(&values[i], threshold)) continue;
    values[i] = 0.5 * (values[i - 1] + values[i + 1]);
    ++removed;
  }
  return removed;
}

// (X12) The last time of a record may be shared too: its rows go on at the step before.
std::size_t spread_repeated_times(std::vector<double>& time) {
  std::size_t spread = 0;
  double step = 0.0;
  for (std::size_t first = 0; first < time.size();) {
    std::size_t next = first + 1;
    while (next < time.size() && time[next] == time[first]) ++next;
    const auto rows = static_cast<double>(next - first);
    if (next < time.size()) step = (time[next] - time[first]) / rows;
    for (std::size_t i = first + 1; i < next; ++i)
      time[i] = time[first] + step * static_cast<double>(i - first);
    spread += next - first - 1;
    first = next;
  }
  return spread;
}

void clean_channels(RawTest& test, const ReductionOptions& options) {
  // First, as the step below would list all rows of a time that stands still as spread.
  drop_standing_time(test);
  if (options.spread_repeated_times)
    if (const std::size_t rows = spread_repeated_times(test.time); rows > 0)
      test.corrections.push_back(
          {"repeated times",
           fmt::format("{} {} the time of the row before: spread evenly up to the next",
                       count(rows, "row"), rows == 1 ? "has" : "have")});
  if (!options.remove_spikes) return;
  struct Named {
    const char* name;
    std::vector<double>& values;
  };
  for (const Named& channel : std::array{
           Named{"force", test.force}, Named{"stress", test.stress}, Named{"strain", test.strain},
           Named{"extension", test.extension}, Named{"the gauge's volts", test.volts},
           Named{"the load cell's volts", test.load_volts}})
    if (const std::size_t rows = remove_spikes(channel.values); rows > 0)
      test.corrections.push_back(
          {"spikes", fmt::format("{} of {} stood out of {} neighbours: replaced by the mean of the "
                                 "rows before and after",
                                 rows == 1 ? "1 row" : fmt::format("{} single rows", rows),
                                 channel.name, rows == 1 ? "its" : "their")});
}

}  // namespace havers::calib
