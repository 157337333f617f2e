// havers bench SCENE: one scene by several solvers, tolerances, steps and meshes.
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/bench.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_folder.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"
#include "io/config/words.hpp"
#include "io/input_error.hpp"
#include "io/results/bench_files.hpp"
#include "reports/bench_pages.hpp"

namespace havers::cli {
namespace {

sim::WorkPrecision watched(const sim::Scene& scene, const BenchArguments& arguments,
                           const CommonOptions& common) {
  ProgressLine line(common);
  return sim::compare_settings(scene, {.seeds = arguments.seeds}, [&](const std::string& next) {
    if (line.due()) line.show(next);
    return !interrupted();
  });
}

std::string step_text(const sim::BenchSetting& setting) {
  if (sim::has_chosen_steps(setting)) return "chosen";
  return setting.step ? fmt::format("{:.4g}", *setting.step * 1e9) : "-";
}

// Why a row's errors mean little: some of its runs are not to be trusted, or ran out of time.
std::string state_of(const sim::BenchRow& row) {
  if (row.trusted == row.runs) return "";
  return row.out_of_time == 0
             ? "  not trusted"
             : fmt::format("  stopped at {:.3g} % strain", 100.0 * row.stopped_at.median);
}

void print_row(const sim::BenchRow& row, bool reference) {
  const sim::BenchSetting& setting = row.setting;
  fmt::print("{:<14}{:<14}{:>9g}{:>11}{:>12}{:>11}", io::word(setting.regime),
             io::word(setting.contact), setting.tolerance, step_text(setting), setting.refinement,
             setting.leave_out);
  for (const sim::BenchSpread& error :
       {row.errors.bonded_forces, row.errors.strength, row.errors.strength_without_ringing,
        row.errors.failure_strain, row.errors.curve})
    fmt::print("{:>11}", std::isfinite(error.median) ? fmt::format("{:.1e}", error.median) : "-");
  fmt::print("{:>10.2g}{:>10.2g}{:>12.0f}{}{}{}\n", row.wall.median, row.cpu.median,
             row.iterations.median, reference ? "  reference" : "",
             row.setting.leap ? "  from the first break on" : "", state_of(row));
}

void print_summary(const sim::WorkPrecision& study) {
  fmt::print("{}\n", summary(study));
  if (study.rows.empty()) return;
  fmt::print(
      "\n{:<14}{:<14}{:>9}{:>11}{:>12}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}{:>10}{:>10}{:>12}\n",
      "regime", "contact", "tolerance", "step (ns)", "refinement", "leave out", "forces",
      "strength", "no ringing", "strain", "curve", "wall (s)", "CPU (s)", "iterations");
  for (const sim::BenchRow& row : study.rows) print_row(row, &row == &study.rows.front());
  fmt::print(
      "Errors of joint forces, strength, strength without ringing, failure strain and curve are "
      "relative{}; medians over the seeds.\n",
      study.closed_form ? ", those of forces, before the first break, to their closed form" : "");
  const sim::BenchErrors& own = study.reference_errors;
  if (own.strength.high > 0.0)
    fmt::print(
        "The reference itself may err by {:.1e} in strength, {:.1e} in that without ringing, "
        "{:.1e} in failure strain and {:.1e} in the curve, which a step twice as long changes them "
        "by; the largest of all seeds.\n",
        own.strength.high, own.strength_without_ringing.high, own.failure_strain.high,
        own.curve.high);
  if (study.omissions) fmt::print("{}\n", explain(*study.omissions));
}

}  // namespace

int bench_scene(const BenchArguments& arguments, const CommonOptions& common) {
  // Only this mode needs a scene, so that the parser cannot demand one.
  if (arguments.scene.empty())
    throw io::InputError("bench", "no scene is given", "havers bench SCENE.toml -o DIR");
  const Stopwatch watch;
  const io::SceneFile file = load_scene(arguments.scene, common);
  Digests inputs = digests_of(file.inputs);
  OutputFolder output(arguments.folder, common.force, file.inputs);

  const sim::WorkPrecision study = watched(file.scene, arguments, common);
  const calib::Provenance provenance = provenance_of(common, std::move(inputs), watch);
  if (reports::available()) output.write("work_precision.svg", reports::work_precision_svg(study));
  leave({.result = io::work_precision_json(file.scene, study, provenance),
         .csv_name = "bench.csv",
         .csv = io::work_precision_csv(study),
         .page = reports::available() ? reports::work_precision_page(file.scene, study, provenance)
                                      : ""},
        common, output, [&] { print_summary(study); });
  return study.complete && reference_is_trusted(study) ? done : answer_is_no;
}

}  // namespace havers::cli
