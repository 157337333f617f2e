// havers bench --calibration and --coverage: fits of studies whose truth is known.
#include <fmt/core.h>

#include <array>
#include <functional>
#include <nlohmann/json.hpp>

#include "calib/count.hpp"
#include "cli/bench.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_folder.hpp"
#include "cli/progress_line.hpp"
#include "cli/provenance.hpp"
#include "io/results/bench_files.hpp"
#include "reports/bench_pages.hpp"

namespace havers::cli {
namespace {

// With fewer an interval of the success rate, or of the share of intervals that hold, says nothing.
constexpr int chain_studies = 20, coverage_studies = 100;

/// Counts the fits on the terminal; false once the user has had enough.
class FitCounter {
 public:
  FitCounter(const CommonOptions& common, std::size_t fits) : line_(common), fits_(fits) {}

  bool operator()() {
    if (line_.due()) line_.show(fmt::format("fit {} of {}", next_, fits_));
    ++next_;
    return !interrupted();
  }

 private:
  ProgressLine line_;
  std::size_t fits_, next_ = 1;
};

// The median in `unit`; with the 10 and the 90 % quantile if these differ.
std::string spread(const std::array<double, 3>& quantiles, double unit, int digits) {
  if (quantiles[0] == quantiles[2]) return fmt::format("{:.{}g}", quantiles[1] / unit, digits);
  return fmt::format("{:.{}g} ({:.{}g} to {:.{}g})", quantiles[1] / unit, digits,
                     quantiles[0] / unit, digits, quantiles[2] / unit, digits);
}

// Simulations are counted: no part of one is told.
std::string whole(const std::array<double, 3>& counts) {
  if (counts[0] == counts[2]) return fmt::format("{:.0f}", counts[1]);
  return fmt::format("{:.0f} ({:.0f} to {:.0f})", counts[1], counts[0], counts[2]);
}

std::string percent(const calib::Rate& rate) {
  return fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100.0 * rate.part, 100.0 * rate.interval_95[0],
                     100.0 * rate.interval_95[1]);
}

void print_chains(const calib::ChainBenchmark& benchmark) {
  if (benchmark.summaries.empty()) {
    fmt::print("stopped after {}: no chain is summed up\n",
               calib::count(benchmark.rows.size(), "fit"));
    return;
  }
  fmt::print("{:<36}{:>20}{:>22}{:>24}{:>24}\n", "median (10 to 90 %)", "error [%]", "simulations",
             "wall [s]", "success (95 %)");
  for (const calib::ChainSummary& s : benchmark.summaries)
    fmt::print("{:<36}{:>20}{:>22}{:>24}{:>24}\n", s.chain, spread(s.error, 0.01, 2),
               whole(s.simulations), spread(s.seconds, 1.0, 2), percent(s.success));
  fmt::print("fewest simulations of those that succeed most often with the least error: {}\n",
             benchmark.winner().chain);
}

void print_coverage(const calib::Coverage& coverage) {
  if (!coverage.complete) fmt::print("stopped before all studies were fitted\n");
  fmt::print("{:<38}{:<16}{:>10}{:>24}{:>24}  {}\n", "specimens", "parameter", "informed",
             "hold the truth", "half width [%]", "intervals are");
  for (const calib::CoverageSummary& s : coverage.summaries) {
    const bool informed = s.informed > 0;
    fmt::print("{:<38}{:<16}{:>10}{:>24}{:>24}  {}\n", s.design, s.parameter,
               fmt::format("{} of {}", s.informed, s.studies), informed ? percent(s.inside) : "-",
               informed ? spread(s.half_width, 0.01, 2) : "-",
               informed ? to_string(coverage.width_of(s)) : "-");
  }
}

}  // namespace

int bench_calibration(const BenchArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  OutputFolder output(arguments.folder, common.force);
  const int studies = arguments.studies > 0 ? arguments.studies : chain_studies;
  const auto costly =
      arguments.costly == 2 ? calib::CostlyUnknowns::two : calib::CostlyUnknowns::one;
  const auto fits = static_cast<std::size_t>(studies) * calib::all_chains(costly).size();
  // Every chain fits every study.
  FitCounter counter(common, fits);
  const calib::ChainBenchmark benchmark =
      calib::benchmark_chains(costly, studies, common.threads, std::ref(counter));
  const calib::Provenance provenance = provenance_of(common, {}, watch);
  const bool summed_up = !benchmark.summaries.empty();
  leave({.result = io::chains_json(benchmark, provenance),
         .csv_name = "chains.csv",
         .csv = io::chains_csv(benchmark),
         .page =
             reports::available() && summed_up ? reports::chains_page(benchmark, provenance) : ""},
        common, output, [&] { print_chains(benchmark); });
  // The first chain is the one that fits use by default.
  const bool usual_wins =
      summed_up && benchmark.winner().chain == benchmark.summaries.front().chain;
  return usual_wins ? done : answer_is_no;
}

int bench_coverage(const BenchArguments& arguments, const CommonOptions& common) {
  const Stopwatch watch;
  OutputFolder output(arguments.folder, common.force);
  const int studies = arguments.studies > 0 ? arguments.studies : coverage_studies;
  const auto designs = calib::coverage_designs();
  FitCounter counter(common, designs.size() * static_cast<std::size_t>(studies));
  const calib::Coverage coverage =
      calib::measure_coverage(designs, studies, common.threads, std::ref(counter), interrupted);
  const calib::Provenance provenance = provenance_of(common, {}, watch);
  leave({.result = io::coverage_json(coverage, provenance),
         .csv_name = "coverage.csv",
         .csv = io::coverage_csv(coverage),
         .page = reports::available() ? reports::coverage_page(coverage, provenance) : ""},
        common, output, [&] { print_coverage(coverage); });
  return coverage.holds() && coverage.complete ? done : answer_is_no;
}

}  // namespace havers::cli
