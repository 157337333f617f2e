// What a curve says once it is there: the state of failure, means over waves, and the numbers of a
// result.
#include "sim/outcome.hpp"

#include <gsl/gsl_fit.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

namespace havers::sim {

std::vector<JointOutcome> initial_outcomes(const std::vector<Threshold>& thresholds) {
  std::vector<JointOutcome> joints;
  joints.reserve(thresholds.size());
  for (const Threshold& threshold : thresholds) {
    const bool missing = is_missing(threshold);
    joints.push_back(
        {.threshold = threshold,
         .broken = missing,
         .broken_at_strain = missing ? 0.0 : std::numeric_limits<double>::quiet_NaN()});
  }
  return joints;
}

void take_note_of_strength(Simulation& simulation) {
  simulation.strength = std::max(simulation.strength, simulation.curve.back().stress_right);
}

bool has_failed(const Simulation& simulation, double end_fraction) {
  const CurvePoint& last = simulation.curve.back();
  // With an end fraction of 0 a run ends where it bears nothing but rounding.
  constexpr double nothing = 1e-9;  // of the strength
  const double limit = std::max(end_fraction, nothing) * simulation.strength;
  return last.broken_joints > 0 && last.stress_right < limit && last.stress_left < limit;
}

bool has_ended(const Simulation& run) {
  return run.status == SimulationStatus::broken || run.status == SimulationStatus::strain_limit ||
         run.status == SimulationStatus::severed;
}

std::optional<double> stress_at(const std::vector<CurvePoint>& curve, double strain) {
  const auto next = std::ranges::find_if(
      curve, [strain](const CurvePoint& point) { return point.strain >= strain; });
  if (next == curve.end()) return std::nullopt;
  // The origin comes before the first row.
  const CurvePoint before = next == curve.begin() ? CurvePoint{} : *std::prev(next);
  const double width = next->strain - before.strain;
  const double w = width > 0.0 ? (strain - before.strain) / width : 1.0;
  return (1.0 - w) * before.stress_right + w * next->stress_right;
}

namespace {
struct Rows {
  std::vector<double> strain, stress;
};

// What was leapt over is straight, and gets rows where the two stretches before its end begin.
Rows rows_for_means(const std::vector<CurvePoint>& curve, double span) {
  Rows rows;
  for (const CurvePoint& point : curve) {
    for (const double before : {2.0 * span, span}) {
      if (rows.strain.empty() || point.strain - rows.strain.back() <= before) continue;
      const double part = before / (point.strain - rows.strain.back());
      rows.stress.push_back(part * rows.stress.back() + (1.0 - part) * point.stress_right);
      rows.strain.push_back(point.strain - before);
    }
    rows.strain.push_back(point.strain);
    rows.stress.push_back(point.stress_right);
  }
  return rows;
}

// Means over the stretch before each row that has one.
Rows means_of(const Rows& rows, double span) {
  const auto& [strain, stress] = rows;
  // By trapezoids, exact for what is linear from row to row. `left`, the row before a stretch
  // begins, only moves on: all stretches together cost O(rows).
  std::vector<double> area{0.0};  // under the curve up to each row
  Rows means;
  for (std::size_t i = 1, left = 0; i < strain.size(); ++i) {
    area.push_back(area.back() + 0.5 * (stress[i] + stress[i - 1]) * (strain[i] - strain[i - 1]));
    const double begin = strain[i] - span;
    if (begin < strain.front()) continue;
    while (left + 1 < i && strain[left + 1] <= begin) ++left;
    const double part = (begin - strain[left]) / (strain[left + 1] - strain[left]);
    const double height = stress[left] + part * (stress[left + 1] - stress[left]);
    const double before = area[left] + 0.5 * (stress[left] + height) * (begin - strain[left]);
    means.strain.push_back(strain[i]);
    means.stress.push_back((area[i] - before) / span);
  }
  return means;
}
}  // namespace

double largest_mean_stress(const std::vector<CurvePoint>& curve, double span) {
  assert(span > 0.0);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (curve.empty() || curve.back().strain - curve.front().strain < span) return none;
  // So short a stretch has few digits in the area, or none in the strain.
  if (span <= 1e-9 * curve.back().strain)
    return std::ranges::max(curve, {}, &CurvePoint::stress_right).stress_right;
  // The mean of means over stretches of one length has the weights of a triangle.
  const Rows means = means_of(means_of(rows_for_means(curve, span), span), span);
  return means.stress.empty() ? none : *std::ranges::max_element(means.stress);
}

namespace {

// By least squares over a stretch of this strain: neither a constant viscous stress nor the start,
// a first long step, is part of it. So many points that none of the steps of a stair hides between
// them.
double slope_up_to(double end, double start, const std::vector<CurvePoint>& curve) {
  constexpr std::size_t points = 401;
  constexpr double from = 0.1, latest_start = 0.4, to = from + modulus_stretch;
  const double begin = std::clamp(start / end, from, latest_start);
  std::array<double, points> strains{}, stresses{};
  for (std::size_t i = 0; i < points; ++i) {
    strains.at(i) = end * (begin + (to - begin) / (points - 1) * static_cast<double>(i));
    stresses.at(i) = stress_at(curve, strains.at(i)).value_or(0.0);
  }
  double offset = 0.0, slope = 0.0, c00 = 0.0, c01 = 0.0, c11 = 0.0, squares = 0.0;
  gsl_fit_linear(strains.data(), 1, stresses.data(), 1, points, &offset, &slope, &c00, &c01, &c11,
                 &squares);
  return slope;
}

}  // namespace

double strain_of_modulus(const Simulation& simulation) {
  // fmin passes over the strain of a first break that never came, which is NaN.
  return std::fmin(simulation.first_break_strain, simulation.curve.back().strain);
}

void summarise(Simulation& simulation) {
  const std::vector<CurvePoint>& curve = simulation.curve;
  if (curve.empty()) return;
  const auto strongest = std::ranges::max_element(curve, {}, &CurvePoint::stress_right);
  simulation.strength = strongest->stress_right;
  simulation.failure_strain = strongest->strain;
  simulation.broken_joints = curve.back().broken_joints;
  simulation.first_break_strain = std::numeric_limits<double>::quiet_NaN();
  // Written such that any strain takes the place of NaN.
  for (const JointOutcome& joint : simulation.joints)
    if (joint.broke() && !(simulation.first_break_strain <= joint.broken_at_strain))
      simulation.first_break_strain = joint.broken_at_strain;
  const double end = strain_of_modulus(simulation);
  // In time the stress of viscosity is there from the first step on.
  const double start =
      simulation.regime == Regime::dynamic && curve.size() > 1 ? curve[1].strain : 0.0;
  simulation.modulus = end > 0.0 ? slope_up_to(end, start, curve) : 0.0;
}

}  // namespace havers::sim
