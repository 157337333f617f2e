// Pages of two benches: error and time of a solver's settings, and scenes whose answer is known.
#include <fmt/format.h>

#include <cmath>

#include "reports/bench_pages.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

// Two digits are plenty for an error.
std::string error_text(double error) {
  return number(error, 2);
}

// A median of counts.
std::string whole(double value) {
  return std::isfinite(value) ? std::to_string(std::lround(value)) : number(value);
}

std::string setting_text(const sim::BenchSetting& setting) {
  return typeset(to_string(setting));
}

std::string spread_text(const sim::BenchSpread& spread) {
  if (!std::isfinite(spread.median) || spread.low == spread.high) return error_text(spread.median);
  return fmt::format("{} ({} to {})", error_text(spread.median), error_text(spread.low),
                     error_text(spread.high));
}

std::string state_of(const sim::BenchRow& row, double time_limit) {
  if (row.trusted == row.runs) return "";
  if (row.out_of_time == 0)
    return fmt::format("{} of {} not to be trusted", row.runs - row.trusted, row.runs);
  return fmt::format("{} of {} stopped after {}, at a strain of {}", row.out_of_time, row.runs,
                     duration(time_limit), quantity(row.stopped_at.median / in::percent, "%", 3));
}

// A reference that errors cannot be measured against is bad; that nothing else comes near is not
// good.
mstch::node grade_of(const sim::WorkPrecision& study) {
  return grade(study.complete && reference_is_trusted(study),
               cheapest_for_failure(study).has_value());
}

// Medians over the seeds.
mstch::map work_row(const sim::BenchRow& row, bool reference, double time_limit) {
  return {{"setting", text(setting_text(row.setting) + (reference ? " (reference)" : ""))},
          {"state", text(state_of(row, time_limit))},
          {"forces", text(error_text(row.errors.bonded_forces.median))},
          {"forces_end", text(error_text(row.errors.forces.median))},
          {"breaks", text(whole(row.same_breaks.median))},
          {"strength", text(error_text(row.errors.strength.median))},
          {"without_ringing", text(error_text(row.errors.strength_without_ringing.median))},
          {"failure_strain", text(error_text(row.errors.failure_strain.median))},
          {"failure_range", text(spread_text(row.errors.failure_strain))},
          {"curve", text(error_text(row.errors.curve.median))},
          {"wall", text(number(row.wall.median, 3))},
          {"cpu", text(number(row.cpu.median, 3))},
          {"steps", text(whole(row.steps.median))},
          {"iterations", text(whole(row.iterations.median))}};
}

// If the reference itself may err by more than the target, no setting can be judged by it.
std::string setting_text(const sim::CheapestSetting& cheapest, const sim::BenchRow* row) {
  if (row != nullptr) return setting_text(row->setting);
  if (cheapest.reference_error <= cheapest.target) return "no setting reaches it";
  if (std::isnan(cheapest.reference_error))
    return "cannot be told: what the reference may err by is not known";
  return "cannot be told: the reference may err by " + error_text(cheapest.reference_error);
}

mstch::array cheapest_rows(const sim::WorkPrecision& study) {
  return list_of(study.cheapest, [&](const sim::CheapestSetting& cheapest) {
    const sim::BenchRow* row = cheapest.row ? &study.rows[*cheapest.row] : nullptr;
    return mstch::map{{"quantity", text(cheapest.quantity)},
                      {"target", text(fmt::format("{:g}", cheapest.target))},
                      {"setting", text(setting_text(cheapest, row))},
                      {"cpu", text(row ? number(row->cpu.median, 3) : "–")}};
  });
}

// The headline speaks of the failure strain alone.
std::string what_reference_errs_by(const sim::BenchErrors& errors) {
  if (!(errors.strength.high > 0.0)) return "";
  const auto percent = [](double error) { return quantity(error / in::percent, "%", 2); };
  return fmt::format(
      " The reference's own strength may err by {}, that without ringing by {}, its failure strain "
      "by {}, the largest of all seeds.",
      percent(errors.strength.high), percent(errors.strength_without_ringing.high),
      percent(errors.failure_strain.high));
}

std::string what_errors_are_of(const sim::WorkPrecision& study) {
  return fmt::format(
      " Errors are relative to {}, of the same seed: {}.{}{}", study.reference_ground,
      setting_text(study.reference),
      study.closed_form
          ? " Those of joint forces before the first break are relative to their closed form."
          : "",
      what_reference_errs_by(study.reference_errors));
}

// A scene that was refused was not run and has no numbers.
mstch::map stability_row(const sim::StabilityResult& result) {
  const bool ran = result.outcome != sim::StabilityOutcome::refused;
  const auto if_ran = [&](double value) { return text(ran ? error_text(value) : "–"); };
  return {{"name", text(typeset(result.name))},
          {"grade", text(result.as_it_must ? "pass" : "fail")},
          {"outcome", text(to_string(result.outcome))},
          {"reason", text(typeset(result.reason))},
          {"error", if_ran(result.error)},
          {"residual", if_ran(result.residual)},
          {"energy", if_ran(result.energy_defect)},
          {"penetration", if_ran(result.penetration)},
          {"wall", text(ran ? number(1e3 * result.wall, 2) : "–")}};
}

}  // namespace

std::string work_precision_page(const sim::Scene& scene, const sim::WorkPrecision& study,
                                const calib::Provenance& provenance) {
  mstch::array rows;
  for (const sim::BenchRow& row : study.rows)
    rows.emplace_back(work_row(row, rows.empty(), study.time_limit));
  return render_page(
      "havers bench: error against run time", "bench",
      {{"sentence", text(typeset(summary(study)))},
       {"detail", text(fmt::format("{} × {} fibres, {}.{}", scene.assembly.fibres,
                                   scene.assembly.layers, count(study.seeds.size(), "seed"),
                                   study.rows.empty() ? "" : what_errors_are_of(study)))},
       {"has_rows", !study.rows.empty()},
       {"grade", grade_of(study)},
       {"figure", text(work_precision_svg(study))},
       {"strain", text(quantity(study.bonded_strain / in::percent, "%", 3))},
       {"cheapest", cheapest_rows(study)},
       {"twice",
        text(study.reference.step ? typeset(sim::step_in_words(2.0 * *study.reference.step)) : "")},
       {"omissions", text(study.omissions ? typeset(explain(*study.omissions)) : "")},
       {"rows", rows}},
      provenance);
}

std::string stability_page(const sim::StabilityBench& bench, const calib::Provenance& provenance) {
  return render_page("havers bench: stiff and extreme scenes", "stability",
                     {{"sentence", text(summary(bench))},
                      {"detail", text("h c/L is the time step over L/c, the time that a wave takes "
                                      "along a fibre.")},
                      {"grade", grade(bench.good())},
                      {"rows", list_of(bench.scenes, stability_row)}},
                     provenance);
}

}  // namespace havers::reports
