// Stands in for the pages in a build without mstch: each function returns one line that names the
// missing packages. Callers that ask available() first never see it.
#include "reports/bench_pages.hpp"
#include "reports/pages.hpp"
#include "reports/sweep/sweep_page.hpp"

namespace havers::reports {
namespace {

std::string how_to_get_pages() {
  return "Pages are not part of this build: apt-get install libmstch-dev gnuplot-nox, then "
         "configure again.\n";
}

}  // namespace

bool available() {
  return false;
}

std::string fracture_svg(const sim::Assembly& /*assembly*/, const sim::Simulation& /*simulation*/) {
  return how_to_get_pages();
}
std::string avalanche_svg(const sim::Assembly& /*assembly*/,
                          const sim::Simulation& /*simulation*/) {
  return how_to_get_pages();
}
std::string test_svg(const ImportReport& /*report*/, const std::string& /*id*/) {
  return how_to_get_pages();
}
std::string clocks_svg(const calib::ClockFit& /*clocks*/, const std::string& /*id*/) {
  return how_to_get_pages();
}
std::string simulation_page(const SimulationReport& /*report*/) {
  return how_to_get_pages();
}
std::string fit_page(const FitReport& /*report*/) {
  return how_to_get_pages();
}
std::string sweep_page(const std::string& /*title*/, const std::vector<SweepReport>& /*sweeps*/,
                       const calib::Provenance& /*provenance*/) {
  return how_to_get_pages();
}
std::string import_page(const std::vector<ImportReport>& /*reports*/,
                        const calib::Provenance& /*provenance*/) {
  return how_to_get_pages();
}
std::string porosity_page(const PorosityReport& /*report*/) {
  return how_to_get_pages();
}
std::string work_precision_svg(const sim::WorkPrecision& /*study*/) {
  return how_to_get_pages();
}
std::string work_precision_page(const sim::Scene& /*scene*/, const sim::WorkPrecision& /*study*/,
                                const calib::Provenance& /*provenance*/) {
  return how_to_get_pages();
}
std::string stability_page(const sim::StabilityBench& /*bench*/,
                           const calib::Provenance& /*provenance*/) {
  return how_to_get_pages();
}
std::string methods_page(const calib::MethodComparison& /*comparison*/,
                         const calib::Provenance& /*provenance*/) {
  return how_to_get_pages();
}
std::string chains_page(const calib::ChainBenchmark& /*benchmark*/,
                        const calib::Provenance& /*provenance*/) {
  return how_to_get_pages();
}
std::string coverage_page(const calib::Coverage& /*coverage*/,
                          const calib::Provenance& /*provenance*/) {
  return how_to_get_pages();
}
std::string comparison_page(const std::vector<FitReport>& /*reports*/) {
  return how_to_get_pages();
}

}  // namespace havers::reports
