#include <fmt/format.h>

#include <cmath>

#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

std::string length(const std::optional<double>& metres) {
  return metres ? setting(*metres / in::mm, "mm") : "not in the file";
}

Facts facts_of(const ImportReport& report) {
  const calib::MeasuredTest& test = report.test;
  const calib::RawTest& raw = report.raw;
  return {{"Width, thickness", fmt::format("{}, {}", length(raw.width), length(raw.thickness))},
          {"Area", setting(test.area / in::mm2, "mm²")},
          {"Gauge length", length(raw.gauge_length)},
          {"Modulus",
           fmt::format("{} GPa, in the window {} %",
                       plus_minus(test.modulus / in::GPa, test.modulus_standard_error / in::GPa),
                       interval(test.window_low / in::percent, test.window_high / in::percent))},
          {"Strength", fmt::format("{} MPa", plus_minus(test.strength / in::MPa,
                                                        test.strength_standard_error / in::MPa))},
          {"Largest force", quantity(test.max_force, "N")},
          {"Failure strain", quantity(test.failure_strain / in::percent, "%")},
          {"Strain rate",
           test.strain_rate > 0.0 ? quantity(test.strain_rate, "1/s", 3) : "time not recorded"},
          {"Strength / (modulus · failure strain)", number(test.linearity, 3)}};
}

mstch::map content_of(const ImportReport& report, std::size_t index) {
  const calib::MeasuredTest& test = report.test;
  std::vector<std::string> warnings = report.raw.warnings;
  warnings.insert(warnings.end(), test.warnings.begin(), test.warnings.end());
  return {
      {"file", text(base_name(report.file))},
      {"specimen", text(report.raw.specimen_id)},
      {"rows", text(std::to_string(report.raw.rows()))},
      {"modulus", text(plus_minus(test.modulus / in::GPa, test.modulus_standard_error / in::GPa))},
      {"strength",
       text(plus_minus(test.strength / in::MPa, test.strength_standard_error / in::MPa))},
      {"failure_strain", text(number(test.failure_strain / in::percent))},
      {"warning_count", text(std::to_string(warnings.size()))},
      {"figure", text(draw(test_figure(report, fmt::format("t{}", index))))},
      {"facts", mstch::node{fact_list(facts_of(report))}},
      {"corrections", correction_section(test.corrections)},
      {"warnings", text_section(warnings)}};
}

}  // namespace

std::string test_svg(const ImportReport& report) {
  return draw(test_figure(report, "test"));
}

std::string import_page(const std::vector<ImportReport>& reports, const Provenance& provenance) {
  mstch::array tests;
  for (std::size_t i = 0; i < reports.size(); ++i) tests.emplace_back(content_of(reports[i], i));
  return render_page(
      fmt::format("havers import: {}", count(static_cast<long>(reports.size()), "test")), "import",
      {{"tests", mstch::node{tests}}}, provenance);
}

}  // namespace havers::reports
