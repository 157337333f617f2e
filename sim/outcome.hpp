// What both regimes do alike: the start and the end of a simulation.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "sim/simulation.hpp"

namespace havers::sim {

/// The larger; not a number where one of them is none, as no later row makes up for that.
inline double worse(double a, double b) {
  return a < b || std::isnan(b) ? b : a;
}

/// All joints with their thresholds, intact but for those that are missing.
std::vector<JointOutcome> initial_outcomes(const std::vector<Threshold>& thresholds);

/// The strength so far, with the last row.
void take_note_of_strength(Simulation& simulation);

/// Whether both sides have dropped below the end fraction of the strength so far after a break.
bool has_failed(const Simulation& simulation, double end_fraction);

/// Whether a run came to its end, by a break, at the largest strain or severed from the start: only
/// then it has a strength.
bool has_ended(const Simulation& run);

/// Stress at the right side where the curve first reaches a strain, linear from row to row and from
/// the origin to the first; none beyond the largest strain. [Pa]
std::optional<double> stress_at(const std::vector<CurvePoint>& curve, double strain);

/// Largest mean over a stretch of strain of the mean stress over such a stretch, which weighs two
/// of them that end at a row by a triangle: of waves that take a stretch, or the n-th part of one,
/// it leaves nothing, of all that ring n times as fast some 1/n². NaN where the curve is shorter,
/// the largest stress where a stretch is next to nothing of it. Strains rise. [Pa]
/// @param span  length of a stretch, > 0. [-]
double largest_mean_stress(const std::vector<CurvePoint>& curve, double span);

/// The modulus is the slope from a tenth of this strain on: of the first break, or of the last row
/// where nothing broke. Precondition: the curve has rows.
double strain_of_modulus(const Simulation& simulation);
inline constexpr double modulus_stretch = 0.4;  ///< Part of that strain over which it is measured.

/// Strength, failure strain, modulus, first break and counts from the curve and the joints.
void summarise(Simulation& simulation);

}  // namespace havers::sim
