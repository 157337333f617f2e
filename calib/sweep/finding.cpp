// A claim asks that every comparison lie in a range; its outcome follows from where the intervals
// lie. Only the numbers that are shown are held within what they can be, not those that are judged.
#include "calib/sweep/finding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "calib/count.hpp"
#include "calib/decimals.hpp"
#include "calib/sweep/comparison.hpp"
#include "calib/sweep/measure_words.hpp"

namespace havers::calib {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-9;  // a difference of no more is none

// Where a value must lie for the claim to hold; for `matters`, for it not to hold.
struct Bracket {
  double low = -infinity, high = infinity;
};

Bracket range_of(const FindingRequest& request) {
  const double margin = request.margin;
  switch (request.test) {
    case FindingTest::same:
    case FindingTest::matters:
    case FindingTest::linear:
      return {-margin, margin};
    case FindingTest::rises:
      return {rounding, infinity};
    case FindingTest::falls:
      return {-infinity, -rounding};
    case FindingTest::steady:
    case FindingTest::below:
      return {-infinity, margin};
    case FindingTest::above:
      return {margin, infinity};
  }
  return {};
}

// Whether the whole interval lies inside; one that is not known is neither inside nor outside.
bool inside(const Comparison& c, Bracket range) {
  return c.low >= range.low && c.high <= range.high;
}

bool outside(const Comparison& c, Bracket range) {
  const double slack = c.step ? 2.0 * rounding : 0.0;  // a step may well be none
  return c.high < range.low - slack || c.low > range.high + slack;
}

// Every interval inside: agrees. One wholly outside: disagrees; where it is that of a step between
// neighbours only, what the ends say is in doubt. The interval of a step need not lie inside, but
// it has to be known.
FindingOutcome outcome_of(const std::vector<Comparison>& comparisons, Bracket range) {
  bool agrees = true;
  for (const Comparison& c : comparisons) {
    if (!c.step && outside(c, range)) return FindingOutcome::disagrees;
    agrees = agrees && !std::isnan(c.low) && (c.step ? !outside(c, range) : inside(c, range));
  }
  return agrees ? FindingOutcome::agrees : FindingOutcome::undecided;
}

// How far beyond the range the end lies that decides: of an interval wholly outside the nearer one.
// What is not known speaks more against a claim than what lies inside, less than what lies beyond.
double excess(const Comparison& c, Bracket range) {
  if (std::isnan(c.low)) return 0.0;
  return outside(c, range) ? std::max(range.low - c.high, c.low - range.high)
                           : std::max(range.low - c.low, c.high - range.high);
}

// What speaks most against the claim, first of all what makes it disagree; a step does only where
// its interval lies wholly outside, or is not known.
Comparison worst_of(const std::vector<Comparison>& comparisons, Bracket range) {
  return *std::ranges::max_element(comparisons, {}, [range](const Comparison& c) {
    const bool beyond = outside(c, range);
    const bool idle = c.step && !beyond && !std::isnan(c.low);
    return std::pair{beyond && !c.step, idle ? -infinity : excess(c, range)};
  });
}

FindingOutcome opposite(FindingOutcome outcome) {
  if (outcome == FindingOutcome::undecided) return outcome;
  return outcome == FindingOutcome::agrees ? FindingOutcome::disagrees : FindingOutcome::agrees;
}

std::string in_its_unit(Measure measure, double value) {
  const MeasureWords words = words_of(measure);
  return fmt::format("{:g}{}{}", value / words.scale, words.unit.empty() ? "" : " ", words.unit);
}

std::string ground_of(const FindingRequest& request) {
  const double percent = 100.0 * request.margin;
  switch (request.test) {
    case FindingTest::same:
      return fmt::format("all differences within ±{:.4g} %", percent);
    case FindingTest::matters:
      return fmt::format("a difference beyond ±{:.4g} %", percent);
    case FindingTest::rises:
      return "all differences from end to end above 0, none between neighbours below";
    case FindingTest::falls:
      return "all differences from end to end below 0, none between neighbours above";
    case FindingTest::linear:
      return fmt::format("all means within ±{:.4g} % of the line", percent);
    case FindingTest::steady:
      return fmt::format("all coefficients of variation below {:.4g} %", percent);
    case FindingTest::above:
      return fmt::format("all means above {}", in_its_unit(request.response, request.margin));
    case FindingTest::below:
      return fmt::format("all means below {}", in_its_unit(request.response, request.margin));
  }
  return "";
}

std::string meaning_of(const FindingRequest& request, FindingOutcome outcome) {
  if (outcome == FindingOutcome::undecided) return request.if_undecided;
  return outcome == FindingOutcome::agrees ? request.if_agrees : request.if_disagrees;
}

// The comparison as a reader sees it: Student's interval of a share may end where no share can be.
void show(const Comparison& comparison, const FindingRequest& request, Finding& finding) {
  finding.compared = comparison.compared;
  finding.value = comparison.value;
  finding.low = comparison.low;
  finding.high = comparison.high;
  // Runs that are equal but for rounding have no interval to show.
  if (finding.high - finding.low <= rounding * std::abs(finding.value))
    finding.low = finding.high = finding.value;
  if (!judges_means(request.test) || !is_share(request.response) || std::isnan(comparison.low))
    return;
  finding.low = std::max(finding.low, 0.0);
  finding.high = std::min(finding.high, 1.0);
}

// The runs that say nothing of the response, and why; those that did not break are told apart.
std::string without_value(const Evidence& evidence, const PointGroup& group) {
  const Measure response = evidence.request.response;
  long failed = 0, without = 0;
  for (const SweepRun& run : evidence.runs) {
    if (std::ranges::find(group.points, run.point) == group.points.end()) continue;
    const bool open = run.unbroken() && needs_break(response);
    failed += run.failed ? 1 : 0;
    without += !run.failed && !open && std::isnan(run[response]) ? 1 : 0;
  }
  std::string text;
  const auto say = [&text](long runs, const char* what) {
    if (runs > 0)
      text += fmt::format("; {} {} and {} not count", count(runs, "run"), what,
                          runs == 1 ? "does" : "do");
  };
  say(failed, "failed");
  say(without, response == Measure::crack_linked ? "broke no head-tail joint"
                                                 : "had the modulus of a shock");
  return text;
}

// In a list a point may have none that differs from it in the key alone.
PointGroup compared_of(const std::vector<Comparison>& comparisons, PointGroup group) {
  if (comparisons.empty()) return group;
  std::erase_if(group.points, [&](std::size_t point) {
    return std::ranges::none_of(comparisons, [point](const Comparison& c) {
      return std::ranges::find(c.points, point) != c.points.end();
    });
  });
  return group;
}

Finding judge_group(const Evidence& evidence, const PointGroup& group) {
  const FindingRequest& request = evidence.request;
  Finding finding;
  finding.id = request.id;
  finding.claim = request.claim;
  finding.per = request.per;
  finding.at = group.value;
  finding.test = request.test;
  finding.response = request.response;
  finding.ground = ground_of(request);
  // Not known until something is compared.
  finding.value = finding.low = finding.high = std::numeric_limits<double>::quiet_NaN();
  finding.inertia_low = finding.inertia_high = finding.value;
  // A bound is no value: a single run that did not break leaves nothing to compare.
  const long unbroken = unbroken_of(evidence.runs, group.points, request.response);
  const std::vector<Comparison> comparisons =
      unbroken > 0 ? std::vector<Comparison>{} : comparisons_of(evidence, group);
  finding.comparisons = static_cast<int>(comparisons.size());
  const PointGroup compared = compared_of(comparisons, group);
  // fmin and fmax take the number where the other is none.
  for (const std::size_t point : compared.points) {
    finding.runs += static_cast<long>(values_of(evidence.runs, point, request.response).size());
    const double inertia = evidence.points[point].inertia_number;
    finding.inertia_low = std::fmin(finding.inertia_low, inertia);
    finding.inertia_high = std::fmax(finding.inertia_high, inertia);
  }
  finding.ground += without_value(evidence, group);
  if (unbroken > 0)
    finding.ground +=
        fmt::format("; {} did not break: raise loading.max_strain", count(unbroken, "run"));
  if (const std::size_t alone = group.points.size() - compared.points.size(); alone > 0)
    finding.ground += fmt::format("; not compared: {} that no other is like but for the key",
                                  count(alone, "point"));
  if (!comparisons.empty()) {
    const Bracket range = range_of(request);
    const Comparison worst = worst_of(comparisons, range);
    show(worst, request, finding);
    finding.asked_low = range.low;
    finding.asked_high = range.high;
    finding.outcome = outcome_of(comparisons, range);
    if (worst.step && outside(worst, range) && finding.outcome == FindingOutcome::undecided)
      finding.ground += "; this step goes the other way";
    // `matters` is judged as `same`, and means the contrary.
    if (request.test == FindingTest::matters) finding.outcome = opposite(finding.outcome);
  }
  finding.meaning = meaning_of(request, finding.outcome);
  return finding;
}

}  // namespace

