// Stands in for the page in a build without mstch.
#include "reports/sweep/sweep_page.hpp"

namespace havers::reports {

std::string sweep_page(const std::string& /*title*/, const std::vector<SweepReport>& /*sweeps*/,
                       const Provenance& /*provenance*/, double /*wall_seconds*/) {
  return "Pages are not part of this build: apt-get install libmstch-dev gnuplot-nox, then "
         "configure again.\n";
}

}  // namespace havers::reports
