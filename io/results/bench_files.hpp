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

nlohmann::json work_precision_json(const sim::Scene& scene, const sim::WorkPrecision& study,
                                   const calib::Provenance& provenance);
nlohmann::json stability_json(const sim::StabilityBench& bench,
                              const calib::Provenance& provenance);

nlohmann::json methods_json(const calib::MethodComparison& comparison,
                            const calib::Provenance& provenance);

nlohmann::json chains_json(const calib::ChainBenchmark& benchmark,
                           const calib::Provenance& provenance);
nlohmann::json coverage_json(const calib::Coverage& coverage, const calib::Provenance& provenance);

/// One line a setting, a scene, a section by a method; a fit by a chain, an interval of a study.
std::string work_precision_csv(const sim::WorkPrecision& study);
std::string stability_csv(const std::vector<sim::StabilityResult>& results);
std::string methods_csv(const calib::MethodComparison& comparison);
std::string chains_csv(const calib::ChainBenchmark& benchmark);
std::string coverage_csv(const calib::Coverage& coverage);

}  // namespace havers::io
