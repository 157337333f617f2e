// Each step needs what those before it have put right: channels are cleaned before their ranges are
// used, the end is found before the strength, slips are taken back before the modulus is fitted,
// and the toe is removed by the line of the modulus.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "calib/count.hpp"
#include "calib/experiment/channel_noise.hpp"
#include "calib/experiment/clean_channels.hpp"
#include "calib/experiment/engineering_curve.hpp"
#include "calib/experiment/gauge_slip.hpp"
#include "calib/experiment/measured_test.hpp"
#include "calib/experiment/modulus.hpp"
#include "calib/experiment/quality.hpp"
#include "calib/experiment/record_end.hpp"

namespace havers::calib {
namespace {

constexpr double MPa = 1e-6;       // per Pa
constexpr double percent = 100.0;  // per unit strain

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void truncate(MeasuredTest& test, std::size_t rows) {
  test.strain.resize(rows);
  test.stress.resize(rows);
  if (!test.time.empty()) test.time.resize(rows);
}

void drop_first(MeasuredTest& test, std::size_t rows) {
  const auto count = static_cast<std::ptrdiff_t>(rows);
  test.strain.erase(test.strain.begin(), test.strain.begin() + count);
  test.stress.erase(test.stress.begin(), test.stress.begin() + count);
  if (!test.time.empty()) test.time.erase(test.time.begin(), test.time.begin() + count);
}

// The strain is zeroed at the preload, the stress is not: the toe correction brings them together.
void note_preload(MeasuredTest& test) {
  const double preload = test.stress.front();
  if (preload <= 3.0 * test.strength_standard_error) return;
  test.corrections.push_back(
      {"preload", fmt::format("{:.4g} MPa on the specimen at the first row; kept in the stress",
                              preload * MPa)});
}

std::size_t row_of_strength(const MeasuredTest& test) {
  return static_cast<std::size_t>(std::ranges::max_element(test.stress) - test.stress.begin());
}

// (X20) Whether the specimen broke, and the rows that tell of it.
void find_end(const RawTest& raw, const ReductionOptions& options, MeasuredTest& test) {
  // The crosshead is asked only beside a gauge: without one it is the strain already.
  const auto crosshead = raw.strain.empty() ? std::span<const double>{} : std::span(raw.extension);
  const RecordEnd end = end_of_record(test, crosshead, options.break_part);
  test.broke = end.broke;
  append(test.warnings, end.warnings);
  if (!options.cut_after_break || end.rows == test.stress.size()) return;
  test.corrections.push_back(end.cut);
  truncate(test, end.rows);
}

// Nothing presses a specimen by as much before it is stretched, but a load cell may not be at zero.
std::string load_below_zero(const MeasuredTest& test) {
  constexpr double least = 0.025;  // of the strength, as of a load after the break (X20)
  // One row may be a glitch.
  const std::size_t rows = std::min<std::size_t>(3, test.stress.size());
  const double first = std::ranges::max(std::span(test.stress).first(rows));
  if (first > -least * test.strength) return {};
  return fmt::format(
      "the load begins at {:.3g} MPa, {:.1f} % of the strength below zero: if the load cell was "
      "not zeroed without the specimen, the strength is too low by that",
      first * MPa, -percent * first / test.strength);
}

// Precondition: only the end has been cut, so that rows of `raw` are those of the test.
void find_strength(const RawTest& raw, MeasuredTest& test) {
  test.strength = test.stress[row_of_strength(test)];
  if (!raw.force.empty())
    test.max_force = std::ranges::max(std::span(raw.force).first(test.stress.size()));
  for (std::string doubt : {jump_of_stress(test), drop_of_stress(test), load_below_zero(test)})
    if (!doubt.empty()) test.warnings.push_back(std::move(doubt));
}

// Why no line goes through the rows of the window: they are too few, or all of one strain.
std::string without_line(const MeasuredTest& test, RowRange window,
                         const ReductionOptions& options) {
  const double low = options.window_low * test.strength * MPa;
  const double high = options.window_high * test.strength * MPa;
  if (window.rows() >= 3)
    return fmt::format(
        "the stress does not grow with the strain, which is {:.4g} % in all {} rows between {:.4g} "
        "and {:.4g} MPa: the gauge did not record, or another column is the strain",
        test.strain[window.first] * percent, window.rows(), low, high);
  return fmt::format(
      "too few rows between {:.4g} and {:.4g} MPa for a modulus: "
      "reduction.window_low and window_high put these at {:g} and {:g} of the "
      "strength",
      low, high, options.window_low, options.window_high);
}

// (X3) In the rows of the last loading; in all rows where it begins within the window. Returns why
// there is no modulus; empty when there is one.
std::string take_modulus(MeasuredTest& test, const ReductionOptions& options, ModulusFit& fit) {
  const std::size_t loading = row_of_strength(test) + 1;
  const auto strain = std::span(test.strain).first(loading);
  const auto stress = std::span(test.stress).first(loading);
  std::size_t first = last_loading(strain, stress);
  if (stress[first] > options.window_low * test.strength) first = 0;
  fit = fit_modulus(strain.subspan(first), stress.subspan(first), test.strength, options);
  fit.window.first += first;
  fit.window.last += first;
  if (!fit.line.fitted) return without_line(test, fit.window, options);
  if (fit.line.slope <= 0.0) return "the stress does not grow with the strain";
  test.modulus = fit.line.slope;
  test.modulus_standard_error = fit.line.slope_standard_error;
  test.window_low = test.strain[fit.window.first];
  test.window_high = test.strain[fit.window.last - 1];
  append(test.corrections, fit.corrections);
  append(test.warnings, fit.warnings);
  return {};
}

// (X9) The modulus line is made to pass through the origin. What lies before the origin then is
// slack, unless it is but rounding.
void remove_toe(MeasuredTest& test, const Line& line) {
  const double shift = line.intercept / line.slope;
  for (double& strain : test.strain) strain += shift;
  test.window_low += shift;
  test.window_high += shift;
  std::string detail = fmt::format(
      "strain shifted by {:+.5f} % so that the modulus line passes through zero", shift * percent);
  const double rounding = 1e-12 * test.window_high;
  const auto origin =
      std::ranges::find_if(test.strain, [&](double strain) { return strain >= -rounding; });
  if (const auto slack = static_cast<std::size_t>(origin - test.strain.begin()); slack > 0) {
    drop_first(test, slack);
    detail += fmt::format("; {} before it dropped", count(slack, "row"));
  }
  test.corrections.push_back({"toe", detail});
}

// (X15) Trapezia up to the strength, from the origin, which the first row may lie above.
double energy_to(const MeasuredTest& test, std::size_t peak) {
  double energy = 0.5 * test.stress.front() * test.strain.front();
  for (std::size_t i = 1; i <= peak; ++i)
    energy += 0.5 * (test.stress[i] + test.stress[i - 1]) * (test.strain[i] - test.strain[i - 1]);
  return energy;
}

// The curve with what the raw record says of it; the time is moved out of `raw`.
MeasuredTest uncorrected(RawTest& raw, EngineeringCurve curve) {
  MeasuredTest test;
  test.strain = std::move(curve.strain);
  test.stress = std::move(curve.stress);
  test.time = std::move(raw.time);
  test.area = curve.area;
  test.of_crosshead = curve.of_crosshead;
  test.machine_in_strain = curve.machine_in_strain;
  test.corrections = raw.corrections;
  append(test.corrections, curve.corrections);
  test.warnings = raw.warnings;
  append(test.warnings, curve.warnings);
  return test;
}

// What was done and noticed is told all the same.
Reduction unreduced(const MeasuredTest& test, std::vector<std::string> problems) {
  Reduction reduction;
  reduction.test.area = test.area;
  reduction.test.corrections = test.corrections;
  reduction.test.warnings = test.warnings;
  reduction.problems = std::move(problems);
  return reduction;
}

// Only a gauge slips: a crosshead does not.
std::string mend_gauge(const RawTest& raw, const ReductionOptions& options, MeasuredTest& test) {
  if (!options.mend_slips || (test.of_crosshead && !raw.fitted_strain)) return {};
  const SlipRepair repair = mend_slips(test.strain, test.stress, raw.extension);
  append(test.corrections, repair.corrections);
  append(test.warnings, repair.warnings);
  return repair.problem;
}

// (X10) Bone does not stiffen on its way to the break.
void doubt_strain(MeasuredTest& test) {
  constexpr double tolerance = 0.1;
  const double error = 3.0 * test.modulus_standard_error / test.modulus;
  if (test.failure_strain <= 0.0 || test.linearity < 1.0 + tolerance + error) return;
  test.warnings.push_back(
      fmt::format("the strain at the strength is {:.0f} % below what the modulus lets expect: the "
                  "gauge may have slipped or stood still",
                  100.0 * (1.0 - 1.0 / test.linearity)));
}

// What is measured at the strength, after all corrections. The noise is that of the last loading:
// cycles of preload are no noise (X7).
void take_failure(MeasuredTest& test) {
  const std::size_t peak = row_of_strength(test);
  const auto strain = std::span(test.strain).first(peak + 1);
  const auto stress = std::span(test.stress).first(peak + 1);
  test.strength_standard_error = settled_noise_of(stress.subspan(last_loading(strain, stress)));
  test.failure_strain = test.strain[peak];
  test.energy_to_failure = energy_to(test, peak);
  if (!test.time.empty())
    test.strain_rate = loading_rate(strain, std::span(test.time).first(peak + 1));
  test.linearity = test.strength / (test.modulus * test.failure_strain);  // (X10)
  doubt_strain(test);
}

}  // namespace

Reduction reduce_test(const RawTest& recorded, const ReductionOptions& options) {
  assert(recorded.time.empty() || recorded.time.size() == recorded.rows());
  RawTest raw = recorded;
  clean_channels(raw, options);
  turn_negative_load(raw);
  EngineeringCurve curve = engineering_curve(raw, options.machine_compliance);
  const std::vector<std::string> problems = std::move(curve.problems);

  MeasuredTest test = uncorrected(raw, std::move(curve));
  if (!problems.empty()) return unreduced(test, problems);
  test.load_turned = raw.load_turned;
  // A first estimate, by which preload, jumps and drops are judged; `take_failure` replaces it.
  test.strength_standard_error = noise_of(test.stress);
  note_preload(test);
  // The end before the strength: a stress that rises after the break is no strength.
  find_end(raw, options, test);
  find_strength(raw, test);
  // Slips before the modulus, as they bend its window.
  if (std::string problem = mend_gauge(raw, options, test); !problem.empty())
    return unreduced(test, {std::move(problem)});
  ModulusFit fit;
  if (std::string problem = take_modulus(test, options, fit); !problem.empty())
    return unreduced(test, {std::move(problem)});
  // Before failure strain and energy are taken, as it shifts the strain.
  if (options.remove_toe) remove_toe(test, fit.line);
  take_failure(test);
  test.unit_doubt = doubt_of_units(raw, test);
  if (!test.unit_doubt.empty()) test.warnings.push_back(test.unit_doubt);

  Reduction reduction{std::move(test), {}};
  if (options.quality_control) reduction.problems = rejections(reduction.test, options);
  return reduction;
}

}  // namespace havers::calib
