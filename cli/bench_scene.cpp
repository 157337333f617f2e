// havers bench SCENE: one scene by several solvers, tolerances, steps and meshes.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "cli/bench.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_folder.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"
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

void print_summary(const sim::WorkPrecision& study) {
  fmt::print("{}\n\n{:<46}{:>14}{:>10}{:>10}{:>10}\n", summary(study), "relative errors",
             "joint forces", "strength", "strain", "CPU (s)");
  for (const sim::BenchRow& row : study.rows)
    fmt::print("{:<46}{:>14.1e}{:>10.1e}{:>10.1e}{:>10.2g}{}\n", to_string(row.setting),
               row.errors.bonded_forces.median, row.errors.strength.median,
               row.errors.failure_strain.median, row.cpu.median,
               row.trusted < row.runs ? "  not trusted" : "");
}

}  // namespace

int bench_scene(const BenchArguments& arguments, const CommonOptions& common) {
  if (arguments.scene.empty())
    throw io::InputError("havers bench", "no scene is given", "havers bench SCENE.toml -o DIR");
  const Stopwatch watch;
  io::SceneFile file = io::read_scene(arguments.scene, common.set);
  if (common.seed) file.scene.joints.seed = *common.seed;
  OutputFolder output(arguments.folder, common.force);

  const sim::WorkPrecision study = watched(file.scene, arguments, common);
  const io::Provenance provenance = provenance_of(common, file.inputs, watch);
  const nlohmann::json result = io::work_precision_json(file.scene, study, provenance);
  io::write_file(output.stage("result.json"), io::json_text(result));
  io::write_file(output.stage("bench.csv"), io::work_precision_csv(study));
  if (reports::available()) {
    io::write_file(output.stage("work_precision.svg"), reports::work_precision_svg(study));
    io::write_file(output.stage("report.html"),
                   reports::work_precision_page({file.scene, study, page_facts(provenance)}));
  }
  output.publish();
  if (common.json)
    fmt::print("{}", io::json_text(result));
  else {
    print_summary(study);
    fmt::print("{}\n",
               (output.folder() / (reports::available() ? "report.html" : "result.json")).string());
  }
  return study.complete && reference_is_trusted(study) ? done : answer_is_no;
}

}  // namespace havers::cli
