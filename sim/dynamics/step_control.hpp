// The choice of the time step by what it does to the failure strain. Section 8 of sim/README.md.
#pragma once

#include <string>

#include "sim/simulation.hpp"

namespace havers::sim {

/// Whether steps are placed so that one ends on the first break of uniform motion: in chosen steps,
/// or where the scene asks for it. From rest the motion is a shock.
bool knows_first_break(const Scene& scene);

/// Whether a run leaps to that break, too: where nothing is left out every step is taken.
bool may_leap(const Scene& scene);

/// Where halving starts: a quarter of the time a wave takes across a fibre or, from rest, half of
/// that along it; at most a fiftieth of the strain σ₁/E, and of the strain limit, a step. [s]
double first_step(const Scene& scene);

/// That a run in chosen steps may end before its specimen breaks, or takes steps that another leaps
/// over, as a sentence; empty where it leaps and has steps enough to the strain σ₁/E.
std::string doubt_about_steps(const Scene& scene);

/// Runs a scene with first_step and ever half of it, until two halvings in turn have changed the
/// failure strain and the strength by less than half of `step_accuracy`: implicit Euler is of first
/// order, so what is left is about the last change. Ends as well where a further run would be too
/// long, or where two lengths in turn have no answer. The last run that came to its end is the
/// answer, or the one that was cancelled; `step_error` and `regime_ground` say what its last two
/// halvings changed at most.
Simulation run_in_chosen_steps(const Scene& scene, const Observer& observer = {},
                               const StopAsked& stop_asked = {});

}  // namespace havers::sim
