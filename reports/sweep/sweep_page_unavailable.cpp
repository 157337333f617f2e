// Stands in for the page and the avalanche in a build without mstch.
#include "reports/figures/avalanche.hpp"
#include "reports/sweep/sweep_page.hpp"

namespace havers::reports {

std::string sweep_page(const std::string& /*title*/, const std::vector<SweepReport>& /*sweeps*/,
                       const Provenance& /*provenance*/, double /*wall_seconds*/) {
  return "Pages are not part of this build: apt-get install libmstch-dev gnuplot-nox, then "
         "configure again.\n";
}

std::string avalanche_svg(const sim::Assembly& /*assembly*/,
                          const sim::Simulation& /*simulation*/) {
  return {};
}

}  // namespace havers::reports
