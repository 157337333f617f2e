// A specimen on the page of a fit: its row in the overview, and the part about it alone.
#include "reports/pages/fit_specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/figures/figures.hpp"
#include "reports/text/base64.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

// What a measured and a simulated quantity are called and shown in.
struct Compared {
  std::string quantity, unit;
  double scale;
  double measured, measured_error;
  calib::Spread simulated;
  double residual;
  bool bound = false;  // the test was stopped before
};

std::vector<Compared> compared(const calib::SpecimenResult& s) {
  const double not_measured = std::numeric_limits<double>::quiet_NaN();
  return {{"Modulus", "GPa", in::GPa, s.measured.modulus, s.measured.modulus_standard_error,
           s.modulus, s.residual[0]},
          {"Strength", "MPa", in::MPa, s.measured.strength, s.measured.strength_standard_error,
           s.strength, s.residual[1], !s.measured.broke},
          {"Failure strain", "%", in::percent, s.measured.failure_strain, not_measured,
           s.failure_strain, s.residual[2], !s.measured.broke}};
}

// Strength and failure strain of a test that was stopped before the break are lower bounds.
std::string or_more(const Compared& c, const std::string& value) {
  return c.bound && std::isfinite(c.measured) ? "≥ " + value : value;
}

std::string measured_text(const Compared& c) {
  const std::string value =
      or_more(c, plus_minus(c.measured / c.scale, c.measured_error / c.scale));
  return std::isfinite(c.measured) && std::isnan(c.measured_error)
             ? value + " (error not estimated)"
             : value;
}

mstch::array comparison_rows(const calib::SpecimenResult& specimen) {
  return list_of(compared(specimen), [](const Compared& c) {
    return mstch::map{
        {"quantity", text(c.quantity)},
        {"unit", text(c.unit)},
        {"measured", text(measured_text(c))},
        {"simulated", text(plus_minus(c.simulated.mean / c.scale, c.simulated.sd / c.scale))},
        {"residual", text(number(c.residual, 2))}};
  });
}

// In the order of the overview's columns: measured and simulated alternate.
mstch::array overview_cells(const calib::SpecimenResult& specimen) {
  mstch::array cells;
  for (const Compared& c : compared(specimen)) {
    cells.push_back(text(or_more(c, number(c.measured / c.scale))));
    cells.push_back(text(number(c.simulated.mean / c.scale)));
  }
  return cells;
}

const calib::Specimen* find_specimen(const calib::Study& study, const std::string& id) {
  for (const calib::Specimen& specimen : study.specimens)
    if (specimen.id == id) return &specimen;
  return nullptr;
}

// Overlays and numbers of the sections, whichever of the two is there.
mstch::array section_items(const FitReport& report, const std::string& id) {
  const calib::Specimen* specimen = find_specimen(report.study, id);
  const auto found = report.overlays.find(id);
  const std::size_t numbers = specimen == nullptr ? 0 : specimen->sections.size();
  const std::size_t images = found == report.overlays.end() ? 0 : found->second.size();
  mstch::array items;
  for (std::size_t i = 0; i < std::max(numbers, images); ++i)
    items.emplace_back(
        mstch::map{{"png", text(i < images ? base64(found->second[i]) : "")},
                   {"caption", text(i < numbers ? section_caption(specimen->sections[i]) : "")}});
  return items;
}

// What a landmark (F4) is the logarithm of, where it is one.
std::string logarithm_of(const std::string& term) {
  if (term == "modulus") return "ln modulus (Pa)";
  if (term == "strength") return "ln strength (Pa)";
  if (term == "failure strain") return "ln (strength / (modulus × failure strain))";
  if (term == "energy") return "ln (2 × energy / (strength × failure strain))";
  return term;
}

// The terms of the cost, each with its share.
mstch::array term_rows(const calib::SpecimenResult& specimen) {
  return list_of(specimen.terms, [](const calib::TermResult& term) {
    return mstch::map{{"term", text(logarithm_of(term.term))},
                      {"measured", text((term.bound ? "≥ " : "") + number(term.measured))},
                      {"simulated", text(number(without_rounding(term.simulated)))},
                      {"sd", text(number(term.sd, 2))},
                      {"residual", text(number(term.residual, 2))},
                      {"share", text(number(term.share / in::percent, 2))}};
  });
}

// Of the test, then of the sections by their files.
std::vector<std::string> warnings_of(const FitReport& report,
                                     const calib::SpecimenResult& specimen) {
  std::vector<std::string> all = specimen.measured.warnings;
  if (const calib::Specimen* declared = find_specimen(report.study, specimen.id))
    for (const calib::SectionPorosity& section : declared->sections)
      for (const std::string& warning : section.warnings)
        all.push_back(fmt::format("{}: {}", base_name(section.file), warning));
  return all;
}

// The test as read and as used, then the clocks of a second logger.
mstch::array test_items(const FitReport& report, const std::string& id) {
  mstch::array items;
  const auto found = report.tests.find(id);
  if (found == report.tests.end()) return items;
  for (const std::string& figure : found->second)
    items.emplace_back(mstch::map{
        {"figure", text(figure)},
        {"caption",
         text(items.empty() ? "The test as read, and as used after the corrections."
                            : "The clocks of machine and logger: as recorded, aligned, and the "
                              "difference that is left.")}});
  return items;
}

}  // namespace

mstch::map specimen_content(const FitReport& report, std::size_t index) {
  const calib::SpecimenResult& s = report.result.specimens[index];
  const std::string use = s.use == calib::Use::fit ? "fit" : "validate";
  const std::string porosity = quantity(s.porosity / in::percent, "%", 3);
  return {{"id", text(s.id)},
          {"use", text(use)},
          {"orientation", text(degrees(s.orientation))},
          {"porosity", text(porosity)},
          {"scatter", text(number(s.scatter, 3))},
          {"overview", overview_cells(s)},
          {"summary", text(fmt::format("{}{}, θ = {}, porosity {}, scatter d = {}", use,
                                       s.measured.broke ? "" : ", not broken",
                                       degrees(s.orientation), porosity, number(s.scatter, 3)))},
          {"figure", text(draw(specimen_figure(s, fmt::format("s{}", index))))},
          {"rows", comparison_rows(s)},
          {"terms", section(term_rows(s))},
          {"bounded", std::ranges::any_of(s.terms, &calib::TermResult::bound)},
          {"failed", text(s.failed_simulations == 0 ? ""
                                                    : count(s.failed_simulations, "simulation") +
                                                          " of this specimen failed.")},
          {"corrections", correction_section(s.measured.corrections)},
          {"warnings", text_section(warnings_of(report, s))},
          {"tests", section(test_items(report, s.id))},
          {"sections", section(section_items(report, s.id))},
          {"overlaid", report.overlays.contains(s.id)}};
}

}  // namespace havers::reports
