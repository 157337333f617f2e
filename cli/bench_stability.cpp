// havers bench --stability: stiff and extreme scenes whose answer is known.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "cli/bench.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_folder.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"
#include "io/results/bench_files.hpp"
#include "reports/bench_pages.hpp"

namespace havers::cli {
namespace {

sim::StabilityBench run_all(const CommonOptions& common) {
  ProgressLine line(common);
  sim::StabilityBench bench;
  for (const sim::StabilityScene& scene : sim::stability_scenes()) {
    if (interrupted()) break;
    if (line.due()) line.show(scene.name);
    bench.scenes.push_back(sim::run_stability_scene(scene, interrupted));
  }
  // Also the last scene may have been cut short.
  bench.complete = !interrupted();
  return bench;
}

// The summary, and scenes that did not come out as they must; the CSV has all of them.
void print_summary(const sim::StabilityBench& bench) {
  fmt::print("{}\n", summary(bench));
  for (const sim::StabilityResult& result : bench.scenes)
    if (!result.as_it_must)
      fmt::print("{:<8} {}: {}\n", to_string(result.outcome), result.name, result.reason);
}

}  // namespace

int bench_stability(const BenchArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  OutputFolder output(arguments.folder, common.force);
  const sim::StabilityBench bench = run_all(common);
  const calib::Provenance provenance = provenance_of(common, {}, watch);
  leave({.result = io::stability_json(bench, provenance),
         .csv_name = "stability.csv",
         .csv = io::stability_csv(bench.scenes),
         .page = reports::available() ? reports::stability_page(bench, provenance) : ""},
        common, output, [&] { print_summary(bench); });
  return bench.good() ? done : answer_is_no;
}

}  // namespace havers::cli
