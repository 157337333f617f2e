// havers bench --stability: stiff and extreme scenes whose answer is known.
#include <fmt/core.h>

#include <algorithm>
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

std::vector<sim::StabilityResult> run_all(const CommonOptions& common) {
  ProgressLine line(common);
  std::vector<sim::StabilityResult> results;
  for (const sim::StabilityScene& scene : sim::stability_scenes()) {
    if (interrupted()) break;
    if (line.due()) line.show(scene.name);
    results.push_back(sim::run_stability_scene(scene, interrupted));
  }
  return results;
}

void print_summary(const std::vector<sim::StabilityResult>& results) {
  fmt::print("{}\n", sim::summary(results));
  for (const sim::StabilityResult& result : results)
    if (!result.as_it_must)
      fmt::print("{:<8} {}: {}\n", to_string(result.outcome), result.name, result.reason);
}

}  // namespace

int bench_stability(const BenchArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  OutputFolder output(arguments.folder, common.force);
  const std::vector<sim::StabilityResult> results = run_all(common);
  const io::Provenance provenance = provenance_of(common, {}, watch);
  const nlohmann::json result = io::stability_json(results, provenance);
  output.write("result.json", io::json_text(result));
  output.write("stability.csv", io::stability_csv(results));
  if (reports::available())
    output.write("report.html", reports::stability_page(results, page_facts(provenance)));
  answer(common, &output, result, page_or("result.json"), [&] { print_summary(results); });
  const bool good = std::ranges::all_of(results, &sim::StabilityResult::as_it_must);
  return good && !interrupted() ? done : answer_is_no;
}

}  // namespace havers::cli
