#include "calib/synthetic/coverage.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "calib/fit/calibration.hpp"

namespace havers::calib {
namespace {

// A row for each parameter of the study, whether it has an interval or not.
void add_rows(const Design& design, int number, const KnownStudy& known,
              const CalibrationResult& result, Coverage& coverage) {
  for (std::size_t k = 0; k < known.parameters.size(); ++k) {
    const std::string name = known.parameters.at(k);
    const auto parameter = std::ranges::find(result.parameters, name, &CalibratedParameter::name);
    CoverageRow row{.design = design.name, .study = number, .parameter = name};
    row.truth = known.truth.at(k);
    row.value = parameter->value;
    row.lower = parameter->interval_95[0];
    row.upper = parameter->interval_95[1];
    row.informed = parameter->identifiable;
    row.inside = row.informed && row.lower <= row.truth && row.truth <= row.upper;
    coverage.rows.push_back(std::move(row));
  }
}

CoverageSummary summary_of(const std::string& design, const std::string& parameter,
                           const std::vector<CoverageRow>& rows) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  CoverageSummary summary{
      .design = design, .parameter = parameter, .half_width = {none, none, none}};
  int inside = 0;
  std::vector<double> half_widths;
  for (const CoverageRow& row : rows) {
    if (row.design != design || row.parameter != parameter) continue;
    ++summary.studies;
    if (!row.informed) continue;
    ++summary.informed;
    inside += row.inside ? 1 : 0;
    // By logarithms, in which these parameters are searched (F1).
    half_widths.push_back(0.5 * std::log(row.upper / row.lower));
  }
  summary.inside = rate_of(inside, summary.informed);
  if (!half_widths.empty()) summary.half_width = quantiles_of(std::move(half_widths));
  return summary;
}

}  // namespace

int CoverageSummary::held() const {
  return informed > 0 ? static_cast<int>(std::lround(inside.part * informed)) : 0;
}

std::string to_string(IntervalWidth width) {
  constexpr std::array words{"as promised",      "too wide",           "too narrow",
                             "perhaps too wide", "perhaps too narrow", "too few to tell"};
  return words.at(static_cast<std::size_t>(width));
}

IntervalWidth Coverage::width_of(const CoverageSummary& summary) const {
  constexpr double promised = 0.95, much_poorer = 0.85;
  // A design and parameter without any interval is not judged, and so takes no part of the risk.
  const auto shares =
      std::ranges::count_if(summaries, [](const CoverageSummary& one) { return one.informed > 0; });
  const double risk_each_side = 0.025 / static_cast<double>(std::max(shares, std::ptrdiff_t{1}));
  const auto held = static_cast<unsigned>(summary.held());
  const auto all = static_cast<unsigned>(summary.informed);
  // Where it could be chance that no interval holds the truth, and also that all do, the share
  // cannot tell.
  const double none_held = std::pow(1.0 - promised, all), all_held = std::pow(promised, all);
  if (std::min(none_held, all_held) >= risk_each_side) return IntervalWidth::too_few;
  if (gsl_cdf_binomial_P(held, promised, all) < risk_each_side) return IntervalWidth::too_narrow;
  // Q is the probability of more than its argument, here of `held` or more.
  if (held > 0 && gsl_cdf_binomial_Q(held - 1, promised, all) < risk_each_side)
    return IntervalWidth::too_wide;
  // Not beyond chance among all shares, but the share's own interval may still leave out 95 %.
  const auto [low, high] = summary.inside.interval_95;
  return high < promised     ? IntervalWidth::perhaps_too_narrow
         : low > promised    ? IntervalWidth::perhaps_too_wide
         : low < much_poorer ? IntervalWidth::too_few
                             : IntervalWidth::as_promised;
}

bool Coverage::holds() const {
  // Too wide is a loss, but no broken promise.
  return std::ranges::none_of(summaries, [this](const CoverageSummary& summary) {
    return width_of(summary) == IntervalWidth::too_narrow;
  });
}

std::vector<Design> coverage_designs() {
  const std::vector<double> two{0.0, 0.0, 0.0, 90.0, 90.0, 90.0};
  const std::vector<double> three = three_orientations().degrees;
  return {{"0, 90 deg", two},
          {"0, 45, 90 deg", three},
          {"0, 90 deg, specimens 10 % apart", two, 0.1},
          {"0, 45, 90 deg, specimens 10 % apart", three, 0.1}};
}

Coverage measure_coverage(const std::vector<Design>& designs, int studies, int threads,
                          const std::function<bool()>& go_on, const sim::StopAsked& stop_asked) {
  Coverage coverage;
  for (const Design& design : designs)
    for (int number = 1; number <= studies; ++number) {
      coverage.complete = coverage.complete && go_on();
      if (!coverage.complete) break;
      KnownStudy known = known_study(design, number);
      known.study.calibrate.threads = threads;
      // `known_study` turns profiles off; a fit has them by default, and its intervals rest on
      // them.
      known.study.calibrate.profiles = true;
      const CalibrationResult result = calibrate(known.study, nullptr, {}, stop_asked);
      // A fit that was stopped gives no rows, as its intervals promise nothing.
      coverage.complete = result.status != CalibrationStatus::cancelled;
      if (!coverage.complete) break;
      add_rows(design, number, known, result, coverage);
    }
  for (const Design& design : designs)
    for (const char* parameter : design.parameters)
      coverage.summaries.push_back(summary_of(design.name, parameter, coverage.rows));
  return coverage;
}

}  // namespace havers::calib
