// Pages of havers bench: error against run time, scenes of known answer, ways to measure porosity.
#pragma once

#include <string>
#include <vector>

#include "calib/porosity/method_comparison.hpp"
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

/// Errors of joint forces and failure strain against CPU time, both on logarithmic axes. SVG.
std::string work_precision_svg(const sim::WorkPrecision& study);

std::string work_precision_page(const WorkPrecisionReport& report);
std::string stability_page(const StabilityReport& report);
std::string methods_page(const MethodsReport& report);

}  // namespace havers::reports
