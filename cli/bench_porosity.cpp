// havers bench --porosity: common practice and ours on drawn sections of known porosity.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "cli/bench.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_folder.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"
#include "io/images/section_benchmark.hpp"
#include "io/results/bench_files.hpp"
#include "reports/bench_pages.hpp"

namespace havers::cli {
namespace {

// Not in parallel, as the CPU times are those of the whole process. Each section overwrites
// `image`, which is removed at the end.
calib::MethodComparison try_all(const BenchArguments& arguments, const CommonOptions& common,
                                const std::filesystem::path& image) {
  ProgressLine line(common);
  std::vector<calib::PorosityTrial> trials;
  const std::vector<io::SectionCase> cases = io::section_cases(arguments.seeds);
  for (const io::SectionCase& next : cases) {
    // A comparison needs at least one trial.
    if (interrupted() && !trials.empty()) break;
    if (line.due()) line.show(next.hardship);
    trials.push_back(io::try_section(next, image));
  }
  std::filesystem::remove(image);
  const bool complete = trials.size() == cases.size();
  calib::MethodComparison comparison = calib::compare_methods(std::move(trials));
  comparison.complete = complete;
  return comparison;
}

void print_methods(const calib::MethodComparison& comparison) {
  if (!comparison.complete) fmt::print("stopped before all sections were measured\n");
  fmt::print("{:<40}{:>12}{:>12}{:>14}{:>10}\n", "errors in points of porosity", "median", "worst",
             "without pores", "MPix/s");
  for (const calib::MethodSummary& method : comparison.methods)
    fmt::print("{:<40}{:>12.3f}{:>12.3f}{:>14.3f}{:>10.1f}\n", to_string(method.method),
               100.0 * method.median_error, 100.0 * method.worst_error,
               100.0 * method.worst_if_none, 1e-6 / method.cpu_per_pixel);
}

}  // namespace

int bench_porosity(const BenchArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  OutputFolder output(arguments.folder, common.force);
  const calib::MethodComparison comparison =
      try_all(arguments, common, output.stage("section.png"));
  const calib::Provenance provenance = provenance_of(common, {}, watch);
  leave({.result = io::methods_json(comparison, provenance),
         .csv_name = "porosity.csv",
         .csv = io::methods_csv(comparison),
         .page = reports::available() ? reports::methods_page(comparison, provenance) : ""},
        common, output, [&] { print_methods(comparison); });
  return comparison.good() && comparison.complete ? done : answer_is_no;
}

}  // namespace havers::cli
