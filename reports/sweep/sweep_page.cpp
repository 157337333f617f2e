#include "reports/sweep/sweep_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "reports/pages/page.hpp"
#include "reports/sweep/measure_words.hpp"
#include "reports/sweep/sweep_figure.hpp"
#include "reports/sweep/sweep_words.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

using calib::FindingOutcome;

mstch::node cell(std::string value) {
  return mstch::map{{"text", text(std::move(value))}};
}

std::string value_of(const calib::Finding& finding) {
  const MeasureWords words = words_of(finding.response);
  const bool absolute =
      finding.test == calib::FindingTest::above || finding.test == calib::FindingTest::below;
  const std::string what =
      finding.test == calib::FindingTest::steady   ? words.name + ", coefficient of variation"
      : finding.test == calib::FindingTest::linear ? words.name + ", away from the line"
      : absolute                                   ? words.name
                                                   : words.name + ", difference";
  const double scale = absolute ? words.scale : in::percent;
  return fmt::format("{}: {}", what,
                     with_interval(finding.value / scale, finding.low / scale, finding.high / scale,
                                   absolute ? words.unit : "%"));
}

std::string inertia_of(const calib::Finding& finding) {
  const std::string low = number(finding.inertia_low, 2), high = number(finding.inertia_high, 2);
  return "I = " + (low == high ? low : fmt::format("{} to {}", low, high));
}

std::string grade_of(FindingOutcome outcome) {
  return outcome == FindingOutcome::agrees      ? "pass"
         : outcome == FindingOutcome::disagrees ? "fail"
                                                : "warn";
}

std::string mark_of(FindingOutcome outcome) {
  return outcome == FindingOutcome::agrees ? "✓" : outcome == FindingOutcome::disagrees ? "✗" : "?";
}

// Key of the request that a finding is `at` a value of.
std::string place_of(const calib::Sweep& sweep, const calib::Finding& finding) {
  for (const calib::FindingRequest& request : sweep.findings)
    if (request.id == finding.id && request.claim == finding.claim && !request.per.empty() &&
        !finding.at.empty())
      return fmt::format("{}: {}", sweep.name, place(request.per, finding.at));
  return sweep.name;
}

std::string words_for(std::string what, const calib::SweepPlan& plan) {
  for (const calib::SweepKey& key : plan.keys) {
    const std::string named = key.name + " = ";
    for (std::size_t at = what.find(named); at != std::string::npos; at = what.find(named)) {
      const std::size_t value = at + named.size();
      const std::size_t end =
          std::min({what.find(", ", value), what.find(" against ", value), what.size()});
      what.replace(at, end - at, place(key.name, what.substr(value, end - value)));
    }
  }
  return what;
}

struct Row {
  const calib::Finding* finding;
  const calib::Sweep* sweep;
};

// All findings by id, in the order of sweeps within one.
std::vector<Row> rows_of(const std::vector<SweepReport>& sweeps) {
  std::vector<Row> rows;
  for (const SweepReport& report : sweeps)
    for (const calib::Finding& finding : report.result.findings)
      rows.push_back({&finding, &report.sweep});
  std::ranges::stable_sort(rows, {}, [](const Row& row) { return row.finding->id; });
  return rows;
}

mstch::array finding_rows(const std::vector<Row>& rows) {
  mstch::array list;
  for (const auto& [finding, sweep] : rows)
    list.emplace_back(
        mstch::map{{"grade", text(grade_of(finding->outcome))},
                   {"mark", text(mark_of(finding->outcome))},
                   {"outcome", text(to_string(finding->outcome))},
                   {"id", text(finding->id)},
                   {"claim", text(typeset(finding->claim))},
                   {"at", text(place_of(*sweep, *finding))},
                   {"inertia", text(inertia_of(*finding))},
                   {"value", text(value_of(*finding))},
                   {"what", text(words_for(finding->what, sweep->plan))},
                   {"ground", text(typeset("asked: " + finding->ground))},
                   {"meaning", finding->meaning.empty() ? mstch::node{false}
                                                        : text(typeset(finding->meaning))},
                   {"runs", text(std::to_string(finding->runs))}});
  return list;
}

