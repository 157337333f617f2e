#include "calib/synthetic/chain_benchmark.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "calib/experiment/measured_test.hpp"
#include "calib/fit/calibration.hpp"
#include "calib/fit/scenes.hpp"
#include "calib/study/parameter.hpp"
#include "calib/synthetic/laboratory_record.hpp"
#include "sim/simulate.hpp"

namespace havers::calib {
namespace {

constexpr std::array<const char*, 3> calibrated_names{"young_GPa", "head_tail_MPa", "ratio"};
constexpr std::array<std::pair<double, double>, 3> range_of_truth{
    {{10.0, 20.0}, {50.0, 110.0}, {0.7, 2.5}}};

// Between 0 and 1, by study and purpose alone.
double fraction(int study, std::uint64_t purpose) {
  return static_cast<double>(specimen_seed(static_cast<std::uint64_t>(study), purpose) >> 11U) *
         0x1p-53;
}

Study empty_study(int number) {
  Study study;
  study.name = fmt::format("known {}", number);
  study.model.assembly.layers = 8;
  study.model.assembly.fibres = 6;
  study.model.joints.scatter = 0.3;
  study.model.loading.strain_rate = 1e-3;
  study.porosity.to_scatter = ToScatter::none;
  study.calibrate.bounds = {{"head_tail_MPa", {20.0, 250.0}}, {"ratio", {0.3, 6.0}}};
  study.calibrate.replicates = 4;
  study.calibrate.profiles = false;
  return study;
}

double log_error(const CalibrationResult& result, const std::array<double, 3>& truth,
                 int& informed) {
  double sum = 0.0;
  informed = 0;
  for (std::size_t k = 0; k < calibrated_names.size(); ++k)
    for (const auto& parameter : result.parameters) {
      if (parameter.name != calibrated_names.at(k) || !parameter.identifiable) continue;
      sum += std::pow(std::log(parameter.value / truth.at(k)), 2);
      ++informed;
    }
  return std::sqrt(sum / std::max(informed, 1));
}

ChainRow fit_by(const Chain& chain, Study study, int number, const std::array<double, 3>& truth) {
  study.calibrate.global = chain.global;
  study.calibrate.local = chain.local;
  study.calibrate.smooth = chain.smooth;
  const auto begin = std::chrono::steady_clock::now();
  const CalibrationResult result = calibrate(study);
  ChainRow row{.chain = chain.name, .study = number};
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  row.error = log_error(result, truth, row.informed);
  row.cost = result.cost;
  row.simulations = result.simulated;
  row.success = result.status == CalibrationStatus::converged;
  return row;
}

// A success is as good as the best chain of the same study.
void judge(std::vector<ChainRow>& rows) {
  for (ChainRow& row : rows)
    for (const ChainRow& other : rows)
      if (other.study == row.study && row.cost > other.cost + 0.5) row.success = false;
}

std::array<double, 3> quantiles(std::vector<double> values) {
  std::ranges::sort(values);
  const auto at = [&](double part) {
    return gsl_stats_quantile_from_sorted_data(values.data(), 1, values.size(), part);
  };
  return {at(0.1), at(0.5), at(0.9)};
}

std::array<double, 2> wilson(double successes, double n) {
  const double z = gsl_cdf_ugaussian_Pinv(0.975), part = successes / n;
  const double middle = (part + 0.5 * z * z / n) / (1.0 + z * z / n);
  const double half =
      z / (1.0 + z * z / n) * std::sqrt(part * (1.0 - part) / n + 0.25 * z * z / (n * n));
  return {middle - half, middle + half};
}

ChainSummary summary_of(const std::string& chain, const std::vector<ChainRow>& rows) {
  std::vector<double> errors, simulations, seconds;
  double successes = 0.0;
  for (const ChainRow& row : rows) {
    if (row.chain != chain) continue;
    errors.push_back(row.error);
    simulations.push_back(static_cast<double>(row.simulations));
    seconds.push_back(row.seconds);
    successes += row.success ? 1.0 : 0.0;
  }
  const auto n = static_cast<double>(errors.size());
  return {chain,         quantiles(errors),   quantiles(simulations), quantiles(seconds),
          successes / n, wilson(successes, n)};
}

}  // namespace

std::vector<Chain> all_chains() {
  using enum GlobalSearch;
  return {{.name = "starts, automatic, least squares"},
          {.name = "starts, automatic", .smooth = false},
          {.name = "starts, COBYLA, least squares", .local = LocalSearch::cobyla},
          {.name = "starts, Sbplx, least squares", .local = LocalSearch::sbplx},
          {.name = "CRS2, automatic, least squares", .global = crs2},
          {.name = "DIRECT-L, automatic, least squares", .global = direct},
          {.name = "MLSL, automatic, least squares", .global = mlsl},
          {.name = "ESCH, automatic, least squares", .global = esch}};
}

Study known_study(int number, std::array<double, 3>& truth) {
  Study study = empty_study(number);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const auto [low, high] = range_of_truth.at(k);
    truth.at(k) = low * std::pow(high / low, fraction(number, k));
  }
  const Bar bar;
  Laboratory laboratory;
  laboratory.toe_strain = 0.0;
  for (int s = 0; s < 6; ++s) {
    Specimen specimen;
    specimen.id = fmt::format("S{}", s + 1);
    const int pair = s / 2;  // two specimens each at 0°, 45° and 90°
    specimen.orientation = 0.25 * std::numbers::pi * pair;
    sim::Scene scene = study.model;
    scene.assembly.orientation = specimen.orientation;
    for (std::size_t k = 0; k < truth.size(); ++k)
      apply(scene, calibrated_names.at(k), truth.at(k));
    scene.joints.seed =
        specimen_seed(static_cast<std::uint64_t>(number), 100U + static_cast<unsigned>(s));
    const sim::Simulation simulation = sim::simulate(scene);
    if (!simulation.trusted()) continue;
    specimen.test = reduce_test(record_test(simulation, bar, laboratory, scene.joints.seed)).test;
    study.specimens.push_back(std::move(specimen));
  }
  return study;
}

ChainBenchmark benchmark_chains(int studies, int threads, const std::function<bool()>& go_on) {
  ChainBenchmark benchmark;
  for (int number = 1; number <= studies; ++number) {
    std::array<double, 3> truth{};
    Study study = known_study(number, truth);
    study.calibrate.threads = threads;
    for (const Chain& chain : all_chains()) {
      if (!go_on()) return benchmark;
      benchmark.rows.push_back(fit_by(chain, study, number, truth));
    }
  }
  judge(benchmark.rows);
  for (const Chain& chain : all_chains())
    benchmark.summaries.push_back(summary_of(chain.name, benchmark.rows));
  return benchmark;
}

}  // namespace havers::calib
