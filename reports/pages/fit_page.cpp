#include <fmt/format.h>

#include <cmath>

#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/base64.hpp"
#include "reports/text/format.hpp"
#include "reports/text/parameter_label.hpp"

namespace havers::reports {
namespace {

std::string interval_or(const std::array<double, 2>& ends, const std::string& missing) {
  return missing.empty() ? interval(ends[0], ends[1]) : "– (" + missing + ")";
}

// What the fit asked for, fitted or not.
std::vector<std::string> asked_for(const calib::CalibrationResult& result) {
  std::vector<std::string> names;
  for (const calib::CalibratedParameter& p : result.parameters) names.push_back(p.name);
  return names;
}

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

// What a measured and a simulated quantity are called and shown in.
struct Compared {
  std::string quantity, unit;
  double scale;
  double measured, measured_error;
  calib::Spread simulated;
  double residual;
};

std::vector<Compared> compared(const calib::SpecimenResult& s) {
  const double not_measured = std::numeric_limits<double>::quiet_NaN();
  return {{"Modulus", "GPa", in::GPa, s.measured.modulus, s.measured.modulus_standard_error,
           s.modulus, s.residual[0]},
          {"Strength", "MPa", in::MPa, s.measured.strength, s.measured.strength_standard_error,
           s.strength, s.residual[1]},
          {"Failure strain", "%", in::percent, s.measured.failure_strain, not_measured,
           s.failure_strain, s.residual[2]}};
}

mstch::array comparison_rows(const calib::SpecimenResult& specimen) {
  mstch::array rows;
  for (const Compared& c : compared(specimen))
    rows.emplace_back(mstch::map{
        {"quantity", text(c.quantity)},
        {"unit", text(c.unit)},
        {"measured", text(plus_minus(c.measured / c.scale, c.measured_error / c.scale))},
        {"simulated", text(plus_minus(c.simulated.mean / c.scale, c.simulated.sd / c.scale))},
        {"residual", text(number(c.residual, 2))}});
  return rows;
}

mstch::array overview_cells(const calib::SpecimenResult& specimen) {
  mstch::array cells;
  for (const Compared& c : compared(specimen)) {
    cells.push_back(text(number(c.measured / c.scale)));
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

// What is left of a logarithm of 1.
double without_rounding(double logarithm) {
  return std::abs(logarithm) < 1e-12 ? 0.0 : logarithm;
}

mstch::array term_rows(const calib::SpecimenResult& specimen) {
  mstch::array rows;
  for (const calib::TermResult& term : specimen.terms)
    rows.emplace_back(mstch::map{{"term", text(term.term)},
                                 {"measured", text(number(term.measured))},
                                 {"simulated", text(number(without_rounding(term.simulated)))},
                                 {"sd", text(number(term.sd, 2))},
                                 {"residual", text(number(term.residual, 2))},
                                 {"share", text(number(term.share / in::percent, 2))}});
  return rows;
}

// Of the fitted parameters on each other, one row each.
mstch::array correlation_rows(const calib::CalibrationResult& result) {
  mstch::array rows;
  for (std::size_t i = 0; i < result.correlation.size(); ++i) {
    mstch::array cells;
    for (const double value : result.correlation[i])  // to a hundredth: what rounding leaves is 0
      cells.push_back(text(number(std::round(100.0 * value) / 100.0 + 0.0, 2)));
    rows.emplace_back(
        mstch::map{{"name", text(symbol_of(result.fitted[i]))}, {"cells", mstch::node{cells}}});
  }
  return rows;
}

// What a further test would leave of each standard error.
mstch::array next_rows(const calib::CalibrationResult& result) {
  mstch::array rows;
  for (const calib::NextTest& test : result.next_tests) {
    mstch::array cells;
    for (const double part : test.width) cells.push_back(text(number(part, 2)));
    rows.emplace_back(
        mstch::map{{"what", text(typeset(test.what))}, {"cells", mstch::node{cells}}});
  }
  return rows;
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

mstch::array influence_rows(const calib::CalibrationResult& result) {
  mstch::array rows;
  for (const calib::SpecimenResult& specimen : result.specimens) {
    if (specimen.influence.empty()) continue;
    mstch::array cells;
    for (const calib::Influence& one : specimen.influence)
      cells.push_back(text(number(one.shift, 2)));
    rows.emplace_back(mstch::map{{"id", text(specimen.id)}, {"cells", mstch::node{cells}}});
  }
  return rows;
}

mstch::array directions(const calib::CalibrationResult& result) {
  mstch::array list;
  for (const std::string& sentence : result.directions)
    list.push_back(text(typeset(with_symbols(sentence, result.fitted))));
  return list;
}

mstch::array fitted_symbols(const calib::CalibrationResult& result) {
  mstch::array list;
  for (const std::string& name : result.fitted) list.push_back(text(symbol_of(name)));
  return list;
}

// Everything about how well the answer is known; vanishes where nothing was fitted.
mstch::node knowledge(const calib::CalibrationResult& result) {
  if (result.fitted.empty()) return section({});
  return section({mstch::map{
      {"directions", mstch::node{directions(result)}},
      {"fitted", mstch::node{fitted_symbols(result)}},
      {"intervals", mstch::node{interval_rows(result)}},
      {"correlation", mstch::node{correlation_rows(result)}},
      {"next", section(next_rows(result))},
      {"influence", section(influence_rows(result))},
      {"profiles",
       text(result.profiles.empty() ? "" : draw(profile_figure(result.profiles, "profiles")))}}});
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

mstch::map specimen_content(const FitReport& report, std::size_t index) {
  const calib::SpecimenResult& s = report.result.specimens[index];
  const std::string use = s.use == calib::Use::fit ? "fit" : "validate";
  const std::string porosity = quantity(s.porosity / in::percent, "%", 3);
  return {{"id", text(s.id)},
          {"use", text(use)},
          {"orientation", text(degrees(s.orientation))},
          {"porosity", text(porosity)},
          {"scatter", text(number(s.scatter, 3))},
          {"overview", mstch::node{overview_cells(s)}},
          {"summary", text(fmt::format("{}{}, θ = {}, porosity {}, scatter d = {}", use,
                                       s.measured.broke ? "" : ", not broken",
                                       degrees(s.orientation), porosity, number(s.scatter, 3)))},
          {"figure", text(draw(specimen_figure(s, fmt::format("s{}", index))))},
          {"rows", mstch::node{comparison_rows(s)}},
          {"terms", section(term_rows(s))},
          {"failed", text(s.failed_simulations == 0 ? ""
                                                    : count(s.failed_simulations, "simulation") +
                                                          " of this specimen failed.")},
          {"corrections", correction_section(s.measured.corrections)},
          {"warnings", text_section(s.measured.warnings)},
          {"tests", section(test_items(report, s.id))},
          {"sections", section(section_items(report, s.id))}};
}

// What Ceres adds are its own numbers, to seven digits.
std::string first_sentence(const std::string& message) {
  return message.substr(0, message.find(". "));
}

mstch::array stage_rows(const std::vector<calib::StageLog>& stages) {
  mstch::array rows;
  for (const calib::StageLog& stage : stages)
    rows.emplace_back(mstch::map{{"optimiser", text(stage.optimiser)},
                                 {"before", text(number(stage.cost_before))},
                                 {"after", text(number(stage.cost_after))},
                                 {"evaluations", text(std::to_string(stage.evaluations))},
                                 {"wall", text(duration(stage.wall_seconds))},
                                 {"message", text(first_sentence(stage.message))}});
  return rows;
}

}  // namespace

std::string fit_page(const FitReport& report) {
  const calib::CalibrationResult& result = report.result;
  mstch::array parameters, specimens;
  for (const auto& parameter : result.parameters)
    parameters.emplace_back(parameter_row(parameter, asked_for(result)));
  for (std::size_t i = 0; i < result.specimens.size(); ++i)
    specimens.emplace_back(specimen_content(report, i));
  return render_page(
      fmt::format("havers fit: {}", report.study.name), "fit",
      {{"grade", text(result.trusted() ? "good" : "bad")},
       {"sentence", text(fit_sentence(result))},
       {"detail", text(status_sentence(result))},
       {"checks", check_section(result.verdict)},
       {"parameters", mstch::node{parameters}},
       {"strength_figure", text(draw(strength_figure(result.specimens, "strength")))},
       {"specimens", mstch::node{specimens}},
       {"knowledge", knowledge(result)},
       {"waterfall",
        text(result.starts.empty() ? "" : draw(waterfall_figure(result, "waterfall")))},
       {"search", text(search_sentence(report))},
       {"stages", mstch::node{stage_rows(result.stages)}},
       {"left_out", left_out_section(result.left_out)}},
      report.provenance);
}

}  // namespace havers::reports
