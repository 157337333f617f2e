#include <fmt/format.h>

#include <algorithm>

#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"
#include "reports/text/parameter_label.hpp"

namespace havers::reports {
namespace {

// The parameters of all fits in the order in which they appear.
std::vector<std::string> names_of(const std::vector<FitReport>& fits) {
  std::vector<std::string> names;
  for (const FitReport& fit : fits)
    for (const auto& parameter : fit.result.parameters)
      if (std::ranges::find(names, parameter.name) == names.end()) names.push_back(parameter.name);
  return names;
}

mstch::map cell(const FitReport& fit, const std::string& name) {
  for (const auto& p : fit.result.parameters) {
    if (p.name != name) continue;
    const bool held = !p.left_out_because.empty();
    return {{"estimate", text(held ? number(p.value) : plus_minus(p.value, p.standard_error))},
            {"note", text(held ? "held" : interval(p.interval_95[0], p.interval_95[1]))}};
  }
  return {{"estimate", text("–")}, {"note", text("")}};
}

mstch::array parameter_rows(const std::vector<FitReport>& fits) {
  mstch::array rows;
  for (const std::string& name : names_of(fits)) {
    mstch::array cells;
    for (const FitReport& fit : fits) cells.emplace_back(cell(fit, name));
    rows.emplace_back(mstch::map{
        {"symbol", text(axis_label(name))}, {"name", text(name)}, {"cells", mstch::node{cells}}});
  }
  return rows;
}

mstch::map fit_content(const FitReport& fit) {
  const calib::CalibrationResult& result = fit.result;
  return {{"name", text(fit.study.name)},
          {"outcome", text(result.trusted() ? "pass" : "fail")},
          {"grade", text(result.trusted() ? "good" : "bad")},
          {"sentence", text(fit_sentence(result))},
          {"detail", text(search_sentence(fit))},
          {"cost", text(number(result.cost))},
          {"specimens", text(std::to_string(result.specimens.size()))},
          {"evaluations", text(std::to_string(result.evaluations))},
          {"wall", text(duration(fit.wall_seconds))},
          {"checks", check_section(result.verdict)}};
}

}  // namespace

std::string comparison_page(const std::vector<FitReport>& reports) {
  mstch::array fits;
  Provenance provenance;
  for (const FitReport& fit : reports) {
    fits.emplace_back(fit_content(fit));
    for (const auto& [name, value] : fit.provenance)
      provenance.emplace_back(fmt::format("{}: {}", fit.study.name, name), value);
  }
  return render_page(fmt::format("havers report: {} side by side",
                                 count(static_cast<long>(reports.size()), "fit")),
                     "comparison",
                     {{"fits", mstch::node{fits}},
                      {"intervals", text(draw(intervals_figure(reports, "intervals")))},
                      {"parameters", mstch::node{parameter_rows(reports)}}},
                     provenance);
}

}  // namespace havers::reports
