#include "calib/experiment/record_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "calib/count.hpp"
#include "calib/experiment/channel_noise.hpp"
#include "calib/experiment/range_end.hpp"

namespace havers::calib {
namespace {

constexpr std::size_t held_rows = 3;        // a stress that fewer rows reach is a glitch
constexpr double least_held = 0.05;         // of the largest: below it, noise falls to half as well
constexpr double moment = 0.02;             // of the time in which the stress rose as far
constexpr double sudden = 0.25;             // of the stress: lost within a moment, a break
constexpr std::size_t fewest_again = 5;     // rows of glitches that a break may be followed by,
constexpr std::size_t rows_per_again = 20;  // and one more for so many rows before it
constexpr const char* lower_bounds =
    "strength and failure strain are lower bounds, unless the study says broke = true";

std::size_t largest_row(std::span<const double> values) {
  return static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
}

// Whether a channel goes back between two rows, by more than its noise and a part of what it had
// grown by. False where it was not recorded.
bool goes_back(std::span<const double> values, std::size_t from, std::size_t to) {
  constexpr double part = 0.02;
  if (values.empty()) return false;
  const double least = std::max(10.0 * noise_of(values), part * (values[from] - values.front()));
  return values[from] - values[to] > least;
}

// A record in which the load may fall: stress [Pa]; time [s], which may be empty; and the part of
// the stress reached below which the specimen has parted (X20).
struct Fall {
  std::span<const double> stress, time;
  double part;

  // Rows serve as time where none was recorded.
  [[nodiscard]] double at(std::size_t row) const {
    return time.empty() ? static_cast<double>(row) : time[row];
  }

  // Time from `part` of a stress to nine tenths of it, when it was first reached.
  [[nodiscard]] double rise_to(double held) const {
    constexpr double nearly = 0.9;
    const auto top = std::ranges::find_if(stress, [&](double s) { return s >= nearly * held; });
    const auto last = static_cast<std::size_t>(top - stress.begin());
    std::size_t first = last;
    while (first > 0 && stress[first] >= part * held) --first;
    return at(last) - at(first);
  }

  // (X20) Whether the stress loses more than a quarter of `held` within a moment around a row, or
  // from one row to the next where rows are farther apart.
  [[nodiscard]] bool is_sudden(std::size_t row, double held) const {
    // A part of the time that the loading took, so that neither speed nor sampling matters.
    const double window = moment * rise_to(held);
    std::size_t before = row - 1, after = row + 1;
    while (before > 0 && at(row) - at(before - 1) <= window) --before;
    while (after < stress.size() && at(after) - at(row) <= window) ++after;
    const double lowest = std::ranges::min(stress.subspan(row, after - row));
    return stress[before] - lowest > sudden * held;
  }

  // How many rows from `row` on have a stress that a specimen which has parted cannot have.
  [[nodiscard]] std::size_t rows_again(std::size_t row, double held) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(stress.subspan(row), [&](double s) { return s >= part * held; }));
  }

  // The first row of a sudden fall for good, or the end of a record that ends in one. What is
  // compared is the largest stress that a few rows before it hold.
  [[nodiscard]] std::optional<std::size_t> parting() const {
    // The least of the few rows before, so that a glitch among them does not count.
    const auto held_before = [&](std::size_t row) {
      return std::ranges::min(stress.subspan(row - held_rows, held_rows));
    };
    double largest = 0.0, held = 0.0;
    for (std::size_t row = held_rows; row <= stress.size(); ++row)
      largest = std::max(largest, held_before(row));
    // Only a row that crosses `part` of the stress held can be the break. Where too many later rows
    // reach that stress again, the fall was a loss of signal or a cycle.
    for (std::size_t row = held_rows; row < stress.size(); ++row) {
      held = std::max(held, held_before(row));
      if (held < least_held * largest || stress[row] >= part * held) continue;
      if (stress[row - 1] < part * held || !is_sudden(row, held)) continue;
      if (rows_again(row, held) <= std::max(fewest_again, row / rows_per_again)) return row;
    }
    // Machines may end a record as soon as some of the load is lost, before it has fallen to
    // `part`.
    if (is_sudden(stress.size() - 1, held)) return stress.size();
    return std::nullopt;
  }
};

