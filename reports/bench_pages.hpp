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

/// Shows the same figure, a table of all settings, and which is the cheapest for a given accuracy.
std::string work_precision_page(const sim::Scene& scene, const sim::WorkPrecision& study,
                                const calib::Provenance& provenance);
/// Scenes whose answer is known: what came out, and whether that is as it must be.
std::string stability_page(const sim::StabilityBench& bench, const calib::Provenance& provenance);
/// Errors of porosity by common practice and by havers, over all drawn sections and by hardship.
std::string methods_page(const calib::MethodComparison& comparison,
                         const calib::Provenance& provenance);
/// Precondition: the benchmark is complete.
std::string chains_page(const calib::ChainBenchmark& benchmark,
                        const calib::Provenance& provenance);
/// How often 95 % intervals hold the true value, by design and parameter.
std::string coverage_page(const calib::Coverage& coverage, const calib::Provenance& provenance);

}  // namespace havers::reports
