// What havers bench leaves in its folder.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "calib/porosity/method_comparison.hpp"
#include "calib/synthetic/chain_benchmark.hpp"
#include "calib/synthetic/coverage.hpp"
#include "io/results/result_files.hpp"
#include "sim/bench/stability.hpp"
#include "sim/bench/work_precision.hpp"

namespace havers::io {

/// result.json of a bench: what its table holds, and what follows from it. In SI units; `complete`
/// is false where the bench was stopped.
///
/// `havers bench SCENE`: settings against the reference; `scene` can be run by simulate.
nlohmann::json work_precision_json(const sim::Scene& scene, const sim::WorkPrecision& study,
                                   const calib::Provenance& provenance);
/// `--stability`: scenes whose answer is known.
nlohmann::json stability_json(const sim::StabilityBench& bench,
                              const calib::Provenance& provenance);

/// `--porosity`: methods over all sections, and over those of each hardship.
nlohmann::json methods_json(const calib::MethodComparison& comparison,
                            const calib::Provenance& provenance);

/// `--calibration`: chains of optimisers, with the winner among them.
nlohmann::json chains_json(const calib::ChainBenchmark& benchmark,
                           const calib::Provenance& provenance);
/// `--coverage`: how often 95 % intervals hold the truth, by design and parameter.
nlohmann::json coverage_json(const calib::Coverage& coverage, const calib::Provenance& provenance);

/// The tables beside them, with one line for each setting; scene; section and method; fit by a
/// chain; interval of a study. The first line has the names of the columns; where result.json has
/// the same rows these are its keys, but for the first. The last three tables are empty without
/// rows.
std::string work_precision_csv(const sim::WorkPrecision& study);
std::string stability_csv(const std::vector<sim::StabilityResult>& results);
std::string methods_csv(const calib::MethodComparison& comparison);
std::string chains_csv(const calib::ChainBenchmark& benchmark);
std::string coverage_csv(const calib::Coverage& coverage);

}  // namespace havers::io
