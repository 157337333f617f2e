// The quasi-static limit: the breaking sequence, event by event, without time steps. Section 6 of
// sim/README.md.
#pragma once

#include "sim/simulation.hpp"

namespace havers::sim {

/// Part of the strength at which an avalanche is known for one. What follows happens at one and the
/// same strain, so no quantity that a test measures depends on it, and it is most of the work. [-]
inline constexpr double avalanche_known_at = 0.8;

/// The end fraction a quasi-static run goes to: the scene's, or `avalanche_known_at` where things
/// are left out.
double end_fraction_used(const Scene& scene);

/// Runs a scene in the limit of a vanishing strain rate.
Simulation simulate_quasi_static(const Scene& scene, const Observer& observer);

}  // namespace havers::sim
