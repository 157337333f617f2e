// The quasi-static limit: the breaking sequence, event by event, without time steps. Section 6 of
// sim/README.md.
#pragma once

#include "sim/simulation.hpp"

namespace havers::sim {

/// Runs a scene in the limit of a vanishing strain rate.
Simulation simulate_quasi_static(const Scene& scene, const Observer& observer);

}  // namespace havers::sim
