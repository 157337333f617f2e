// havers fit: read, reduce, calibrate, check, report.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/fit_files.hpp"
#include "cli/fit_summary.hpp"
#include "cli/interrupt.hpp"
#include "cli/kept_run.hpp"
#include "cli/load_study.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"

namespace havers::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* fit_examples =
    "  havers fit data_samples/bone_bars/study.toml -o runs/first\n"
    "  havers fit data_samples/bone_bars/study.toml -o runs/first   # after Ctrl-C: goes on\n"
    "  havers fit data_samples/bone_bars/study.toml -o runs/wide --seed 2 "
    "--set calibrate.options.replicates=16\n";

struct FitArguments {
  fs::path study, folder;
};

std::string progress_text(const calib::CalibrationProgress& progress) {
  std::string text = fmt::format("{}  {} simulations  cost {:.4g}", progress.stage,
                                 progress.evaluations, progress.best_cost);
  for (const auto& [name, value] : progress.best) text += fmt::format("  {} {:.4g}", name, value);
  return text;
}

// Looks for Ctrl-C whenever the fit reports progress, and inside simulations, which may be long.
calib::CalibrationResult watched_fit(const calib::Study& study, calib::EvaluationStore& store,
                                     const CommonOptions& common) {
  ProgressLine line(common);
  const auto watch = [&line](const calib::CalibrationProgress& progress) {
    if (line.due()) line.show(progress_text(progress));
    return !interrupted();
  };
  return calib::calibrate(study, &store, watch, interrupted);
}

// A test that cannot be used is a reservation: of the bones that were tested the fit knows fewer.
void tell_left_out(const std::vector<sim::LeftOut>& specimens, calib::CalibrationResult& result) {
  if (specimens.empty()) return;
  std::vector<std::string> each;
  each.reserve(specimens.size());
  for (const sim::LeftOut& specimen : specimens)
    each.push_back(fmt::format("{} ({})", specimen.what, specimen.why));
  result.left_out.insert(result.left_out.begin(), specimens.begin(), specimens.end());
  result.verdict.push_back(
      {"tests used", calib::Outcome::warn, fmt::format("Left out: {}.", fmt::join(each, "; "))});
}

int run_fit(const FitArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  LoadedStudy loaded = load_study(arguments.study, common.set);
  loaded.study.calibrate.threads = common.threads;
  if (common.seed) loaded.study.calibrate.seed = *common.seed;
  for (const std::string& doubt : loaded.all_notes()) note(common, "note: " + doubt);

  // Now, as files may be changed during the fit.
  Digests inputs = digests_of(loaded.inputs);
  catch_interrupts();
  KeptRun run("fit", {arguments.study}, loaded.inputs, arguments.folder, common);
  calib::CalibrationResult result = watched_fit(loaded.study, run.store(), common);
  // Only those of the study: notes on files are already in its tests and sections.
  result.notes = loaded.notes;
  tell_left_out(loaded.left_out, result);
  if (result.status == calib::CalibrationStatus::cancelled)
    // The store lies in the target itself: what was simulated stays there.
    return without_result(common, "cancelled",
                          fmt::format("stopped by you; the simulations so far are kept in {}: the "
                                      "same command goes on from there",
                                      run.output().folder().string()));

  const calib::Provenance provenance = provenance_of(common, std::move(inputs), watch);
  const nlohmann::json json = write_fit(run.output(), loaded, result, provenance);
  answer(common, &run.output(), json, page_or("result.json"),
         [&] { print_fit_summary(result, provenance.wall_seconds, common.verbose); });
  return result.trusted() ? done : answer_is_no;
}

}  // namespace

Command fit_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser = add_command(app, common, "fit",
                                 "calibrate the model to a study's tests and report", fit_examples);
  const auto arguments = std::make_shared<FitArguments>();
  parser->add_option("STUDY", arguments->study, "study file (TOML)")->required();
  add_output(*parser, arguments->folder, "folder for the results")->required();
  return {parser, [arguments, &common] { return run_fit(*arguments, common); }};
}

}  // namespace havers::cli