// What a load cell shows that holds nothing any more is its offset, as one has that was zeroed with
// the specimen in the grips.
std::string offset_after(const Fall& fall, std::size_t row, double strength) {
  constexpr std::size_t least_rows = 3, enough_rows = 5;
  constexpr double steady = 0.01;  // of the strength
  const std::span<const double> rest = fall.stress.subspan(row + (fall.stress.size() - row) / 2);
  if (rest.size() < least_rows) return {};
  const auto [low, high] = std::ranges::minmax(rest);
  const double middle = 0.5 * (low + high);
  // The fewer the rows, the larger the offset has to be.
  const double least = rest.size() < enough_rows ? 0.03 : 0.025;  // of the strength
  if (high - low > steady * strength || std::abs(middle) < least * strength) return {};
  return fmt::format(
      "after the break the load stays at {:.3g} MPa, {:.1f} % of the strength: if the load cell "
      "was not zeroed without the specimen, the strength is wrong by that",
      middle * 1e-6, 100.0 * middle / strength);
}

// Rows that are missing where the specimen parts may have held a larger stress.
std::string gap_before(const Fall& fall, std::size_t row, double strength) {
  constexpr double steps = 5.0, least = 0.02;  // of those before; of the strength
  if (fall.time.empty() || row >= fall.stress.size() || row < 3 * held_rows) return {};
  const std::size_t last = row - 1, first = last - 2 * held_rows;
  const double gap = fall.at(row) - fall.at(last), before = fall.at(last) - fall.at(first);
  const double missed = gap / before * (fall.stress[last] - fall.stress[first]);
  if (!(gap > steps * before / (2 * held_rows)) || missed < least * strength) return {};
  return fmt::format(
      "{:.3g} s without a row lie before the break, in which the stress may have risen by {:.3g} "
      "MPa more: the strength may be too low by as much",
      gap, missed * 1e-6);
}

// `row` is the first that is not kept; it may be the end of the record.
RecordEnd parted_at(const Fall& fall, std::size_t row) {
  RecordEnd end{.broke = true, .rows = row, .cut = {}, .warnings = {}};
  end.cut = {"cut after break",
             fmt::format("{} of {} rows, from where the stress fell below {:.2g} of the strength",
                         fall.stress.size() - row, fall.stress.size(), fall.part)};
  const double strength = std::ranges::max(fall.stress.first(row));
  if (const std::size_t again = fall.rows_again(row, strength); again > 0)
    end.warnings.push_back(fmt::format(
        "after the break the stress is above {:.2g} of the strength again in {}: not used",
        fall.part, count(again, "row")));
  if (std::string offset = offset_after(fall, row, strength); !offset.empty())
    end.warnings.push_back(std::move(offset));
  if (std::string gap = gap_before(fall, row, strength); !gap.empty())
    end.warnings.push_back(std::move(gap));
  return end;
}

RecordEnd unloaded_at(const Fall& fall, std::size_t peak) {
  RecordEnd end{.broke = false, .rows = peak + 1, .cut = {}, .warnings = {}};
  end.cut = {"cut unloading", fmt::format("{} of {} rows, all after the largest stress",
                                          fall.stress.size() - end.rows, fall.stress.size())};
  end.warnings.push_back(
      fmt::format("no break was seen: the strain went back as the stress fell, so the specimen was "
                  "unloaded or slid in its grips; {}",
                  lower_bounds));
  return end;
}

// Rows in which the load cell is at the end of its range, while the specimen is stretched on as it
// had been. 0 where there are none.
std::size_t rows_at_range_end(std::span<const double> stress, std::span<const double> strain) {
  constexpr double least_stretch = 0.5;  // of what a row was stretched by before
  const RangeEnd end = end_of_range(stress);
  if (end.rows == 0) return 0;
  const double stretch = strain[end.first + end.rows - 1] - strain[end.first];
  const double before = strain[end.first] - strain[end.first - end.before];
  const double longer = static_cast<double>(end.rows) / static_cast<double>(end.before);
  return stretch > least_stretch * longer * before ? end.rows : 0;
}

RecordEnd beyond_range(const Fall& fall, std::size_t rows) {
  RecordEnd end{.broke = false, .rows = largest_row(fall.stress) + 1, .cut = {}, .warnings = {}};
  end.cut = {"cut at the end of the load cell's range",
             fmt::format("{} of {} rows, from the second of the largest stress",
                         fall.stress.size() - end.rows, fall.stress.size())};
  end.warnings.push_back(
      fmt::format("the load stays at its largest value to the last digit in {} while the specimen "
                  "is stretched on: the end of the load cell's range; {}",
                  count(rows, "row"), lower_bounds));
  return end;
}

