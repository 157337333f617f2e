#include "calib/sweep/comparison.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "calib/sweep/law.hpp"

namespace havers::calib {
namespace {

// Of all comparisons of a claim together; each has an equal share of it (Bonferroni).
constexpr double risk = 0.05;

// The values that tell a point of the sweep from others. The column `without` is left out; the
// number of keys stands for none.
std::vector<ComparedKey> keys_of(const SweepPlan& plan, const SweepPoint& point,
                                 std::size_t without) {
  std::vector<ComparedKey> keys;
  for (std::size_t i = 0; i < plan.keys.size(); ++i)
    if (i != without) keys.push_back({plan.keys[i].name, point.values[i], ""});
  return keys;
}

// Statistics of the response over the runs of a point that tell it.
Statistics at(const Evidence& evidence, std::size_t point) {
  return statistics_of(values_of(evidence.runs, point, evidence.request.response));
}

struct Pair {
  std::size_t first, second;
  bool step = false;
};

using Level = std::vector<std::size_t>;  // the points at one value of a key

// Groups the points `some` by their value in a column, from the smallest on; words in the order of
// the file. "1" and "1.0" are one value.
std::vector<Level> levels_of(const std::vector<SweepPoint>& points,
                             const std::vector<std::size_t>& some, std::size_t column) {
  std::vector<Level> levels;
  for (const std::size_t point : some) {
    const auto is_at = [&](const Level& level) {
      const SweepPoint &a = points[level.front()], &b = points[point];
      return a.values[column] == b.values[column] || a.numbers[column] == b.numbers[column];
    };
    const auto level = std::ranges::find_if(levels, is_at);
    (level == levels.end() ? levels.emplace_back() : *level).push_back(point);
  }
  std::ranges::stable_sort(levels, {}, [&](const Level& level) {
    const double number = points[level.front()].numbers[column];
    return std::isnan(number) ? 0.0 : number;
  });
  return levels;
}

// Every pair of unlike values, or those of the ends and, marked as steps, of neighbours.
void add_pairs(const std::vector<Level>& levels, bool of_ends, std::vector<Pair>& pairs) {
  for (std::size_t i = 0; i < levels.size(); ++i)
    for (std::size_t j = i + 1; j < levels.size(); ++j) {
      const bool ends = i == 0 && j + 1 == levels.size();
      if (of_ends && !ends && j != i + 1) continue;
      for (const std::size_t first : levels[i])
        for (const std::size_t second : levels[j])
          pairs.push_back({first, second, of_ends && !ends});
    }
}

// Points that differ in the key alone; in a list whose keys go together, where no value of the key
// comes twice, in any.
std::vector<Pair> pairs_of(const FindingRequest& request, const SweepPlan& plan,
                           const std::vector<SweepPoint>& points, const PointGroup& group) {
  const std::size_t column = plan.column(request.keys.front());
  const bool together = plan.sampling == Sampling::list &&
                        levels_of(points, group.points, column).size() == group.points.size();
  // The points grouped by the values of their other keys: within a group the key alone differs.
  std::map<std::string, std::vector<std::size_t>> alike;
  for (const std::size_t point : group.points)
    alike[together ? "" : to_string(keys_of(plan, points[point], column))].push_back(point);
  const bool of_ends = request.test == FindingTest::rises || request.test == FindingTest::falls;
  std::vector<Pair> pairs;
  for (const auto& [others, some] : alike)
    add_pairs(levels_of(points, some, column), of_ends, pairs);
  return pairs;
}

// (W3) Relative difference of two means, by the logarithm of their ratio and Welch's t.
Comparison difference(const Evidence& evidence, Pair pair, std::size_t column, double share) {
  const Statistics a = at(evidence, pair.first), b = at(evidence, pair.second);
  const SweepPoint& first = evidence.points[pair.first];
  const SweepPoint& second = evidence.points[pair.second];
  // Names, beside the key that is judged, those that both points have alike: in a list others may
  // differ too.
  std::vector<ComparedKey> compared{
      {evidence.plan.keys[column].name, second.values[column], first.values[column]}};
  std::ranges::copy_if(
      keys_of(evidence.plan, second, column), std::back_inserter(compared),
      [&](const auto& key) { return first.values[evidence.plan.column(key.name)] == key.value; });
  const double va = std::pow(a.standard_error() / a.mean, 2);
  const double vb = std::pow(b.standard_error() / b.mean, 2);
  // Welch's degrees of freedom. Equal runs have no variance, and any number will do.
  const double freedom = va + vb > 0.0
                             ? std::pow(va + vb, 2) / (va * va / static_cast<double>(a.n - 1) +
                                                       vb * vb / static_cast<double>(b.n - 1))
                             : 1.0;
  // With a mean of 0, or means of opposite signs, the interval is NaN, which counts as not known.
  const double log_ratio = std::log(b.mean / a.mean);
  const double half = gsl_cdf_tdist_Qinv(0.5 * share, freedom) * std::sqrt(va + vb);
  return {.compared = std::move(compared),
          .value = std::expm1(log_ratio),
          .low = std::expm1(log_ratio - half),
          .high = std::expm1(log_ratio + half),
          .step = pair.step,
          .points = {pair.first, pair.second}};
}

std::vector<Comparison> differences(const Evidence& evidence, const PointGroup& group) {
  const std::size_t column = evidence.plan.column(evidence.request.keys.front());
  const std::vector<Pair> pairs = pairs_of(evidence.request, evidence.plan, evidence.points, group);
  std::vector<Comparison> all;
  all.reserve(pairs.size());
  for (const Pair pair : pairs)
    all.push_back(difference(evidence, pair, column, risk / static_cast<double>(pairs.size())));
  return all;
}

// What `compare` says of each point by its statistics, at its share of the risk.
template <class Compare>
std::vector<Comparison> point_by_point(const Evidence& evidence, const PointGroup& group,
                                       Compare compare) {
  const double share = risk / static_cast<double>(group.points.size());
  std::vector<Comparison> all;
  for (const std::size_t point : group.points) {
    Comparison& one = all.emplace_back(compare(point, at(evidence, point), share));
    one.compared = keys_of(evidence.plan, evidence.points[point], evidence.plan.keys.size());
    one.points = {point};
  }
  return all;
}

// (W4) Coefficient of variation of each point, its interval by χ².
std::vector<Comparison> variations(const Evidence& evidence, const PointGroup& group) {
  return point_by_point(evidence, group, [](std::size_t, const Statistics& s, double share) {
    const auto freedom = static_cast<double>(std::max(s.n - 1, 1L));
    const double cv = s.sd / std::abs(s.mean);  // NaN of fewer than two runs
    return Comparison{.value = cv,
                      .low = cv * std::sqrt(freedom / gsl_cdf_chisq_Qinv(0.5 * share, freedom)),
                      .high = cv * std::sqrt(freedom / gsl_cdf_chisq_Pinv(0.5 * share, freedom))};
  });
}

std::vector<Comparison> means(const Evidence& evidence, const PointGroup& group) {
  return point_by_point(evidence, group, [](std::size_t, const Statistics& s, double share) {
    const double half = s.half_width(share);
    return Comparison{.value = s.mean, .low = s.mean - half, .high = s.mean + half};
  });
}

// (W5) Distance of each point's mean from the law, over the mean of all.
std::vector<Comparison> deviations(const Evidence& evidence, const PointGroup& group) {
  const LawRequest request{evidence.request.response, evidence.request.keys, evidence.request.per};
  // Looks for the line of this group; where it is not fitted, there is nothing to compare.
  for (const Law& law : fit_laws(request, evidence.plan, evidence.points, evidence.runs)) {
    if (law.at != group.value || law.status != LawStatus::fitted) continue;
    double level = 0.0;
    for (const std::size_t point : group.points) level += at(evidence, point).mean;
    level /= static_cast<double>(group.points.size());
    return point_by_point(
        evidence, group, [&](std::size_t point, const Statistics& s, double share) {
          const double off = s.mean - law.value(evidence.points[point], evidence.plan);
          const double value = off / level;
          // The interval is that of the point's mean alone; the error of the line is left aside
          // (W5).
          const double half = s.half_width(share) / std::abs(level);
          return Comparison{.value = value, .low = value - half, .high = value + half};
        });
  }
  return {};
}

}  // namespace

bool compares_nothing(const FindingRequest& request, const SweepPlan& plan,
                      const std::vector<SweepPoint>& points, const PointGroup& group) {
  switch (request.test) {
    case FindingTest::same:
    case FindingTest::matters:
    case FindingTest::rises:
    case FindingTest::falls:
      return pairs_of(request, plan, points, group).empty();
    case FindingTest::linear:
      return !tries_law({request.response, request.keys, request.per}, plan, points, group);
    case FindingTest::steady:
    case FindingTest::above:
    case FindingTest::below:
      return group.points.empty();
  }
  return true;
}

std::vector<Comparison> comparisons_of(const Evidence& evidence, const PointGroup& group) {
  switch (evidence.request.test) {
    case FindingTest::same:
    case FindingTest::matters:
    case FindingTest::rises:
    case FindingTest::falls:
      return differences(evidence, group);
    case FindingTest::linear:
      return deviations(evidence, group);
    case FindingTest::steady:
      return variations(evidence, group);
    case FindingTest::above:
    case FindingTest::below:
      return means(evidence, group);
  }
  return {};
}

}  // namespace havers::calib
