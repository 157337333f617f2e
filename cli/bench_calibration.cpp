// havers bench --calibration: every chain of optimisers on studies of known truth.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "calib/synthetic/chain_benchmark.hpp"
#include "cli/bench.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_folder.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"
#include "io/results/result_files.hpp"

namespace havers::cli {
namespace {

// With fewer an interval of the success rate says nothing.
constexpr int studies = 20;

calib::ChainBenchmark run_chains(const CommonOptions& common) {
  ProgressLine line(common);
  std::size_t fits = 0;
  return calib::benchmark_chains(studies, common.threads, [&] {
    if (line.due())
      line.show(fmt::format("fit {} of {}", fits, studies * calib::all_chains().size()));
    ++fits;
    return !interrupted();
  });
}

void print_chains(const calib::ChainBenchmark& benchmark) {
  fmt::print("{:<38}{:>18}{:>14}{:>10}{:>24}\n", "chain", "error [%]", "simulations", "wall [s]",
             "success (95 %)");
  for (const calib::ChainSummary& s : benchmark.summaries)
    fmt::print("{:<38}{:>18.3g}{:>14.0f}{:>10.2f}{:>24}\n", s.chain, 100.0 * s.error[1],
               s.simulations[1], s.seconds[1],
               fmt::format("{:.0f} % ({:.0f} to {:.0f})", 100.0 * s.success,
                           100.0 * s.success_95[0], 100.0 * s.success_95[1]));
}

}  // namespace

int bench_calibration(const BenchArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  OutputFolder output(arguments.folder, common.force);
  const calib::ChainBenchmark benchmark = run_chains(common);
  const nlohmann::json result = io::chains_json(benchmark, provenance_of(common, {}, watch));
  io::write_file(output.stage("result.json"), result.dump(2) + "\n");
  io::write_file(output.stage("chains.csv"), io::chains_csv(benchmark));
  output.publish();
  if (common.json) {
    fmt::print("{}\n", result.dump(2));
  } else {
    print_chains(benchmark);
    fmt::print("{}\n", (output.folder() / "chains.csv").string());
  }
  return interrupted() ? answer_is_no : done;
}

}  // namespace havers::cli