// An id holds when all its rows agree, is contradicted when all disagree; else it is mixed.
std::string sentence_of(const std::vector<Row>& rows, long runs) {
  if (rows.empty()) return fmt::format("{} of the model.", count(runs, "run"));
  std::map<std::string, std::set<FindingOutcome>> outcomes;
  for (const Row& row : rows) outcomes[row.finding->id].insert(row.finding->outcome);
  std::array<std::string, 3> names;  // holds, contradicted, mixed
  std::array<int, 3> counts{};
  for (const auto& [id, set] : outcomes) {
    const bool one = set.size() == 1;
    const std::size_t kind = one && set.contains(FindingOutcome::agrees)      ? 0
                             : one && set.contains(FindingOutcome::disagrees) ? 1
                                                                              : 2;
    names.at(kind) += (names.at(kind).empty() ? "" : ", ") + id;
    ++counts.at(kind);
  }
  std::string sentence =
      fmt::format("Of {}: ", count(static_cast<long>(outcomes.size()), "finding"));
  const std::array<std::string_view, 3> say{"agree", "disagree", "are mixed or undecided"},
      of_one{"agrees", "disagrees", "is mixed or undecided"};
  bool first = true;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    if (counts.at(kind) == 0) continue;
    sentence += fmt::format("{}{} {} ({})", first ? "" : "; ", counts.at(kind),
                            counts.at(kind) == 1 ? of_one.at(kind) : say.at(kind), names.at(kind));
    first = false;
  }
  return sentence + ".";
}

bool all_trusted(const std::vector<SweepReport>& sweeps) {
  return std::ranges::all_of(sweeps, [](const SweepReport& one) { return one.result.trusted(); });
}

// Runs without an answer are worse than claims that do not hold.
std::string grade_of(const std::vector<Row>& rows, const std::vector<SweepReport>& sweeps) {
  if (!all_trusted(sweeps)) return "bad";
  const bool agree = std::ranges::all_of(
      rows, [](const Row& row) { return row.finding->outcome == FindingOutcome::agrees; });
  return agree ? "good" : "mixed";
}

std::string with_unit(const MeasureWords& words) {
  return words.unit.empty() ? words.name : fmt::format("{} ({})", words.name, words.unit);
}

std::string law_text(const calib::Law& law) {
  std::string terms;
  for (const std::string& term : law.request.terms) terms += name_of_key(term) + ", ";
  return fmt::format("{} linear in {}", with_unit(words_of(law.request.response)),
                     terms.substr(0, terms.size() - 2));
}

std::string coefficients_of(const calib::Law& law) {
  if (law.status != calib::LawStatus::fitted) return explain(law.status);
  const double scale = words_of(law.request.response).scale;
  std::string all;
  for (std::size_t i = 0; i < law.coefficients.size(); ++i) {
    const double value = law.coefficients[i] / scale;
    const double half = law.confidence_factor * law.standard_errors[i] / scale;
    const std::string name =
        i < law.request.terms.size() ? name_of_key(law.request.terms[i]) : "constant";
    all += fmt::format("{}{}: {}", all.empty() ? "" : "; ", name,
                       with_interval(value, value - half, value + half));
  }
  return all;
}

mstch::array law_rows(const std::vector<calib::Law>& laws) {
  mstch::array list;
  for (const calib::Law& law : laws)
    list.emplace_back(mstch::map{
        {"law", text(law_text(law))},
        {"at", text(law.request.per.empty() ? "" : place(law.request.per, law.at))},
        {"coefficients", text(coefficients_of(law))},
        {"explained", text(number(law.explained, 3))},
        {"lack",
         text(fmt::format("{} ({})", number(law.lack_of_fit, 3), chance(law.lack_of_fit_p)))},
        {"runs", text(std::to_string(law.runs))}});
  return list;
}

std::vector<calib::Measure> known_measures(const calib::SweepResult& result) {
  std::vector<calib::Measure> known;
  for (std::size_t m = 0; m < calib::measure_count; ++m)
    if (std::ranges::any_of(result.summaries, [m](const calib::PointSummary& s) {
          return s[static_cast<calib::Measure>(m)].n > 0;
        }))
      known.push_back(static_cast<calib::Measure>(m));
  return known;
}

mstch::array point_heads(const SweepReport& report) {
  mstch::array heads;
  const auto head = [&heads](const std::string& name) {
    heads.emplace_back(mstch::map{{"name", text(name)}});
  };
  if (report.sweep.levels > 1) head("Level");
  for (const calib::SweepKey& key : report.sweep.plan.keys) head(name_of_key(key.name));
  head("I");
  head("n");
  head("Did not break");
  for (const calib::Measure m : known_measures(report.result)) head(with_unit(words_of(m)));
  head("CV of the strength (%)");
  head("Weibull modulus");
  head("ln-likelihood, Gumbel − Weibull");
  return heads;
}

