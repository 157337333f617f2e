// Pages of havers bench: error against run time, scenes of known answer, ways to measure porosity,
// chains of optimisers, and what the intervals hold.
#pragma once

#include <string>

#include "calib/porosity/method_comparison.hpp"
#include "calib/synthetic/chain_benchmark.hpp"
#include "calib/synthetic/coverage.hpp"
#include "reports/pages.hpp"
#include "sim/bench/stability.hpp"
#include "sim/bench/work_precision.hpp"

namespace havers::reports {

/// Errors of joint forces and failure strain against CPU time, both on logarithmic axes. SVG.
std::string work_precision_svg(const sim::WorkPrecision& study);

/// The same with a table of every setting, and which of them are the cheapest for an accuracy.
std::string work_precision_page(const sim::Scene& scene, const sim::WorkPrecision& study,
                                const calib::Provenance& provenance);
/// Scenes whose answer is known: what came out, and whether it must.
std::string stability_page(const sim::StabilityBench& bench, const calib::Provenance& provenance);
/// Errors of common practice and ours, over all drawn sections and by what makes them hard.
std::string methods_page(const calib::MethodComparison& comparison,
                         const calib::Provenance& provenance);
/// Precondition: the benchmark is complete.
std::string chains_page(const calib::ChainBenchmark& benchmark,
                        const calib::Provenance& provenance);
/// How often intervals hold the truth, by design and parameter.
std::string coverage_page(const calib::Coverage& coverage, const calib::Provenance& provenance);

}  // namespace havers::reports
