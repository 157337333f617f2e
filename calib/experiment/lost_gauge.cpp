#include "calib/experiment/lost_gauge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "calib/experiment/modulus.hpp"
#include "calib/experiment/robust_line.hpp"

namespace havers::calib {
namespace {

constexpr std::size_t fewest_beside = 20;  // rows that tell how strain and crosshead go together,
constexpr std::size_t part_beside = 5;     // or a fifth of all with a strain

// The load at a row, a part of the largest, whatever its sign: a load that is written negative is
// turned in the reduction, later than this. [-]
double load_at(const RawTest& raw, std::size_t row) {
  const std::vector<double>& load = raw.load();
  const auto [low, high] = std::ranges::minmax(load);
  return std::abs(load[row]) / std::max(-low, high);
}

bool is_after_peak(const RawTest& raw, std::size_t row) {
  const std::vector<double>& load = raw.load();
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return std::ranges::max_element(load, larger) - load.begin() < std::ptrdiff_t(row);
}

// Strain over the crosshead's extension; not fitted where no extension was recorded.
Line line_beside(const RawTest& raw, RowRange beside) {
  if (raw.extension.empty()) return {};
  return fit_robust_line(std::span(raw.extension).subspan(beside.first, beside.rows()),
                         std::span(raw.strain).subspan(beside.first, beside.rows()));
}

// Lists what was done, with a warning. Rows lost from the first on are of a gauge that came late.
void tell(RawTest& raw, RowRange lost, const Line& line) {
  const bool late = lost.first == 0;
  const std::string part =
      fmt::format("{} {:.0f} % of the largest load{}", late ? "up to" : "from",
                  100.0 * load_at(raw, late ? lost.last : lost.first - 1), late ? "" : " on");
  raw.corrections.push_back(
      {"gauge without readings",
       fmt::format(
           "{}, {} of {} rows; there the strain is the crosshead's, {:.4g} per mm as just {}", part,
           lost.rows(), raw.strain.size(), line.slope * 1e-3, late ? "after" : "before")});
  raw.warnings.push_back(fmt::format("the gauge has no readings {}: {} on the crosshead", part,
                                     late ? "strains there rest" : "the failure strain rests"));
}

// (X14) Fills the rows `lost` at one end of the record by the line through those `beside` them.
// Returns why that is impossible; empty when it was done.
std::string extend(RawTest& raw, RowRange lost, RowRange beside) {
  const Line line = line_beside(raw, beside);
  const bool broken = is_after_peak(raw, lost.first);
  if (!line.fitted && !broken)
    return fmt::format(
        "the gauge has no readings at the record's {}, and no crosshead tells the strain there",
        lost.first == 0 ? "beginning" : "end");
  for (std::size_t i = lost.first; i < lost.last; ++i)
    raw.strain[i] =
        line.fitted ? line.intercept + line.slope * raw.extension[i] : raw.strain[lost.first - 1];
  // Readings lost after the largest load do not change the failure strain: there is nothing to
  // tell.
  if (!broken) tell(raw, lost, line);
  return {};
}

// For a logger's record, which has no load: rows without a reading of its gauge say nothing.
void cut(RawTest& raw, RowRange kept) {
  for (std::vector<double>* channel : {&raw.time, &raw.extension, &raw.strain, &raw.volts}) {
    if (channel->empty()) continue;
    channel->resize(kept.last);
    channel->erase(channel->begin(), channel->begin() + std::ptrdiff_t(kept.first));
  }
}

}  // namespace

std::string mend_lost_gauge(RawTest& raw) {
  const std::vector<double>& strain = raw.strain;
  const auto tells = [](double e) { return std::isfinite(e); };
  const auto from = std::ranges::find_if(strain, tells);
  if (from == strain.end()) {
    if (!strain.empty()) raw.warnings.emplace_back("the column of the strain is empty: not used");
    raw.strain.clear();
    return {};
  }
  const auto first = static_cast<std::size_t>(from - strain.begin());
  // Only the ends are mended: a gap between readings is refused as the file is read.
  const auto behind = std::find_if(strain.rbegin(), strain.rend(), tells).base();
  const auto end = static_cast<std::size_t>(behind - strain.begin());
  if (raw.load().empty()) {
    cut(raw, {first, end});
    return {};
  }
  const std::size_t rows =
      std::min(end - first, std::max(fewest_beside, (end - first) / part_beside));
  std::string problem;
  if (first > 0) problem = extend(raw, {0, first}, {first, first + rows});
  if (end < strain.size() && problem.empty())
    problem = extend(raw, {end, strain.size()}, {end - rows, end});
  return problem;
}

}  // namespace havers::calib
