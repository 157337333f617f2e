#include "calib/experiment/gauge_slip.hpp"

#include <fmt/format.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>

#include "calib/count.hpp"
#include "calib/experiment/channel_noise.hpp"
#include "calib/experiment/range_end.hpp"
#include "calib/experiment/robust_line.hpp"

namespace havers::calib {
namespace {

constexpr std::size_t fewest_before = 20;  // rows that tell how the specimen was going on,
constexpr std::size_t part_before = 5;     // or a fifth of all before
constexpr double falling = 0.02;           // of the strength: load that a row may lose by noise
constexpr double following = 0.2;          // of the strain to be expected that a sound gauge shows
constexpr double visible = 0.01;           // of the range: less is no jump

// A record, with the limits that its jumps are judged by. The strain is mended in place, so that a
// row is judged by the mended rows before it.
struct Record {
  std::vector<double>& strain;
  std::span<const double> stress;
  std::size_t peak;
  double resolution;     // Below it, a difference is noise. [-]
  double smallest_jump;  // [-]
  double least_step;     // The same, but for the range that the strain has. [-]
  double noise;          // [Pa]

  [[nodiscard]] static std::size_t some_before(std::size_t row) {
    return row - std::min(row, std::max(fewest_before, row / part_before));
  }
  // Compliance of the specimen just before a row: the slope of the strain over the stress, which
  // turns of the loading leave as it is; of many rows some tell it. [1/Pa]
  [[nodiscard]] double compliance(std::size_t row) const {
    constexpr std::size_t enough = 1000;
    const std::size_t first = some_before(row), stride = 1 + (row - first) / enough;
    const std::size_t rows = 1 + (row - first) / stride;
    const double variance = gsl_stats_variance(&stress[first], stride, rows);
    if (!(variance > 0.0)) return 0.0;
    const double together =
        gsl_stats_covariance(&stress[first], stride, &strain[first], stride, rows);
    return std::max(0.0, together / variance);
  }
  // The strain by which the rise of the stress lets expect one row above another. [-]
  [[nodiscard]] double expected(std::size_t from, std::size_t to) const {
    return std::max(0.0, stress[to] - stress[from]) * compliance(std::min(from, to));
  }
  // A logger's strain at the row of the largest stress may lie between its rows before and after
  // the break, and have any part of that fall.
  [[nodiscard]] double least_fall(std::size_t row) const {
    return row + 1 == peak ? resolution : smallest_jump;
  }
  // (X13) The strain jumps back from this row to the next, the load does not.
  [[nodiscard]] bool jumps_back(std::size_t row) const {
    return strain[row] - strain[row + 1] - expected(row + 1, row) > least_fall(row) &&
           stress[row + 1] > stress[row] - std::max(falling * stress[peak], 5.0 * noise);
  }
  // (X13) It jumps ahead, alone among its steps, and the load does not give way.
  [[nodiscard]] bool jumps_ahead(std::size_t row) const {
    constexpr double alone = 3.0;
    const auto step = [&](std::size_t i) { return std::abs(strain[i + 1] - strain[i]); };
    const double jump = strain[row + 1] - strain[row] - expected(row, row + 1);
    return row > 0 && jump > smallest_jump && jump > alone * step(row - 1) &&
           (row + 1 == peak || jump > alone * step(row + 1)) &&
           stress[row + 1] > stress[row] - 5.0 * noise;
  }
  [[nodiscard]] bool jumps(std::size_t row) const {
    const bool moves = std::abs(strain[row + 1] - strain[row]) > least_fall(row);
    return moves && (jumps_back(row) || jumps_ahead(row));
  }
};

// What a gauge that stands still shows is no noise of it: only the rows on the way count.
Record record_of(std::vector<double>& strain, std::span<const double> stress) {
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
  const auto loading = std::span<const double>(strain).first(peak + 1);
  const auto [low, high] = std::ranges::minmax(loading);
  const double resolution = visible * (high - low), end = high - resolution;
  const auto arrived = std::ranges::find_if(loading, [end](double e) { return e >= end; });
  const auto rising = loading.first(static_cast<std::size_t>(arrived - loading.begin()) + 1);
  std::vector<double> steps;
  for (std::size_t i = 1; i < rising.size(); i += 1 + rising.size() / enough_for_median)
    if (rising[i] != rising[i - 1]) steps.push_back(std::abs(rising[i] - rising[i - 1]));
  const double noise = 10.0 * noise_of(rising), step = 3.0 * median(std::move(steps));
  const double least = std::max(noise, resolution);
  return {.strain = strain,
          .stress = stress,
          .peak = peak,
          .resolution = least,
          .smallest_jump = std::max(least, step),
          .least_step = std::max(noise, step),
          .noise = noise_of(stress)};
}

// Whether the strain does not go on after the jump as the load does. What is to be expected is
// judged by the range before: a torn gauge shows ten thousand percent.
bool fell_off(const Record& record, std::size_t before, std::size_t after) {
  const double load = record.stress[record.peak] - record.stress[after];
  const double expected = load * record.compliance(before);
  const auto [low, high] = std::ranges::minmax(std::span(record.strain).first(before + 1));
  if (expected < std::max(record.least_step, visible * (high - low))) return false;
  return record.strain[record.peak] - record.strain[after] < following * expected;
}

std::string place(const Record& record, std::size_t row) {
  return fmt::format("at {:.4g} MPa, {:.0f} % of the strength", record.stress[row] * 1e-6,
                     100.0 * record.stress[row] / record.stress[record.peak]);
}

// (X14) `fault`: "fell off" or "stood still".
void continue_with_crosshead(Record& record, std::span<const double> extension, std::size_t row,
                             const std::string& fault, SlipRepair& repair) {
  const std::size_t first = Record::some_before(row), rows = row + 1 - first;
  Line line;
  if (!extension.empty())
    line = fit_robust_line(extension.subspan(first, rows),
                           std::span(record.strain).subspan(first, rows));
  if (line.slope <= 0.0) {
    repair.problem = fmt::format(
        "the gauge {} {}, and no crosshead tells the strain after it: "
        "the failure strain is unknown",
        fault, place(record, row));
    return;
  }
  for (std::size_t i = row + 1; i < record.strain.size(); ++i)
    record.strain[i] = line.intercept + line.slope * extension[i];
  repair.corrections.push_back(
      {"gauge " + fault,
       fmt::format("{}; from there the strain is the crosshead's, {:.4g} per mm as just before",
                   place(record, row), line.slope * 1e-3)});
  repair.warnings.push_back(fmt::format(
      "the gauge {} {}: the failure strain rests on the crosshead", fault, place(record, row)));
}

void take_back(Record& record, std::size_t before, std::size_t after, SlipRepair& repair) {
  // The part that the specimen itself was strained by, as the rise of the stress tells, stays.
  const double jump = record.strain[before] - record.strain[after] + record.expected(before, after);
  for (std::size_t i = after; i < record.strain.size(); ++i) record.strain[i] += jump;
  if (after == record.peak) {  // a row later the load has gone too
    repair.corrections.push_back(
        {"gauge at the break",
         fmt::format("it saw the break a row before the load did: the last strain goes on with the "
                     "load, by {:.5f} %",
                     jump * 100.0)});
    return;
  }
  ++repair.slips;
  repair.corrections.push_back(
      {"gauge slip",
       fmt::format("{}: the strain jumped {} by {:.5f} % while the load went on; the rows after "
                   "it are shifted",
                   place(record, before), jump > 0.0 ? "back" : "ahead", std::abs(jump) * 100.0)});
}

// (X14) The last row before the strain comes no further, though the stress does; the peak's where
// there is none.
std::size_t standstill(const Record& record) {
  // Of the strength: yielded, a specimen takes less for noise, unless not a digit changes.
  constexpr double least_rise = 0.05, least_rise_exact = 0.005;
  const RangeEnd end = end_of_range(std::span(record.strain).first(record.peak + 1));
  const bool exact = end.rows > 0;
  const double reached = record.strain[record.peak] - record.resolution;
  const auto row = std::ranges::find_if(record.strain, [&](double e) { return e >= reached; });
  const auto first = exact ? end.first : static_cast<std::size_t>(row - record.strain.begin());
  const double strength = record.stress[record.peak];
  const double least = (exact ? least_rise_exact : least_rise) * strength + 5.0 * record.noise;
  const bool rises = strength - record.stress[first] > least;
  const double growth = record.strain[record.peak] - record.strain[first];
  const double expected = record.expected(first, record.peak);
  const bool follows = growth >= following * expected || (!exact && expected < record.resolution);
  return rises && !follows && first > 0 ? first - 1 : record.peak;
}

void warn_of_slips(SlipRepair& repair) {
  if (repair.slips > 0)
    repair.warnings.push_back(
        fmt::format("the gauge slipped ({}): strains after that are uncertain by as much",
                    count(repair.slips, "jump")));
}

}  // namespace

SlipRepair mend_slips(std::vector<double>& strain, std::span<const double> stress,
                      std::span<const double> extension) {
  SlipRepair repair;
  Record record = record_of(strain, stress);
  // From the first jump on: whether the gauge fell off at one shows in the rows that follow it.
  for (std::size_t row = 0; row < record.peak; ++row) {
    if (!record.jumps(row)) continue;
    std::size_t after = row + 1;  // a jump may take several rows
    while (after < record.peak && record.jumps(after)) ++after;
    if (fell_off(record, row, after)) {
      warn_of_slips(repair);
      continue_with_crosshead(record, extension, row, "fell off", repair);
      return repair;
    }
    take_back(record, row, after, repair);
    row = after;
  }
  warn_of_slips(repair);
  // Last, as after a slip that is not taken back the strain could seem to stand still.
  if (const std::size_t row = standstill(record); row < record.peak)
    continue_with_crosshead(record, extension, row, "stood still", repair);
  return repair;
}

}  // namespace havers::calib