mstch::node point_row(const SweepReport& report, std::size_t i) {
  const calib::SweepPoint& point = report.result.points[i];
  const calib::PointSummary& summary = report.result.summaries[i];
  const calib::StrengthLaw& law = report.result.strengths[i];
  mstch::array cells;
  if (report.sweep.levels > 1) cells.push_back(cell(std::to_string(point.level)));
  for (const std::string& value : point.values) cells.push_back(cell(bare(value)));
  cells.push_back(cell(number(point.inertia_number, 2)));
  cells.push_back(cell(std::to_string(summary.runs - summary.failed)));
  cells.push_back(cell(std::to_string(summary.unbroken)));
  for (const calib::Measure m : known_measures(report.result))
    cells.push_back(cell(plus_minus(summary[m].mean / words_of(m).scale,
                                    summary[m].standard_error() / words_of(m).scale)));
  const calib::Statistics& strength = summary[calib::Measure::strength];
  cells.push_back(cell(number(100.0 * strength.sd / strength.mean, 2)));
  const auto [low, high] = law.weibull_modulus_95;
  cells.push_back(cell(law.runs > 0 ? with_interval(law.weibull_modulus, low, high) : number(NAN)));
  cells.push_back(cell(law.runs > 0 ? number(law.log_likelihood_gain, 2) : number(NAN)));
  return mstch::map{{"cells", mstch::node{cells}}};
}

mstch::array figures_of(const SweepReport& report) {
  mstch::array figures;
  for (const calib::SweepFigure& wanted : report.sweep.figures) {
    mstch::array panels;
    const std::string id = fmt::format("{}-{}", report.id, figures.size());
    for (const SweepPanel& panel : sweep_figures(report.sweep, report.result, wanted, id))
      panels.emplace_back(mstch::map{{"svg", text(draw(panel.figure))}, {"at", text(panel.at)}});
    figures.emplace_back(mstch::map{{"layout", text(panels.size() > 1 ? "images" : "one")},
                                    {"panels", mstch::node{panels}},
                                    {"caption", text(typeset(wanted.caption))}});
  }
  return figures;
}

mstch::node sweep_part(const SweepReport& report) {
  mstch::array rows;
  for (std::size_t i = 0; i < report.result.points.size(); ++i)
    rows.push_back(point_row(report, i));
  return mstch::map{
      {"name", text(report.sweep.name)},
      {"about", text(fmt::format("{} {}, {} each.", typeset(report.sweep.text),
                                 count(static_cast<long>(report.result.points.size()), "point"),
                                 count(report.sweep.plan.seeds, "run")))},
      {"figures", mstch::node{figures_of(report)}},
      {"has_laws", mstch::node{!report.result.laws.empty()}},
      {"laws", mstch::node{law_rows(report.result.laws)}},
      {"count", text(std::to_string(report.result.points.size()))},
      {"heads", mstch::node{point_heads(report)}},
      {"rows", mstch::node{rows}}};
}

}  // namespace

std::string sweep_page(const std::string& title, const std::vector<SweepReport>& sweeps,
                       const Provenance& provenance, double wall_seconds) {
  const std::vector<Row> rows = rows_of(sweeps);
  long runs = 0, failed = 0, unbroken = 0;
  mstch::array parts;
  for (const SweepReport& report : sweeps) {
    runs += static_cast<long>(report.result.runs.size());
    for (const calib::PointSummary& summary : report.result.summaries) {
      failed += summary.failed;
      unbroken += summary.unbroken;
    }
    parts.push_back(sweep_part(report));
  }
  const std::string why_not_trusted =
      all_trusted(sweeps) ? "" : "Not to be trusted: too many runs failed or did not break. ";
  return render_page(
      title, "sweep",
      {{"grade", text(grade_of(rows, sweeps))},
       {"sentence", text(why_not_trusted + sentence_of(rows, runs))},
       {"detail",
        text(fmt::format(
            "{}, {} failed, {} did not break, {} wall time; seeds are not shared between points.",
            count(runs, "run"), failed, unbroken, duration(wall_seconds)))},
       {"has_findings", mstch::node{!rows.empty()}},
       {"findings", mstch::node{finding_rows(rows)}},
       {"sweeps", mstch::node{parts}}},
      provenance);
}

}  // namespace havers::reports
