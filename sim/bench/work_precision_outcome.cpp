// What a bench's rows come to: the cheapest settings, and the outcome in words.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/bench/work_precision.hpp"

namespace havers::sim {
namespace {

// Whether every run of a row is to be trusted, has this error, and has the reference's mesh. That
// of twice the reference's step is what the reference is judged by.
bool is_judged(const WorkPrecision& study, const BenchRow& row, const BenchSpread& error) {
  const std::optional<double>& step = study.reference.step;
  if (step && row.setting.step == 2.0 * *step) return false;
  return row.setting.refinement == study.reference.refinement && row.trusted == row.runs &&
         error.of == row.runs;
}

// Of those that are judged; null where there is none. Precondition: the reference has a row.
const BenchRow* nearest_to_failure(const WorkPrecision& study) {
  const BenchRow* nearest = nullptr;
  for (const BenchRow& row : std::span(study.rows).subspan(1)) {
    const BenchSpread& error = row.errors.failure_strain;
    if (!is_judged(study, row, error)) continue;
    if (nearest == nullptr || error.high < nearest->errors.failure_strain.high) nearest = &row;
  }
  return nearest;
}

}  // namespace

std::vector<CheapestSetting> cheapest_settings(const WorkPrecision& study) {
  std::vector<CheapestSetting> all;
  using Quantity = std::pair<const char*, BenchSpread BenchErrors::*>;
  const std::array quantities{
      Quantity{"joint forces before the first break", &BenchErrors::bonded_forces},
      Quantity{"strength", &BenchErrors::strength},
      Quantity{"strength without ringing", &BenchErrors::strength_without_ringing},
      Quantity{"failure strain", &BenchErrors::failure_strain},
      Quantity{"curve", &BenchErrors::curve}};
  for (const auto& [quantity, error] : quantities)
    for (const double target : {1e-2, 1e-3, 1e-4}) {
      CheapestSetting cheapest{.quantity = quantity,
                               .target = target,
                               .reference_error = (study.reference_errors.*error).high};
      // No row is said to reach a target that the reference itself may miss.
      for (std::size_t i = 1; i < study.rows.size(); ++i) {  // the first is the reference
        const BenchRow& row = study.rows[i];
        if (!is_judged(study, row, row.errors.*error)) continue;
        if (!((row.errors.*error).high <= target && cheapest.reference_error <= target)) continue;
        if (!cheapest.row || row.cpu.median < study.rows[*cheapest.row].cpu.median)
          cheapest.row = i;
      }
      all.push_back(cheapest);
    }
  return all;
}

std::optional<std::size_t> cheapest_for_failure(const WorkPrecision& study) {
  for (const CheapestSetting& cheapest : study.cheapest)
    if (cheapest.quantity == "failure strain" && cheapest.target == 1e-3) return cheapest.row;
  return std::nullopt;
}

std::string summary(const WorkPrecision& study) {
  // What makes the comparison say nothing comes first.
  if (!study.complete) return "Stopped before every setting was run.";
  if (!reference_is_trusted(study))
    return fmt::format("The reference is not to be trusted: {} of {} runs ended well.",
                       study.rows.front().trusted, study.rows.front().runs);
  if (const auto cheapest = cheapest_for_failure(study)) {
    const BenchRow& row = study.rows[*cheapest];
    return fmt::format(
        "Cheapest on the reference's mesh for a failure strain to 0.1 % for every seed: {}, "
        "{:.2g} s of CPU time.",
        to_string(row.setting), row.cpu.median);
  }
  if (const double error = study.reference_errors.failure_strain.high; !(error <= 1e-3))
    return std::isnan(error)
               ? "What the reference's failure strain may err by is not known, as runs of twice "
                 "its step did not end."
               : fmt::format(
                     "The reference's own failure strain may err by {:.2g} %, which a step twice "
                     "as long changes it by: which setting gives it to 0.1 % cannot be told.",
                     100.0 * error);
  const std::string none =
      "On the reference's mesh no other setting gives the failure strain to 0.1 % for every seed";
  const BenchRow* nearest = nearest_to_failure(study);
  if (nearest == nullptr) return none + ".";
  return none + fmt::format("; the nearest comes to {:.2g} %: {}, {:.2g} s of CPU time.",
                            100.0 * nearest->errors.failure_strain.high,
                            to_string(nearest->setting), nearest->cpu.median);
}

std::string explain(const Omissions& omissions) {
  if (omissions.until_strain)
    return fmt::format(
        "With nothing left out runs were stopped at the time limit. Until a strain of {:.3g} % "
        "joint forces differ by {:.1e} at most, and a step takes {:.1f} times the CPU time: {}.",
        100.0 * *omissions.until_strain, omissions.change, omissions.cpu_ratio,
        to_string(omissions.setting));
  return fmt::format(
      "With nothing left out the answer differs by {:.1e} at most and takes {:.1f} times the CPU "
      "time: {}.",
      omissions.change, omissions.cpu_ratio, to_string(omissions.setting));
}

}  // namespace havers::sim