bool judges_means(FindingTest test) {
  return test == FindingTest::above || test == FindingTest::below;
}

std::string to_string(const std::vector<ComparedKey>& keys) {
  std::string text;
  for (const auto& [name, value, against] : keys)
    text += fmt::format("{}{} = {}{}{}", text.empty() ? "" : ", ", name, value,
                        against.empty() ? "" : " against ", against);
  return text;
}

std::string to_string(FindingOutcome outcome) {
  constexpr std::array words{"agrees", "disagrees", "undecided"};
  return words.at(static_cast<std::size_t>(outcome));
}

int extra_digits(const Finding& finding, double scale) {
  const double width = (finding.high - finding.low) / scale;
  if (!std::isfinite(width) || width <= 0.0) return 0;
  // The page rounds to the second digit of the interval's width, but never coarser than whole
  // units.
  const double unit = scale * std::pow(10.0, -decimals_for(width));
  const auto steps = [unit](double value) { return std::round(value / unit); };
  // An end that lies beyond what was asked, but is rounded to it or inside, would contradict the
  // outcome.
  const bool hidden =
      (finding.low < finding.asked_low && steps(finding.low) >= steps(finding.asked_low)) ||
      (finding.high > finding.asked_high && steps(finding.high) <= steps(finding.asked_high));
  return hidden ? 1 : 0;
}

std::optional<PointGroup> group_without_comparison(const FindingRequest& request,
                                                   const SweepPlan& plan,
                                                   const std::vector<SweepPoint>& points) {
  for (const PointGroup& group : groups_of(points, plan, request.per))
    if (compares_nothing(request, plan, points, group)) return group;
  return {};
}

std::vector<Finding> judge(const FindingRequest& request, const SweepPlan& plan,
                           const std::vector<SweepPoint>& points,
                           const std::vector<SweepRun>& runs) {
  const Evidence evidence{request, plan, points, runs};
  std::vector<Finding> findings;
  for (const PointGroup& group : groups_of(points, plan, request.per))
    findings.push_back(judge_group(evidence, group));
  return findings;
}

}  // namespace havers::calib
