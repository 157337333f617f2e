// Implicit Euler with joints that break: non-smooth contact dynamics. Sections 2, 3 and 5 of
// sim/README.md.
#pragma once

#include "sim/simulation.hpp"

namespace havers::sim {

/// Hours, and a curve that fills the memory.
inline constexpr int most_steps_of_a_run = 10'000'000;

/// How one run is stepped.
struct Stepping {
  double step = 0.0;               ///< h. [s]
  bool leap = false;               ///< Whether a step ends on the first break of uniform motion;
                                   ///< with `leave_out` those before are leapt over.
  int most = most_steps_of_a_run;  ///< After so many it ends, broken or not.
};

/// One run in steps of one length, whatever the scene's own, in SI units. Its status is that of the
/// row where it ends: broken, the strain limit, or why it went no further. What the step errs by is
/// not known (`step_error` is none), and the ground of the regime is left to the caller.
Simulation run_in_steps(const Scene& scene, const Stepping& stepping, const Observer& observer = {},
                        const StopAsked& stop_asked = {});

/// Runs a scene by its own time step, or by one that is halved until the failure strain stands
/// (step_control.hpp).
Simulation simulate_dynamic(const Scene& scene, const Observer& observer = {},
                            const StopAsked& stop_asked = {});

}  // namespace havers::sim
