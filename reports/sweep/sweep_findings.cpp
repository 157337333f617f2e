// Findings test claims on the runs of a sweep. A claim, known by its id, may be tested in several
// sweeps and at several values: the table shows each test as a row, the sentence counts claims.
#include "reports/sweep/sweep_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "calib/sweep/measure_words.hpp"
#include "reports/sweep/sweep_words.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

using calib::FindingOutcome;

// What was judged, with its interval: a mean in its own unit, all else in percent.
std::string value_of(const calib::Finding& finding) {
  const calib::MeasureWords words = calib::words_of(finding.response);
  const bool absolute = judges_means(finding.test);
  const std::string what =
      finding.test == calib::FindingTest::steady   ? words.name + ", coefficient of variation"
      : finding.test == calib::FindingTest::linear ? words.name + ", away from the line"
      : absolute                                   ? words.name
                                                   : words.name + ", difference";
  const double scale = absolute ? words.scale : in::percent;
  return fmt::format(
      "{}: {}", what,
      with_interval(finding.value / scale, finding.low / scale, finding.high / scale,
                    absolute ? words.unit : "%", calib::extra_digits(finding, scale)));
}

// The least and the largest inertia number of the runs that the finding rests on.
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

std::string place_of(const calib::Sweep& sweep, const calib::Finding& finding) {
  return finding.per.empty() ? sweep.name
                             : fmt::format("{}: {}", sweep.name, place(finding.per, finding.at));
}

// "θ = 45° against 0°, d = 0.4": what was compared, and where.
std::string words_for(const std::vector<calib::ComparedKey>& keys) {
  std::string text;
  for (const auto& [name, value, against] : keys) {
    text += (text.empty() ? "" : ", ") + place(name, value);
    if (!against.empty()) text += " against " + with_unit(name, against);
  }
  return text;
}

}  // namespace

std::vector<FindingRow> findings_of(const std::vector<SweepReport>& sweeps) {
  std::vector<FindingRow> rows;
  for (const SweepReport& report : sweeps)
    for (const calib::Finding& finding : report.result.findings)
      rows.push_back({&finding, &report.sweep});
  // Rows of the same id stay in the order of the sweeps.
  std::ranges::stable_sort(rows, {}, [](const FindingRow& row) { return row.finding->id; });
  return rows;
}

mstch::array finding_rows(const std::vector<FindingRow>& rows) {
  return list_of(rows, [](const FindingRow& row) {
    const auto& [finding, sweep] = row;
    return mstch::map{{"grade", text(grade_of(finding->outcome))},
                      {"mark", text(mark_of(finding->outcome))},
                      {"outcome", text(to_string(finding->outcome))},
                      {"id", text(finding->id)},
                      {"claim", text(typeset(finding->claim))},
                      {"at", text(place_of(*sweep, *finding))},
                      {"inertia", text(inertia_of(*finding))},
                      {"value", text(value_of(*finding))},
                      {"what", text(words_for(finding->compared))},
                      {"ground", text(typeset("asked: " + finding->ground))},
                      {"meaning", finding->meaning.empty() ? mstch::node{false}
                                                           : text(typeset(finding->meaning))},
                      {"runs", text(std::to_string(finding->runs))}};
  });
}

std::string findings_sentence(const std::vector<FindingRow>& rows) {
  std::map<std::string, std::set<FindingOutcome>> outcomes;
  for (const FindingRow& row : rows) outcomes[row.finding->id].insert(row.finding->outcome);
  std::array<std::string, 4> names;  // agree, disagree, undecided, one row so and another so
  std::array<int, 4> counts{};
  for (const auto& [id, set] : outcomes) {
    // The first three of `names` are in the order of FindingOutcome.
    const std::size_t kind = set.size() == 1 ? static_cast<std::size_t>(*set.begin()) : 3;
    names.at(kind) += (names.at(kind).empty() ? "" : ", ") + id;
    ++counts.at(kind);
  }
  std::string sentence =
      fmt::format("Of {}{}: ", count(outcomes.size(), "finding"),
                  rows.size() == outcomes.size() ? "" : fmt::format(" in {} rows", rows.size()));
  const std::array<std::string_view, 4> say{"agree", "disagree", "are undecided", "differ by row"},
      of_one{"agrees", "disagrees", "is undecided", "differs by row"};
  bool first = true;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    if (counts.at(kind) == 0) continue;
    sentence += fmt::format("{}{} {} ({})", first ? "" : "; ", counts.at(kind),
                            counts.at(kind) == 1 ? of_one.at(kind) : say.at(kind), names.at(kind));
    first = false;
  }
  return sentence + ".";
}

}  // namespace havers::reports
