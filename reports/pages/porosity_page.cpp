// All sections in one table, then each with its overlay and histogram, so that a reader can check
// what was taken for a pore.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calib/porosity/scatter_map.hpp"
#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/base64.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

std::string percent(double share, double error) {
  return plus_minus(share / in::percent, error / in::percent);
}

std::string with_sd(double mean, double sd, double unit) {
  if (!std::isfinite(mean)) return number(mean);
  return fmt::format("{} (SD {})", number(mean / unit, 3), number(sd / unit, 2));
}

// Of a section by itself: pores larger than a window take joints away instead (K5).
std::string scatter_text(const calib::SectionPorosity& s, double scatter) {
  const calib::SpecimenPorosity alone = calib::pool_sections({s});
  if (!calib::removes_joints(alone))
    return plus_minus(scatter, calib::scatter_standard_error(alone, {}));
  return fmt::format("– ({} missing)",
                     quantity(calib::missing_joints(alone) / in::percent, "%", 3));
}

// One line of the table.
mstch::map row(const std::string& name, const calib::SectionPorosity& s, double scatter) {
  return {{"file", text(name)},
          {"porosity", text(percent(s.porosity, s.porosity_standard_error))},
          {"scatter", text(scatter_text(s, scatter))},
          {"pores", text(std::to_string(s.pore_count))},
          {"density", text(number(s.pore_density * in::mm2, 3))},
          {"diameter", text(with_sd(s.mean_pore_diameter, s.pore_diameter_sd, in::um))},
          {"bone_area", text(number(s.bone_area / in::mm2, 3))},
          {"marrow_area", text(number(s.marrow_area / in::mm2, 3))},
          {"window_sd", text(number(s.window_sd / in::percent, 3))}};
}

mstch::map zone_row(const calib::Zone& zone) {
  return {{"name", text(zone.name)},
          {"porosity", text(number(zone.porosity / in::percent, 3))},
          {"area", text(number(zone.bone_area / in::mm2, 3))}};
}

mstch::map class_row(const calib::PoreClass& pores) {
  return {{"name", text(pores.name)},
          {"count", text(std::to_string(pores.count))},
          {"area", text(number(pores.area / in::mm2, 3))}};
}

// What no column of the table says of a section.
Facts facts_of(const calib::SectionPorosity& s) {
  Facts facts{{"Threshold", fmt::format("at a depth of {}, 0 bone, 1 pore ({})",
                                        number(s.threshold, 3), s.method)},
              {"Porosity by grey levels", quantity(s.porosity_by_grey / in::percent, "%", 4)},
              {"Pixel", quantity(s.pixel_size / in::um, "µm", 3)}};
  if (std::isfinite(s.mean_pore_area))
    facts.emplace_back("Area of a pore",
                       with_sd(s.mean_pore_area, s.pore_area_sd, in::um * in::um) + "\u00a0µm²");
  if (s.crack_count > 0)
    facts.emplace_back("Cracks", fmt::format("{}, {}\u00a0mm², no part of the porosity",
                                             s.crack_count, number(s.crack_area / in::mm2, 3)));
  if (std::isfinite(s.density))
    facts.emplace_back("Density of solid bone",
                       fmt::format("{} ({})", quantity(s.density, "kg/m³", 4),
                                   std::isfinite(s.density_residual)
                                       ? fmt::format("references {} about their line",
                                                     quantity(s.density_residual, "kg/m³", 2))
                                       : "two references: no check of their line"));
  return facts;
}

mstch::map detail(const PorosityReport& report, std::size_t i) {
  const calib::SectionPorosity& s = report.sections[i];
  return {
      {"file", text(base_name(s.file))},
      {"png", text(base64(report.overlays[i]))},
      {"histogram", text(draw(histogram_figure(report.histograms[i], fmt::format("depth{}", i))))},
      {"facts", fact_list(facts_of(s))},
      {"zones", section(list_of(s.zones, zone_row))},
      {"classes", section(list_of(s.classes, class_row))},
      {"warnings", text_section(s.warnings)}};
}

long in_doubt(const PorosityReport& report) {
  return std::ranges::count(report.sections, true, &calib::SectionPorosity::doubtful);
}

std::string sentence_of(const PorosityReport& report) {
  const calib::SpecimenPorosity& mean = report.mean;
  const auto all = static_cast<long>(report.sections.size()), doubtful = in_doubt(report);
  const std::string doubt = doubtful == 0 ? "."
                            : all == 1
                                ? ", in doubt: see its warnings."
                                : fmt::format(", {} of them in doubt: see the warnings.", doubtful);
  return fmt::format("{}: porosity {}\u00a0%{}", count(all, "section"),
                     percent(mean.porosity, mean.porosity_standard_error), doubt);
}

// (K5): which of the two ways the pores act in.
std::string detail_of(const PorosityReport& report) {
  const calib::SpecimenPorosity& mean = report.mean;
  if (calib::removes_joints(mean))
    return fmt::format(
        "Pores are larger (a*\u00a0= {}\u00a0µm²) than the window of one fibre ({}\u00a0µm²): they "
        "take {} of the joints away rather than spread their strength. a*: mean area of the pore "
        "that a random point of pore lies in.",
        number(mean.pore_area_ratio / (in::um * in::um), 3),
        number(mean.window_area / (in::um * in::um), 3),
        quantity(calib::missing_joints(mean) / in::percent, "%", 3));
  const double scatter = calib::scatter_of(mean, {});
  if (!std::isfinite(scatter))
    return "Without a pixel size, or where the window of a fibre is larger than the bone, the "
           "scatter of joints is not known.";
  if (mean.porosity == 0.0)
    return "No pores were found: by the sections joints would be all alike, a scatter of d = 0.";
  return fmt::format(
      "Pores are smaller than the window of one fibre: they spread the joints' strength by a "
      "scatter of d = {}.",
      plus_minus(scatter, calib::scatter_standard_error(mean, {})));
}

}  // namespace

std::string porosity_page(const PorosityReport& report) {
  mstch::array rows, details;
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    const calib::SectionPorosity& s = report.sections[i];
    rows.emplace_back(row(base_name(s.file), s, report.scatter[i]));
    details.emplace_back(detail(report, i));
  }
  return render_page(fmt::format("havers porosity: {}", count(rows.size(), "section")), "porosity",
                     {{"grade", grade(true, in_doubt(report) == 0)},
                      {"sentence", text(sentence_of(report))},
                      {"detail", text(detail_of(report))},
                      {"rows", rows},
                      {"sections", details}},
                     report.provenance);
}

}  // namespace havers::reports
