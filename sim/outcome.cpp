#include "sim/outcome.hpp"

#include <algorithm>
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

bool has_failed(Simulation& simulation, double end_fraction) {
  const CurvePoint& last = simulation.curve.back();
  simulation.strength = std::max(simulation.strength, last.stress_right);
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
  const CurvePoint before = next == curve.begin() ? CurvePoint{} : *std::prev(next);
  const double width = next->strain - before.strain;
  const double w = width > 0.0 ? (strain - before.strain) / width : 1.0;
  return (1.0 - w) * before.stress_right + w * next->stress_right;
}

void summarise(Simulation& simulation) {
  const std::vector<CurvePoint>& curve = simulation.curve;
  if (curve.empty()) return;
  const auto strongest = std::ranges::max_element(curve, {}, &CurvePoint::stress_right);
  simulation.strength = strongest->stress_right;
  simulation.failure_strain = strongest->strain;
  simulation.broken_joints = curve.back().broken_joints;
  simulation.first_break_strain = std::numeric_limits<double>::quiet_NaN();
  for (const JointOutcome& joint : simulation.joints)
    if (joint.broke() && !(simulation.first_break_strain <= joint.broken_at_strain))
      simulation.first_break_strain = joint.broken_at_strain;
  const double end = std::isnan(simulation.first_break_strain) ? curve.back().strain
                                                               : simulation.first_break_strain;
  simulation.modulus = end > 0.0 ? stress_at(curve, 0.5 * end).value_or(0.0) / (0.5 * end) : 0.0;
}

}  // namespace havers::sim
