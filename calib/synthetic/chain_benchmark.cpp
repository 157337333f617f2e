#include "calib/synthetic/chain_benchmark.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "calib/fit/calibration.hpp"
#include "sim/stopwatch.hpp"

namespace havers::calib {
namespace {

// Steps along the axis of cost, even in its logarithm.
constexpr int steps_of_progress = 24;
// An error that is larger by less than a tenth is no reason to prefer another chain.
constexpr double equal_error = 1.1;

// Root mean square of log(value/truth) over the parameters for which `counts` is true; 0 where it
// is for none.
template <class Counts>
double log_error(const std::vector<std::pair<std::string, double>>& values, const KnownStudy& known,
                 Counts counts) {
  double sum = 0.0;
  int n = 0;
  for (std::size_t k = 0; k < known.truth.size(); ++k)
    for (const auto& [name, value] : values) {
      if (name != known.parameters.at(k) || !counts(name)) continue;
      sum += std::pow(std::log(value / known.truth.at(k)), 2);
      ++n;
    }
  return std::sqrt(sum / std::max(n, 1));
}

// Fits a copy of the study. The row's success says only that the fit converged; `judge` compares it
// with the other chains.
ChainRow fit_by(const Chain& chain, KnownStudy known, int number) {
  known.study.calibrate.global = chain.global;
  known.study.calibrate.local = chain.local;
  known.study.calibrate.smooth = chain.smooth;
  ChainRow row{.chain = chain.name, .study = number};
  struct Step {
    TracePoint point;
    std::vector<std::pair<std::string, double>> best;
  };
  std::vector<Step> steps;
  const sim::Stopwatch stopwatch;
  // Without a store: what another chain has simulated before would cost this one nothing.
  const CalibrationResult result =
      calibrate(known.study, nullptr, [&](const CalibrationProgress& progress) {
        steps.push_back({{progress.simulated, stopwatch.wall_seconds(), 0.0}, progress.best});
        return true;
      });
  row.seconds = stopwatch.wall_seconds();
  row.cost = result.cost;
  row.simulations = result.simulated;
  row.success = result.status == CalibrationStatus::converged;

  const auto informed = [&](const std::string& name) {
    return std::ranges::find(result.fitted, name) != result.fitted.end();
  };
  std::vector<std::pair<std::string, double>> answer;
  for (const auto& parameter : result.parameters)
    answer.emplace_back(parameter.name, parameter.value);
  row.informed = static_cast<int>(result.fitted.size());
  row.error = log_error(answer, known, informed);
  // Only the answer says which parameters are informed; all points of a trace are judged by the
  // same ones.
  for (Step& step : steps) {
    step.point.error = log_error(step.best, known, informed);
    row.trace.push_back(step.point);
  }
  return row;
}

// A success costs at most ½ more than the best chain of the same study, be that converged or not.
void judge(std::vector<ChainRow>& rows) {
  for (ChainRow& row : rows)
    for (const ChainRow& other : rows)
      if (other.study == row.study && row.cost > other.cost + 0.5) row.success = false;
}

// Quantiles of the error over cost: at each step every row counts by its last point that cost no
// more, or else by its first. Empty where a fit told of no progress.
template <class Cost>
std::vector<Progress> progress_of(const std::vector<const ChainRow*>& rows, Cost cost) {
  double first = INFINITY, last = 0.0;
  for (const ChainRow* row : rows) {
    if (row->trace.empty()) return {};
    // The axis is logarithmic: a cost of 0 has no place on it.
    first = std::min(first, std::max(cost(row->trace.front()), 1e-3));
    last = std::max(last, cost(row->trace.back()));
  }
  std::vector<Progress> progress;
  for (int i = 0; i <= steps_of_progress; ++i) {
    Progress& step = progress.emplace_back();
    step.cost = first * std::pow(last / first, static_cast<double>(i) / steps_of_progress);
    std::vector<double> errors;
    for (const ChainRow* row : rows) {
      const TracePoint* reached = &row->trace.front();
      for (const TracePoint& point : row->trace)
        // The last step equals the largest cost only up to rounding.
        if (cost(point) <= step.cost * (1.0 + 1e-9)) reached = &point;
      errors.push_back(reached->error);
    }
    step.error = quantiles_of(std::move(errors));
  }
  return progress;
}

ChainSummary summary_of(const std::string& chain, const std::vector<ChainRow>& rows) {
  std::vector<const ChainRow*> own;
  std::vector<double> errors, simulations, seconds;
  int successes = 0;
  for (const ChainRow& row : rows) {
    if (row.chain != chain) continue;
    own.push_back(&row);
    errors.push_back(row.error);
    simulations.push_back(static_cast<double>(row.simulations));
    seconds.push_back(row.seconds);
    successes += row.success ? 1 : 0;
  }
  return {.chain = chain,
          .error = quantiles_of(errors),
          .simulations = quantiles_of(simulations),
          .seconds = quantiles_of(seconds),
          .success = rate_of(successes, static_cast<int>(own.size())),
          .by_simulations = progress_of(
              own, [](const TracePoint& point) { return static_cast<double>(point.simulations); }),
          .by_seconds = progress_of(own, [](const TracePoint& point) { return point.seconds; })};
}

}  // namespace

std::vector<Chain> all_chains(CostlyUnknowns unknowns) {
  using enum GlobalSearch;
  // BOBYQA cannot do with one unknown.
  const bool two = unknowns == CostlyUnknowns::two;
  const std::string local = two ? "BOBYQA" : "COBYLA";
  std::vector<Chain> chains{{.name = "starts, " + local + ", least squares"},
                            {.name = "starts, " + local, .smooth = false},
                            {.name = "starts, Sbplx, least squares", .local = LocalSearch::sbplx},
                            {.name = "CRS2, " + local + ", least squares", .global = crs2},
                            {.name = "DIRECT-L, " + local + ", least squares", .global = direct},
                            {.name = "MLSL, " + local + ", least squares", .global = mlsl},
                            {.name = "ESCH, " + local + ", least squares", .global = esch}};
  if (two)
    chains.push_back({.name = "starts, COBYLA, least squares", .local = LocalSearch::cobyla});
  return chains;
}

std::vector<const ChainSummary*> ChainBenchmark::contenders() const {
  std::vector<const ChainSummary*> left;
  const auto keep = [&](auto&& worth) {
    std::erase_if(left, [&](const ChainSummary* one) { return !worth(*one); });
  };
  for (const ChainSummary& summary : summaries) left.push_back(&summary);
  double most = 0.0, least = INFINITY;
  for (const ChainSummary* one : left) most = std::max(most, one->success.part);
  // Successes count first: a chain that stops in worse minima is cheap.
  keep([&](const ChainSummary& one) { return one.success.part == most; });
  for (const ChainSummary* one : left) least = std::min(least, one->error[2]);
  keep([&](const ChainSummary& one) { return one.error[2] <= equal_error * least; });
  return left;
}

const ChainSummary& ChainBenchmark::winner() const {
  assert(!summaries.empty());
  const std::vector<const ChainSummary*> left = contenders();
  return **std::ranges::min_element(left, {}, [](const auto* one) { return one->simulations[1]; });
}

ChainBenchmark summarise(std::vector<ChainRow> rows) {
  ChainBenchmark benchmark{.rows = std::move(rows), .summaries = {}};
  judge(benchmark.rows);
  for (const ChainRow& row : benchmark.rows)
    if (std::ranges::find(benchmark.summaries, row.chain, &ChainSummary::chain) ==
        benchmark.summaries.end())
      benchmark.summaries.push_back(summary_of(row.chain, benchmark.rows));
  return benchmark;
}

ChainBenchmark benchmark_chains(CostlyUnknowns unknowns, int studies, int threads,
                                const std::function<bool()>& go_on) {
  const Design design = unknowns == CostlyUnknowns::two ? unknown_scatter() : three_orientations();
  std::vector<ChainRow> rows;
  for (int number = 1; number <= studies; ++number) {
    KnownStudy known = known_study(design, number);
    known.study.calibrate.threads = threads;
    // Every chain fits the same tests.
    for (const Chain& chain : all_chains(unknowns)) {
      if (!go_on()) return {.rows = std::move(rows), .summaries = {}};
      rows.push_back(fit_by(chain, known, number));
    }
  }
  return summarise(std::move(rows));
}

}  // namespace havers::calib
