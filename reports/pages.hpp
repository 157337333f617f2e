// Self-contained HTML pages and SVG figures of results that were made elsewhere.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calib/experiment/clocks.hpp"
#include "calib/fit/calibration.hpp"
#include "calib/provenance.hpp"
#include "sim/simulation.hpp"

namespace havers::reports {

/// Whether this build can make pages.
bool available();

/// What the page of one run shows. Reports hold references: results must live longer than they do.
struct SimulationReport {
  const sim::Scene& scene;
  const sim::Assembly& assembly;  ///< That of the scene, before the load.
  const sim::Simulation& simulation;
  calib::Provenance provenance;
  std::string file{};  ///< Of the scene; empty: the page does without its name.
};

/// What the page of a fit shows, or what a comparison shows of one of its fits.
struct FitReport {
  const calib::Study& study;
  const calib::CalibrationResult& result;
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> overlays;  ///< Specimen id to PNGs.
  calib::Provenance provenance;
  /// Specimen id to SVGs: its test as read and as used, the clocks of a second logger.
  std::map<std::string, std::vector<std::string>> tests{};
};

/// A test as read and as used. If it could not be reduced, `test` has no curve.
struct ImportReport {
  std::string file;
  const calib::RawTest& raw;
  const calib::MeasuredTest& test;
  std::vector<std::string> problems{};      ///< Why it cannot be used.
  const calib::ClockFit* clocks = nullptr;  ///< Of a second logger, where there is one.
};

/// Sections and their mean; all lists are in the order of `sections`.
struct PorosityReport {
  std::vector<calib::SectionPorosity> sections;
  std::vector<std::vector<std::uint8_t>> overlays;  ///< PNG, one per section.
  std::vector<double> scatter;                      ///< d, one per section; NaN: unknown. [-]
  std::vector<calib::DepthHistogram> histograms;    ///< One per section.
  calib::SpecimenPorosity mean;                     ///< Over all sections.
  calib::Provenance provenance;
};

/// The broken assembly: fibres displaced, broken joints by kind. SVG.
std::string fracture_svg(const sim::Assembly& assembly, const sim::Simulation& simulation);

/// Every joint as a line; the broken ones coloured by the moment of breaking, and shown one after
/// the other by an animation inside the SVG. Viewers without animation show all of them.
std::string avalanche_svg(const sim::Assembly& assembly, const sim::Simulation& simulation);

/// One measured test as read and as used. SVG; the id keeps it apart from others on its page.
std::string test_svg(const ImportReport& report, const std::string& id = "test");

/// The clocks of machine and logger: both signals as recorded, aligned, and what is left. SVG.
std::string clocks_svg(const calib::ClockFit& clocks, const std::string& id = "clocks");

/// The pages: complete HTML that needs no other file. If a figure cannot be drawn, a sentence
/// stands in its place.
std::string simulation_page(const SimulationReport& report);
std::string fit_page(const FitReport& report);
/// One part for each test, in the order of `reports`.
std::string import_page(const std::vector<ImportReport>& reports,
                        const calib::Provenance& provenance);
std::string porosity_page(const PorosityReport& report);

/// Several fits side by side.
std::string comparison_page(const std::vector<FitReport>& reports);

}  // namespace havers::reports
