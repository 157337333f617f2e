#include <fmt/format.h>

#include <limits>

#include "reports/pages/page.hpp"
#include "reports/text/base64.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {

std::string porosity_page(const PorosityReport& report) {
  mstch::array sections;
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    const calib::SectionPorosity& s = report.sections[i];
    const double scatter =
        i < report.scatter.size() ? report.scatter[i] : std::numeric_limits<double>::quiet_NaN();
    sections.emplace_back(mstch::map{
        {"file", text(base_name(s.file))},
        {"porosity",
         text(plus_minus(s.porosity / in::percent, s.porosity_standard_error / in::percent))},
        {"scatter", text(number(scatter, 3))},
        {"pores", text(std::to_string(s.pore_count))},
        {"pore_area", text(number(s.pore_area / in::mm2, 3))},
        {"bone_area", text(number(s.bone_area / in::mm2, 3))},
        {"window_sd", text(number(s.window_sd, 3))},
        {"png", text(i < report.overlays.size() ? base64(report.overlays[i]) : "")},
        {"caption", text(section_caption(s))},
        {"corrections", section({})},
        {"warnings", text_section(s.warnings)}});
  }
  return render_page(
      fmt::format("havers porosity: {}", count(static_cast<long>(sections.size()), "section")),
      "porosity", {{"sections", mstch::node{sections}}}, report.provenance);
}

}  // namespace havers::reports