RecordEnd stopped(const Fall& fall) {
  const double left = fall.stress.back() / std::ranges::max(fall.stress);
  return {
      .broke = false,
      .rows = fall.stress.size(),
      .cut = {},
      .warnings = {fmt::format(
          "no break was seen: the record ends at {:.0f} % of its largest stress; {} (a machine may "
          "end its record at the break)",
          100.0 * left, lower_bounds)}};
}

}  // namespace

RecordEnd end_of_record(const MeasuredTest& test, std::span<const double> crosshead,
                        double break_part) {
  const Fall fall{test.stress, test.time, break_part};
  // The end of the load cell's range first: the record may well go on to a break, whose strength
  // the cell did not show.
  if (const std::size_t rows = rows_at_range_end(test.stress, test.strain); rows > 0)
    return beyond_range(fall, rows);
  // (X20) A sudden fall is a break, unless the crosshead went back with it.
  if (const std::optional<std::size_t> row = fall.parting()) {
    const std::size_t peak = largest_row(fall.stress.first(*row));
    const std::size_t fallen = std::min(*row, fall.stress.size() - 1);
    const bool returned = fallen - peak > held_rows && goes_back(crosshead, peak, fallen);
    return returned ? unloaded_at(fall, peak) : parted_at(fall, *row);
  }
  const std::size_t peak = largest_row(fall.stress);
  std::size_t row = peak;
  // (X20) Without a sudden fall: a slow one is a break too, unless the strain or the crosshead goes
  // back; with none at all the test was stopped.
  while (row < fall.stress.size() && fall.stress[row] >= break_part * fall.stress[peak]) ++row;
  if (row == fall.stress.size()) return stopped(fall);
  const bool returned = goes_back(test.strain, peak, row) || goes_back(crosshead, peak, row);
  return returned ? unloaded_at(fall, peak) : parted_at(fall, row);
}

std::string jump_of_stress(const MeasuredTest& test) {
  constexpr double smallest = 0.05, steps = 5.0;
  const auto loading = std::span(test.stress).first(largest_row(test.stress) + 1);
  const std::size_t stride = 1 + loading.size() / enough_for_median;
  std::vector<double> some;
  std::size_t steepest = 1;
  // Finds the steepest rise, and collects the steps of some rows for the median.
  for (std::size_t i = 1; i < loading.size(); ++i) {
    if (i % stride == 0) some.push_back(std::abs(loading[i] - loading[i - 1]));
    if (loading[i] - loading[i - 1] > loading[steepest] - loading[steepest - 1]) steepest = i;
  }
  if (some.empty()) return {};
  const double jump = loading[steepest] - loading[steepest - 1];
  const double least = std::max({smallest * loading.back(), steps * median(std::move(some)),
                                 10.0 * test.strength_standard_error});
  if (jump <= least) return {};
  return fmt::format(
      "the stress jumps from {:.4g} to {:.4g} MPa between two rows: if that is a fault of the "
      "record, the strength may be wrong",
      loading[steepest - 1] * 1e-6, loading[steepest] * 1e-6);
}

std::string drop_of_stress(const MeasuredTest& test) {
  constexpr double smallest = 0.1, back = 0.02;
  const std::size_t peak = largest_row(test.stress);
  const double least = std::max(smallest * test.stress[peak], 10.0 * test.strength_standard_error);
  std::size_t top = 0, deepest = 0;
  double drop = least;
  // Finds the deepest fall below what was reached before. A few rows have to stay below: a glitch
  // does not count.
  for (std::size_t row = 1; row + held_rows <= peak; ++row) {
    if (test.stress[row] > test.stress[top]) top = row;
    const double held = std::ranges::max(std::span(test.stress).subspan(row, held_rows));
    const bool stretched =
        test.strain[row] > test.strain[top] - back * (test.strain[peak] - test.strain.front());
    if (test.stress[top] - held <= drop || !stretched) continue;
    drop = test.stress[top] - held;
    deepest = top;
  }
  if (drop <= least) return {};
  return fmt::format(
      "the stress falls by {:.3g} MPa at {:.4g} MPa and grows again, while the strain does not go "
      "back: if the specimen slid in its grips, the failure strain is too large by that",
      drop * 1e-6, test.stress[deepest] * 1e-6);
}

}  // namespace havers::calib
