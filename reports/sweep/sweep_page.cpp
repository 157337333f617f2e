// The verdict over all sweeps, the table of findings, and a part for each sweep.
#include "reports/sweep/sweep_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calib/sweep/measure_words.hpp"
#include "reports/pages/page.hpp"
#include "reports/sweep/sweep_figure.hpp"
#include "reports/sweep/sweep_findings.hpp"
#include "reports/sweep/sweep_words.hpp"
#include "reports/text/format.hpp"
#include "sim/simulate.hpp"

namespace havers::reports {
namespace {

using calib::words_of;

mstch::node cell(std::string value) {
  return mstch::map{{"text", text(std::move(value))}};
}

// Runs without an answer are worse than claims that do not hold.
mstch::node grade_of(const std::vector<FindingRow>& rows, bool trusted) {
  return grade(trusted, std::ranges::all_of(rows, [](const FindingRow& row) {
                 return row.finding->outcome == calib::FindingOutcome::agrees;
               }));
}

std::string with_unit(const calib::MeasureWords& words) {
  return words.unit.empty() ? words.name : fmt::format("{} ({})", words.name, words.unit);
}

std::string law_text(const calib::Law& law) {
  std::string terms;
  for (const std::string& term : law.request.terms) terms += name_of_key(term) + ", ";
  return fmt::format("{} linear in {}", with_unit(words_of(law.request.response)),
                     terms.substr(0, terms.size() - 2));
}

// Each coefficient with its 95 % interval; the response is in the unit of the law's heading.
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
  // The risk of rejecting a law that is right.
  constexpr double risk = 0.05;
  if (law.lack_of_fit_p < risk)
    all +=
        ". The law does not fit: its intervals are those of a line that the points do not follow";
  return all;
}

// The ratio, and the probability that chance alone makes it as large.
std::string lack_of_fit(const calib::Law& law) {
  const std::string ratio = number(law.lack_of_fit, 3);
  return std::isfinite(law.lack_of_fit) ? fmt::format("{} ({})", ratio, chance(law.lack_of_fit_p))
                                        : ratio;
}

mstch::map law_row(const calib::Law& law) {
  return {{"law", text(law_text(law))},
          {"at", text(law.request.per.empty() ? "" : place(law.request.per, law.at))},
          {"coefficients", text(coefficients_of(law))},
          {"explained", text(number(law.explained, 3))},
          {"lack", text(lack_of_fit(law))},
          {"runs", text(std::to_string(law.runs))}};
}

bool has_reservations(const SweepReport& report) {
  return !report.result.most_reserved_because.empty();
}

// In the same order as the cells of `point_row`.
mstch::array point_heads(const SweepReport& report) {
  mstch::array heads;
  const auto head = [&heads](const std::string& name) {
    heads.emplace_back(mstch::map{{"name", text(name)}});
  };
  if (report.sweep.levels > 1) head("Level");
  for (const calib::SweepKey& key : report.sweep.plan.keys) head(name_of_key(key.name));
  head("I");
  head("n");
  head("Failed");
  head("Did not break");
  if (has_reservations(report)) head("With a reservation");
  for (const calib::Measure m : report.result.known()) head(with_unit(words_of(m)));
  head("CV of the strength (%)");
  head("Weibull modulus");
  head("ln-likelihood, Gumbel − Weibull");
  return heads;
}

// A row for one point of the plan: what came of its seeds.
mstch::node point_row(const SweepReport& report, std::size_t i) {
  const calib::SweepPoint& point = report.result.points[i];
  const calib::PointSummary& summary = report.result.summaries[i];
  const calib::StrengthLaw& law = report.result.strengths[i];
  mstch::array cells;
  if (report.sweep.levels > 1) cells.push_back(cell(std::to_string(point.level)));
  for (const std::string& value : point.values) cells.push_back(cell(typeset(value)));
  cells.push_back(cell(number(point.inertia_number, 2)));
  cells.push_back(cell(std::to_string(summary.runs - summary.failed)));
  cells.push_back(cell(std::to_string(summary.failed)));
  cells.push_back(cell(std::to_string(summary.unbroken)));
  if (has_reservations(report)) cells.push_back(cell(std::to_string(summary.reserved)));
  for (const calib::Measure m : report.result.known())
    cells.push_back(cell(plus_minus(summary[m].mean / words_of(m).scale,
                                    summary[m].standard_error() / words_of(m).scale)));
  const calib::Statistics& strength = summary[calib::Measure::strength];
  cells.push_back(cell(number(100.0 * strength.sd / strength.mean, 2)));
  const auto [low, high] = law.weibull_modulus_95;
  cells.push_back(cell(law.runs > 0 ? with_interval(law.weibull_modulus, low, high) : number(NAN)));
  cells.push_back(cell(law.runs > 0 ? number(law.log_likelihood_gain, 2) : number(NAN)));
  return mstch::map{{"cells", cells}};
}

// Words of a user, as sentences before others.
std::string ended(const std::string& text) {
  return text.empty() ? "" : typeset(text) + (text.ends_with('.') ? " " : ". ");
}

// Whether a run ends early in its avalanche, as in the limit. In time all of it is followed.
bool leaves_avalanches_out(const calib::SweepPoint& point) {
  return point.scene.solver.leave_out &&
         sim::choose_regime(point.scene).regime == sim::Regime::quasi_static;
}

// Every figure with its caption, and a sentence on what its bars or curves are.
mstch::array figures_of(const SweepReport& report) {
  const std::string end =
      std::ranges::any_of(report.sweep.points, leaves_avalanches_out)
          ? " In the limit it ends where what follows of its avalanche is left out."
          : "";
  mstch::array figures;
  for (const calib::SweepFigure& wanted : report.sweep.figures) {
    const std::string shown =
        wanted.x.empty()
            ? "Each curve is one run: the first seed that has not failed, at the first value of "
              "every key that the figure does not tell apart." +
                  end
            : "Bars and bands: 95\u00a0% intervals of the means; that of a single run has none.";
    const std::string id = fmt::format("{}-{}", report.id, figures.size());
    const mstch::array panels = list_of(
        sweep_figures(report.sweep, report.result, wanted, id), [](const SweepPanel& panel) {
          return mstch::map{{"svg", text(draw(panel.figure))}, {"at", text(panel.at)}};
        });
    figures.emplace_back(mstch::map{{"layout", text(panels.size() > 1 ? "images" : "one")},
                                    {"panels", panels},
                                    {"caption", text(ended(wanted.caption) + shown)}});
  }
  return figures;
}

// The user's description, the number of runs, and the most frequent reasons of failures and of
// reservations.
std::string about(const SweepReport& report) {
  const std::string& why = report.result.most_failed_because;
  const std::string& but_for = report.result.most_reserved_because;
  const bool open = std::ranges::any_of(
      report.result.summaries, [](const calib::PointSummary& s) { return s.unbroken > 0; });
  return fmt::format(
      "{}{}, {}{}.{}{}{}", ended(report.sweep.text), count(report.result.points.size(), "point"),
      count(report.sweep.plan.seeds, "run"), report.result.points.size() == 1 ? "" : " each",
      why.empty() ? "" : fmt::format(" Runs that failed, most often so: {}.", typeset(why)),
      but_for.empty()
          ? ""
          : fmt::format(" Runs with a reservation, most often so: {}.", typeset(but_for)),
      open ? " Of points with runs that did not break the modulus alone is drawn." : "");
}

mstch::node sweep_part(const SweepReport& report) {
  mstch::array rows;
  for (std::size_t i = 0; i < report.result.points.size(); ++i)
    rows.push_back(point_row(report, i));
  return mstch::map{{"name", text(report.sweep.name)},
                    {"about", text(about(report))},
                    {"figures", figures_of(report)},
                    {"has_laws", !report.result.laws.empty()},
                    {"laws", list_of(report.result.laws, law_row)},
                    {"count", text(count(report.result.points.size(), "point"))},
                    {"heads", point_heads(report)},
                    {"rows", rows}};
}

}  // namespace

std::string sweep_page(const std::string& title, const std::vector<SweepReport>& sweeps,
                       const calib::Provenance& provenance) {
  const std::vector<FindingRow> rows = findings_of(sweeps);
  calib::SweepTotals totals;
  mstch::array parts;
  for (const SweepReport& report : sweeps) {
    totals.add(report.result);
    parts.push_back(sweep_part(report));
  }
  const std::string why_not_trusted =
      totals.trusted ? "" : "Not to be trusted: too many runs failed or did not break. ";
  return render_page(
      title, "sweep",
      {{"grade", grade_of(rows, totals.trusted)},
       {"sentence",
        text(why_not_trusted + (rows.empty() ? count(totals.runs, "run") + " of the model."
                                             : findings_sentence(rows)))},
       {"detail",
        text(fmt::format("{}, {} failed, {} did not break, {} with a reservation; {} of them "
                         "simulated now, in {} "
                         "wall time. Seeds are not shared between points.",
                         count(totals.runs, "run"), totals.failed, totals.unbroken, totals.reserved,
                         totals.simulated, duration(provenance.wall_seconds)))},
       {"has_findings", !rows.empty()},
       {"findings", finding_rows(rows)},
       {"sweeps", parts}},
      provenance);
}

}  // namespace havers::reports
