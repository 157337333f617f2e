// Pages of havers bench: error against run time, scenes of known answer, ways to measure porosity,
// chains of optimisers, and what the intervals hold.
#pragma once

#include <string>
#include <vector>

#include "calib/porosity/method_comparison.hpp"
#include "calib/synthetic/chain_benchmark.hpp"
#include "calib/synthetic/coverage.hpp"
#include "reports/pages.hpp"
#include "sim/bench/stability.hpp"
#include "sim/bench/work_precision.hpp"

namespace havers::reports {

struct WorkPrecisionReport {
  const sim::Scene& scene;
  const sim::WorkPrecision& study;
  Provenance provenance;
};

struct StabilityReport {
  const std::vector<sim::StabilityResult>& results;
  Provenance provenance;
};

struct MethodsReport {
  const calib::MethodComparison& comparison;
  Provenance provenance;
};

struct ChainsReport {
  const calib::ChainBenchmark& benchmark;  ///< Complete.
  Provenance provenance;
};

struct CoverageReport {
  const calib::Coverage& coverage;
  Provenance provenance;
};

/// Errors of joint forces and failure strain against CPU time, both on logarithmic axes. SVG.
std::string work_precision_svg(const sim::WorkPrecision& study);

std::string work_precision_page(const WorkPrecisionReport& report);
std::string stability_page(const StabilityReport& report);
std::string methods_page(const MethodsReport& report);
std::string chains_page(const ChainsReport& report);
std::string coverage_page(const CoverageReport& report);

}  // namespace havers::reports
