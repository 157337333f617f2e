// Implicit Euler with joints that break: non-smooth contact dynamics. Sections 2, 3 and 5 of
// sim/README.md.
#pragma once

#include "sim/simulation.hpp"

namespace havers::sim {

/// h that `step_s` omitted stands for: a thousandth of the strain σ₁/E a step, and at most half the
/// time a wave takes along a fibre. [s]
double choose_step(const Scene& scene);

/// Runs a scene by time steps.
Simulation simulate_dynamic(const Scene& scene, const Observer& observer);

}  // namespace havers::sim
