// The page of a fit: verdict and checks, parameters, specimens, then how well the parameters are
// determined and how the search went.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/figures/figures.hpp"
#include "reports/pages/fit_specimen.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"
#include "reports/text/parameter_label.hpp"

namespace havers::reports {
namespace {

// An end that is not known leaves the interval open.
std::string interval_or(const std::array<double, 2>& ends, const std::string& missing) {
  if (missing.empty()) return interval(ends[0], ends[1]);
  const std::string known = std::isfinite(ends[1])   ? "at most " + number(ends[1])
                            : std::isfinite(ends[0]) ? "at least " + number(ends[0])
                                                     : "–";
  return fmt::format("{} ({})", known, missing);
}

// What the fit asked for, fitted or not.
std::vector<std::string> asked_for(const calib::CalibrationResult& result) {
  std::vector<std::string> names;
  for (const calib::CalibratedParameter& p : result.parameters) names.push_back(p.name);
  return names;
}

// A parameter that was left out of the fit is held at its value; its row says why.
mstch::map parameter_row(const calib::CalibratedParameter& p,
                         const std::vector<std::string>& parameters) {
  const bool held = !p.left_out_because.empty();
  std::string note = p.at_bound ? "at its bound" : "";
  if (!held && !p.identifiable) note += note.empty() ? "not identifiable" : ", not identifiable";
  return {{"symbol", text(symbol_of(p.name))},
          {"name", text(p.name)},
          {"unit", text(p.unit)},
          {"estimate", text(held ? number(p.value) : plus_minus(p.value, p.standard_error))},
          {"interval", text(held ? "held" : interval(p.interval_95[0], p.interval_95[1]))},
          {"bar", text(held ? "" : interval_bar(p))},
          {"bounds",
           text(held ? "" : fmt::format("{} to {}", setting(p.bounds[0]), setting(p.bounds[1])))},
          {"note", text(note)},
          {"held", text(typeset(with_symbols(p.left_out_because, parameters)))}};
}

// Of the fitted parameters on each other, one row each.
mstch::array correlation_rows(const calib::CalibrationResult& result) {
  mstch::array rows;
  for (std::size_t i = 0; i < result.correlation.size(); ++i) {
    mstch::array cells;
    for (const double value : result.correlation[i])  // to a hundredth: what rounding leaves is 0
      cells.push_back(text(number(std::round(100.0 * value) / 100.0 + 0.0, 2)));
    rows.emplace_back(mstch::map{{"name", text(symbol_of(result.fitted[i]))}, {"cells", cells}});
  }
  return rows;
}

// What a further test would leave of each standard error.
mstch::array next_rows(const calib::CalibrationResult& result) {
  return list_of(result.next_tests, [](const calib::NextTest& test) {
    const auto cell = [](double part) { return text(number(part, 2)); };
    return mstch::map{{"what", text(typeset(test.what))}, {"cells", list_of(test.width, cell)}};
  });
}

// The same interval by three means.
mstch::array interval_rows(const calib::CalibrationResult& result) {
  mstch::array rows;
  for (const calib::CalibratedParameter& p : result.parameters)
    if (p.identifiable)
      rows.emplace_back(
          mstch::map{{"name", text(axis_label(p.name))},
                     {"interval", text(interval(p.slopes_95[0], p.slopes_95[1]))},
                     {"profile", text(interval_or(p.profile_95, p.profile_missing))},
                     {"bootstrap", text(interval_or(p.bootstrap_95, p.bootstrap_missing))}});
  return rows;
}

bool has_bootstrap(const calib::CalibrationResult& result) {
  return std::ranges::any_of(result.parameters, [](const calib::CalibratedParameter& p) {
    return p.identifiable && p.bootstrap_missing.empty();
  });
}

// By how many standard errors each fitted parameter would move without that specimen.
mstch::array influence_rows(const calib::CalibrationResult& result) {
  mstch::array rows;
  for (const calib::SpecimenResult& specimen : result.specimens) {
    if (specimen.influence.empty()) continue;
    mstch::array cells;
    for (const calib::Influence& one : specimen.influence)
      cells.push_back(text(number(without_rounding(one.shift), 2)));
    rows.emplace_back(mstch::map{{"id", text(specimen.id)}, {"cells", cells}});
  }
  return rows;
}

// What the tests determine, best first, a sentence each.
mstch::array directions(const calib::CalibrationResult& result) {
  return list_of(result.directions, [&](const std::string& sentence) {
    return text(typeset(with_symbols(sentence, asked_for(result))));
  });
}

// "r = 1.5, μ = 0.3": what was asked for and left out stays there along the profiles, while the
// intervals let it go wherever the specimens do. What `auto` leaves out is known.
std::string held_along(const FitReport& report) {
  std::string held;
  if (report.study.calibrate.automatic) return held;
  for (const calib::CalibratedParameter& p : report.result.parameters)
    if (!p.left_out_because.empty())
      held += fmt::format("{}{} = {}", held.empty() ? "" : ", ", symbol_of(p.name),
                          setting(p.value, p.unit, 4));
  return held;
}

// Everything about how well the answer is known; vanishes where nothing was fitted.
mstch::node knowledge(const FitReport& report) {
  const calib::CalibrationResult& result = report.result;
  if (result.fitted.empty()) return section({});
  return section({mstch::map{
      {"directions", directions(result)},
      {"fitted", list_of(result.fitted, symbol_of)},
      {"intervals", interval_rows(result)},
      {"drawn", has_bootstrap(result)},
      {"correlation", correlation_rows(result)},
      {"next", section(next_rows(result))},
      {"influence", section(influence_rows(result))},
      {"held_along", text(held_along(report))},
      {"profiles",
       text(result.profiles.empty() ? "" : draw(profile_figure(result.profiles, "profiles")))}}});
}

mstch::array stage_rows(const std::vector<calib::StageLog>& stages) {
  return list_of(stages, [](const calib::StageLog& stage) {
    const std::string& said = stage.message;  // by Ceres, behind a sentence, to seven digits
    return mstch::map{{"optimiser", text(stage.optimiser)},
                      {"before", text(number(stage.cost_before))},
                      {"after", text(number(stage.cost_after))},
                      {"evaluations", text(std::to_string(stage.evaluations))},
                      {"wall", text(duration(stage.wall_seconds))},
                      {"message", text(said.substr(0, said.find(". ")))}};
  });
}

// Tests whose numbers are not those of bone: the first thing to look at, whatever came of them.
mstch::array doubts_of(const calib::CalibrationResult& result) {
  mstch::array doubts;
  for (const calib::SpecimenResult& specimen : result.specimens)
    if (!specimen.measured.unit_doubt.empty())
      doubts.push_back(
          text(fmt::format("{}: {}.", specimen.id, typeset(specimen.measured.unit_doubt))));
  return doubts;
}

// Whether starts came as low as the lowest, to half a standard deviation's cost.
bool starts_agree(const calib::CalibrationResult& result) {
  return result.starts.size() > 1 && result.starts[1] < result.starts[0] + 0.5;
}

}  // namespace

std::string fit_page(const FitReport& report) {
  const calib::CalibrationResult& result = report.result;
  mstch::array specimens;
  for (std::size_t i = 0; i < result.specimens.size(); ++i)
    specimens.emplace_back(specimen_content(report, i));
  return render_page(
      fmt::format("havers fit: {}", report.study.name), "fit",
      {{"grade", grade(result.trusted())},
       {"sentence", text(fit_sentence(result))},
       {"detail", text(status_sentence(result))},
       {"doubts", doubts_of(result)},
       {"checks", check_section(result.verdict)},
       {"study_notes", text_section(result.notes)},
       {"parameters", list_of(result.parameters,
                              [&](const auto& p) { return parameter_row(p, asked_for(result)); })},
       {"held_at", text(held_along(report))},
       {"strength_figure", text(draw(strength_figure(result.specimens, "strength")))},
       {"specimens", specimens},
       {"knowledge", knowledge(report)},
       {"waterfall",
        text(result.starts.empty() ? "" : draw(waterfall_figure(result, "waterfall")))},
       {"flat", starts_agree(result)},
       {"search", text(search_sentence(report))},
       {"weighed_anew", result.stages.size() > 1},
       {"stages", stage_rows(result.stages)},
       {"left_out", left_out_section(result.left_out)}},
      report.provenance);
}

}  // namespace havers::reports
