// One part for each test: what was read, what was corrected and the result, or why it cannot be
// used.
#include <fmt/format.h>

#include <limits>
#include <optional>

#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

std::string length(const std::optional<double>& metres) {
  return metres ? setting(*metres / in::mm, "mm") : "not in the file";
}

std::string area_of(const calib::RawTest& raw) {
  const auto shown = [](double area) { return setting(area / in::mm2, "mm²"); };
  if (raw.width && raw.thickness) return shown(*raw.width * *raw.thickness) + ", width × thickness";
  return raw.area ? shown(*raw.area) : "not in the file";
}

Facts facts_of(const ImportReport& report) {
  const calib::MeasuredTest& test = report.test;
  const calib::RawTest& raw = report.raw;
  Facts sizes{{"Width, thickness", fmt::format("{}, {}", length(raw.width), length(raw.thickness))},
              {"Area", area_of(raw)},
              {"Gauge length", length(raw.gauge_length)}};
  // Of a test that was not reduced only the sizes are shown: one of them may be missing.
  if (test.strain.empty()) return sizes;
  // Of a test that was stopped before the break these are lower bounds.
  const auto bounded = [&](const std::string& name) {
    return test.broke ? name : name + ", at least";
  };
  Facts facts{
      {"Modulus",
       fmt::format("{}\u00a0GPa, in the window {}\u00a0%",
                   plus_minus(test.modulus / in::GPa, test.modulus_standard_error / in::GPa),
                   interval(test.window_low / in::percent, test.window_high / in::percent))},
      {bounded("Strength"),
       fmt::format("{}\u00a0MPa",
                   plus_minus(test.strength / in::MPa, test.strength_standard_error / in::MPa))},
      {"Largest force", quantity(test.max_force, "N")},
      {bounded("Failure strain"), quantity(test.failure_strain / in::percent, "%")},
      {bounded("Energy to failure"), quantity(test.energy_to_failure / in::MPa, "MJ/m³")},
      {"Strain rate",
       test.strain_rate > 0.0 ? quantity(test.strain_rate, "1/s", 3) : "time not recorded"},
      {"Strength / (modulus · failure strain)", number(test.linearity, 3)}};
  facts.insert(facts.begin(), sizes.begin(), sizes.end());
  return facts;
}

// A dash for what was not reduced.
double known(const ImportReport& report, double value) {
  return report.test.strain.empty() ? std::numeric_limits<double>::quiet_NaN() : value;
}

// How the two clocks are related, with errors, or why they cannot be aligned.
std::string clocks_caption(const calib::ClockFit& clocks) {
  if (!clocks.problem.empty())
    return fmt::format(
        "The two clocks, which cannot be aligned: {}. Drawn is the offset that fits best; nothing "
        "was taken from it.",
        typeset(clocks.problem));
  std::string caption = fmt::format(
      "The two clocks. When the logger's shows {}\u00a0s, the machine's shows {}\u00a0s. ",
      number(clocks.reference), plus_minus(clocks.offset, clocks.offset_standard_error));
  caption +=
      clocks.rate_fitted
          ? fmt::format("The machine's runs {} times as fast. ",
                        plus_minus(clocks.rate, clocks.rate_standard_error))
          : "The signals do not tell how much faster one runs: the rates are taken as equal. ";
  return caption + fmt::format(
                       "The rates of the signals correlate by {}. Below: what is left "
                       "between the aligned signals, without the rows at the break.",
                       number(clocks.correlation, 3));
}

mstch::node clocks_section(const ImportReport& report, std::size_t index) {
  mstch::array figures;
  if (report.clocks != nullptr)
    figures.emplace_back(
        mstch::map{{"figure", text(draw(clocks_figure(*report.clocks, fmt::format("c{}", index))))},
                   {"caption", text(clocks_caption(*report.clocks))}});
  return section(figures);
}

// Everything the page shows of one test, in the table and in its own part.
mstch::map content_of(const ImportReport& report, std::size_t index) {
  const calib::MeasuredTest& test = report.test;
  const std::string least = test.broke || test.strain.empty() ? "" : "≥ ";
  return {
      {"file", text(base_name(report.file))},
      {"specimen", text(report.raw.specimen_id)},
      {"rows", text(std::to_string(report.raw.rows()))},
      {"modulus", text(plus_minus(known(report, test.modulus) / in::GPa,
                                  test.modulus_standard_error / in::GPa))},
      {"strength", text(least + plus_minus(known(report, test.strength) / in::MPa,
                                           test.strength_standard_error / in::MPa))},
      {"failure_strain", text(least + number(known(report, test.failure_strain) / in::percent))},
      {"warning_count", text(std::to_string(test.warnings.size()))},
      {"caption", text(test.strain.empty()
                           ? "As read; why it cannot be used stands below."
                           : "As read, and as used after the corrections below. The shaded window "
                             "holds the points that the modulus was fitted to.")},
      {"clocks", clocks_section(report, index)},
      {"problems", text_section(report.problems)},
      {"figure", text(draw(test_figure(report, fmt::format("t{}", index))))},
      {"facts", fact_list(facts_of(report))},
      {"corrections", correction_section(test.corrections)},
      {"warnings", text_section(test.warnings)}};
}

// Which tests can be used, and whether any has a warning.
mstch::map verdict_of_tests(const std::vector<ImportReport>& reports) {
  std::vector<std::string> cannot;
  long warnings = 0;
  for (const ImportReport& report : reports) {
    if (!report.problems.empty()) cannot.push_back(base_name(report.file));
    warnings += static_cast<long>(report.test.warnings.size());
  }
  const std::string reserve =
      warnings == 0 ? "" : fmt::format(", with {}", count(warnings, "warning"));
  return {
      {"grade", grade(cannot.empty(), warnings == 0)},
      {"sentence", text(how_many_can("be used", "test", reports.size(), cannot) + reserve + ".")}};
}

}  // namespace

std::string test_svg(const ImportReport& report, const std::string& id) {
  return draw(test_figure(report, id));
}

std::string clocks_svg(const calib::ClockFit& clocks, const std::string& id) {
  return draw(clocks_figure(clocks, id));
}

std::string import_page(const std::vector<ImportReport>& reports,
                        const calib::Provenance& provenance) {
  mstch::array tests;
  for (std::size_t i = 0; i < reports.size(); ++i) tests.emplace_back(content_of(reports[i], i));
  mstch::map content = verdict_of_tests(reports);
  content["tests"] = tests;
  return render_page(fmt::format("havers import: {}", count(reports.size(), "test")), "import",
                     content, provenance);
}

}  // namespace havers::reports
