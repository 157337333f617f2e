#include "calib/sweep/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/simulate.hpp"

namespace havers::calib {
namespace {

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

// (M2) Fibres in uniform motion bear a viscous stress E τ ε̇ from the start on; τ ε̇ is the strain
// that would make it. 0 where it has to build up from rest, and in the quasi-static limit. [-]
double viscous_strain_of(const sim::Scene& scene) {
  const bool from_the_start = scene.loading.start == sim::Start::uniform &&
                              sim::choose_regime(scene).regime == sim::Regime::dynamic;
  return from_the_start ? scene.material.viscosity * scene.loading.strain_rate : 0.0;
}

// The strain up to which the curve stays within 1 % of the strength of the modulus's line, at most
// the failure strain.
double linear_until(const Response& response, double viscous_strain) {
  double until = 0.0;
  for (std::size_t i = 0; i < response.strain.size(); ++i) {
    if (response.strain[i] == 0.0) continue;  // the first row bears nothing yet
    const double line = response.modulus * (response.strain[i] + viscous_strain);
    if (std::abs(response.stress[i] - line) > 0.01 * response.strength) return until;
    until = std::min(response.strain[i], response.failure_strain);
  }
  return until;
}

}  // namespace

double inertia_of(const sim::Scene& scene) {
  return scene.solver.regime == sim::Regime::quasi_static
             ? not_measured
             : sim::choose_regime(scene).inertia_number;
}

std::array<double, measure_count> measures_of(const Response& response, const sim::Scene& scene,
                                              const Pattern* pattern) {
  std::array<double, measure_count> measures{};
  measures.fill(not_measured);
  // A measure that is not set stays NaN, and counts in no mean.
  if (response.failed || response.strain.empty()) return measures;
  const auto set = [&](Measure m, double value) {
    measures.at(static_cast<std::size_t>(m)) = value;
  };
  const double failure = response.failure_strain;
  set(Measure::strength, response.strength);
  set(Measure::failure_strain, failure);
  // Without a modulus there is no line to compare with.
  if (response.modulus > 0.0) {
    set(Measure::modulus, response.modulus);
    set(Measure::linear_part, linear_until(response, viscous_strain_of(scene)) / failure);
  }
  // Without a break the run ends at the strain limit, which says nothing of the fall.
  if (response.broke) set(Measure::fall_part, (response.strain.back() - failure) / failure);
  if (pattern == nullptr) return measures;
  set(Measure::head_tail_broken, pattern->head_tail);
  set(Measure::flank_broken, pattern->flank);
  set(Measure::crack_span, pattern->span);
  set(Measure::crack_linked, pattern->linked);
  return measures;
}

bool is_share(Measure m) {
  return m == Measure::linear_part || m == Measure::crack_span || m == Measure::crack_linked;
}

bool needs_break(Measure m) {
  return m != Measure::modulus;
}

std::vector<double> values_of(const std::vector<SweepRun>& runs, std::size_t point, Measure m) {
  std::vector<double> values;
  for (const SweepRun& run : runs)
    if (run.point == point && !run.failed && !(run.unbroken() && needs_break(m)) &&
        std::isfinite(run[m]))
      values.push_back(run[m]);
  return values;
}

long unbroken_of(const std::vector<SweepRun>& runs, const std::vector<std::size_t>& points,
                 Measure m) {
  if (!needs_break(m)) return 0;
  return std::ranges::count_if(runs, [&](const SweepRun& run) {
    return run.unbroken() && std::ranges::find(points, run.point) != points.end();
  });
}

PointSummary summary_of(const std::vector<SweepRun>& runs, std::size_t point) {
  PointSummary summary;
  for (const SweepRun& run : runs) {
    if (run.point != point) continue;
    ++summary.runs;
    summary.failed += run.failed ? 1 : 0;
    summary.unbroken += run.unbroken() ? 1 : 0;
    summary.reserved += run.reserved() ? 1 : 0;
  }
  std::ranges::transform(all_measures, summary.measures.begin(),
                         [&](Measure m) { return statistics_of(values_of(runs, point, m)); });
  return summary;
}

std::vector<PointGroup> groups_of(const std::vector<SweepPoint>& points, const SweepPlan& plan,
                                  const std::string& key) {
  const std::size_t column = plan.column(key);
  std::vector<PointGroup> groups;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].level > 1) continue;
    // A key that does not vary, or is empty, makes one group.
    const std::string value = column == plan.keys.size() ? "" : points[i].values[column];
    // A new group goes to the end, so that values are in the order in which they first occur.
    auto group = std::ranges::find(groups, value, &PointGroup::value);
    if (group == groups.end()) group = groups.insert(group, {value, {}});
    group->points.push_back(i);
  }
  return groups;
}

}  // namespace havers::calib
