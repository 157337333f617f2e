#include "sim/outcome.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace havers::sim {

double lateral_contraction(const Material& material) {
  const double nu = material.poisson;
  return material.plane == Plane::stress ? nu : nu / (1.0 - nu);
}

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

bool has_failed(Simulation& simulation, double end_fraction) {
  const CurvePoint& last = simulation.curve.back();
  simulation.strength = std::max(simulation.strength, last.stress_right);
  constexpr double nothing = 1e-9;  // of the strength
  const double limit = std::max(end_fraction, nothing) * simulation.strength;
  return last.broken_joints > 0 && last.stress_right < limit && last.stress_left < limit;
}

namespace {

// Stress at a strain, by linear interpolation in the loading part of the curve.
double stress_at(const std::vector<CurvePoint>& curve, double strain) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i].strain < strain) continue;
    const CurvePoint &a = curve[i - 1], &b = curve[i];
    const double width = b.strain - a.strain;
    const double w = width > 0.0 ? (strain - a.strain) / width : 1.0;
    return (1.0 - w) * a.stress_right + w * b.stress_right;
  }
  return curve.back().stress_right;
}

}  // namespace

void summarise(Simulation& simulation) {
  const std::vector<CurvePoint>& curve = simulation.curve;
  if (curve.empty()) return;
  const auto strongest = std::max_element(
      curve.begin(), curve.end(),
      [](const CurvePoint& a, const CurvePoint& b) { return a.stress_right < b.stress_right; });
  simulation.strength = strongest->stress_right;
  simulation.failure_strain = strongest->strain;
  simulation.broken_joints = curve.back().broken_joints;
  simulation.first_break_strain = std::numeric_limits<double>::quiet_NaN();
  for (const JointOutcome& joint : simulation.joints)
    if (joint.broken && !is_missing(joint.threshold) &&
        !(simulation.first_break_strain <= joint.broken_at_strain))
      simulation.first_break_strain = joint.broken_at_strain;
  const double end = std::isnan(simulation.first_break_strain) ? curve.back().strain
                                                               : simulation.first_break_strain;
  simulation.modulus = end > 0.0 ? stress_at(curve, 0.5 * end) / (0.5 * end) : 0.0;
}

}  // namespace havers::sim
