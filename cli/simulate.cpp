// havers simulate: one run of the model.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "calib/count.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_folder.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"
#include "io/results/result_files.hpp"
#include "io/snapshots/snapshots.hpp"
#include "reports/pages.hpp"
#include "sim/dynamics/step_control.hpp"

namespace havers::cli {
namespace {

constexpr const char* simulate_examples =
    "  havers simulate data_samples/scenes/impact.toml -o runs/impact\n"
    "  havers simulate data_samples/scenes/machine.toml -o runs/seed7 --seed 7 --set "
    "joints.scatter=0.4\n"
    "  havers simulate data_samples/scenes/impact.toml -o runs/film "
    "--set output.snapshots=50   # for ParaView; needs VTK\n";

struct SimulateArguments {
  std::filesystem::path scene, folder;
};

// The row shows that a slow run goes on, and by starting anew that a finer one does.
std::string progress_text(const sim::Progress& progress) {
  const sim::CurvePoint& point = progress.point;
  return fmt::format("row {}  strain {:.4f} %  stress {:.2f} MPa  broken joints {}", progress.row,
                     100.0 * point.strain, 1e-6 * point.stress_right, point.broken_joints);
}

// Every row is observed. The terminal shows some of them; the recorder of snapshots chooses its
// own.
sim::Simulation watched_run(const sim::Scene& scene, io::SnapshotRecorder& snapshots,
                            const CommonOptions& common) {
  ProgressLine line(common);
  const auto show = [&](const sim::Progress& progress) {
    if (line.due()) line.show(progress_text(progress));
    snapshots.record(progress);
  };
  return sim::simulate(scene, show, interrupted);
}

// Returns what is in result.json.
nlohmann::json write_results(const OutputFolder& output, const io::SceneFile& file,
                             const sim::Simulation& simulation,
                             const io::SnapshotRecorder& snapshots,
                             const calib::Provenance& provenance) {
  const sim::Scene& scene = file.scene;
  // Built again, as a simulation does not keep its assembly.
  const sim::Assembly assembly = sim::build_assembly(scene.assembly, scene.loading.lateral);
  io::write_curve(output.stage("curve.csv"), simulation);
  io::write_joints(output.stage("joints.csv"), assembly, simulation);
  for (const io::Snapshot& snapshot : snapshots.chosen())
    io::write_vtu(output.stage(fmt::format("snapshots/step_{:06}.vtu", snapshot.row)), assembly,
                  snapshot.displacements, snapshot.joints);
  if (reports::available()) {
    output.write("fracture.svg", reports::fracture_svg(assembly, simulation));
    output.write("avalanche.svg", reports::avalanche_svg(assembly, simulation));
    output.write("report.html",
                 reports::simulation_page({scene, assembly, simulation, provenance,
                                           file.inputs.front().filename().string()}));
  }
  nlohmann::json json = io::simulation_json(file, simulation, provenance);
  output.write("result.json", io::json_text(json));
  return json;
}

// No time without its error. The runs of longer steps were timed too.
std::string steps_text(const sim::Simulation& run) {
  if (run.regime == sim::Regime::quasi_static) return calib::count(run.steps, "event");
  const sim::StepError unknown{NAN, NAN, NAN};
  const sim::StepError error = run.step_error.value_or(unknown);
  return fmt::format("{}{}, {}", calib::count(run.steps, "step"),
                     run.step_error ? " after runs of longer ones" : "",
                     std::isnan(error.failure_strain)
                         ? "whose error is not known"
                         : fmt::format("step error {:.1e} (strength {:.1e})", error.failure_strain,
                                       error.strength));
}

// The verdict, which is printed before all numbers.
std::string headline(const sim::Simulation& run) {
  if (!run.trusted()) return "NOT to be trusted: " + run.why_not_trusted();
  const std::string reservation = run.reservation();
  return reservation.empty()
             ? "to be trusted: " + explain(run)
             : fmt::format("to be trusted but for {}; {}", reservation, explain(run));
}

// A relative error beside a value. Nothing if it is within the accuracy that was asked for.
std::string by_step(double error) {
  return error > 0.0 ? fmt::format(" (± {:.2g} % of it by the step)", 100.0 * error) : "";
}

// Of a run that did not break the largest stress is a bound, and its strain says nothing.
std::string strength_text(const sim::Scene& scene, const sim::Simulation& run) {
  if (std::isnan(run.strength)) return "-";
  const sim::StepError error = run.error_beyond_accuracy();
  std::string strength = fmt::format("{:.4g} MPa{}", 1e-6 * run.strength, by_step(error.strength));
  // Nothing bears a load, so that there is no strain at failure.
  if (run.status == sim::SimulationStatus::severed) return strength;
  if (run.status == sim::SimulationStatus::broken)
    return fmt::format("{} at a strain of {:.4g} %{}", strength, 100.0 * run.failure_strain,
                       by_step(error.failure_strain));
  const bool to_the_limit = run.status == sim::SimulationStatus::strain_limit;
  return fmt::format("at least {}\nfailure strain -, not reached{}", strength,
                     to_the_limit ? fmt::format(" within the strain limit of {:.4g} %",
                                                100.0 * scene.loading.max_strain)
                                  : "");
}

// How many joints broke, at which strain the first one did, and what was not counted.
std::string breaks_text(const sim::Scene& scene, const sim::Simulation& run) {
  std::string breaks = fmt::format("{} of {}", run.broken_joints, run.joints.size());
  if (run.broken_joints > 0)
    breaks += fmt::format(", the first at {:.4g} %", 100.0 * run.first_break_strain);
  if (const long missing = run.missing_joints(); missing > 0)
    breaks += fmt::format("; {} missing from the start", missing);
  if (run.status == sim::SimulationStatus::broken &&
      run.end_fraction_used > scene.loading.end_fraction)
    breaks += fmt::format(
        "; counted down to {:.3g} of the strength (solver.leave_out = false follows on, to {:g})",
        run.end_fraction_used, scene.loading.end_fraction);
  return breaks;
}

std::string small(double value) {
  return value == 0.0 ? "0" : fmt::format("{:.1e}", value);
}

void print_summary(const sim::Scene& scene, const sim::Simulation& run, double wall_seconds,
                   bool verbose) {
  fmt::print("{}\n", headline(run));
  fmt::print("strength       {}\n", strength_text(scene, run));
  if (!std::isnan(run.strength_over_a_wave))
    fmt::print("without waves  {:.4g} MPa{}, the part of it that does not ring\n",
               1e-6 * run.strength_without_ringing(),
               by_step(run.error_beyond_accuracy().over_a_wave));
  if (!std::isnan(run.modulus)) fmt::print("modulus        {:.4g} GPa\n", 1e-9 * run.modulus);
  fmt::print("broken joints  {}\n", breaks_text(scene, run));
  fmt::print("regime         {}: {}\n",
             run.regime == sim::Regime::dynamic ? "dynamic" : "quasi-static", run.regime_ground);
  fmt::print("time           {:.3g} s for {}; energy defect {}, residual {}, penetration {} m\n",
             wall_seconds, steps_text(run), small(run.energy_defect), small(run.worst_residual),
             small(run.worst_penetration));
  if (!verbose) return;
  for (const sim::LeftOut& left_out : run.left_out)
    fmt::print("left out       {}: {}\n", left_out.what, left_out.why);
}

int run_simulate(const SimulateArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  const io::SceneFile file = load_scene(arguments.scene, common, io::Snapshots::written);
  // Now, as files may be changed during the run.
  Digests inputs = digests_of(file.inputs);
  if (const std::string doubt = sim::doubt_about_steps(file.scene); !doubt.empty())
    note(common, "note: " + doubt);
  catch_interrupts();
  io::SnapshotRecorder snapshots(file.snapshots);
  // Before the run, so that a folder that cannot be written is refused at once.
  OutputFolder output(arguments.folder, common.force, file.inputs);
  if (!reports::available())
    note(common, "no report.html and fracture.svg: this build makes no pages (havers --version)");

  const sim::Simulation simulation = watched_run(file.scene, snapshots, common);
  // Without a row there is no result to write.
  if (simulation.curve.empty())
    return without_result(
        common, sim::to_string(simulation.status),
        fmt::format("nothing could be computed and nothing was written: {}; fibres and joints may "
                    "not hold together as one structure",
                    sim::explain(simulation.status)));
  snapshots.finish(simulation);
  const calib::Provenance provenance = provenance_of(common, std::move(inputs), watch);
  const nlohmann::json json = write_results(output, file, simulation, snapshots, provenance);
  answer(common, &output, json, page_or("result.json"),
         [&] { print_summary(file.scene, simulation, provenance.wall_seconds, common.verbose); });
  if (simulation.status == sim::SimulationStatus::cancelled)
    note(common,
         "stopped by you; the rows until then are written. A simulation starts anew: add --force "
         "to run it again.");
  return simulation.trusted() ? done : answer_is_no;
}

}  // namespace

Command simulate_command(CLI::App& app, CommonOptions& common) {
  CLI::App* parser =
      add_command(app, common, "simulate", "one run of the model", simulate_examples);
  const auto arguments = std::make_shared<SimulateArguments>();
  parser->add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
  add_output(*parser, arguments->folder, "folder for the results")->required();
  return {parser, [arguments, &common] { return run_simulate(*arguments, common); }};
}

}  // namespace havers::cli
