// The quasi-static limit: the breaking sequence, event by event, without time steps. Section 6 of
// sim/README.md.
#pragma once

#include "sim/simulation.hpp"

namespace havers::sim {

/// Part of the strength below which a quasi-static run no longer follows an avalanche: the scene's
/// end fraction, or 0.995 − 25(1 + 2e)/(nN) − d²/20 − e/10, e = max(0, d − 1), where that is more
/// and a specimen is as good as never stronger thereafter: uniform thresholds, of d ≤ 1 unless
/// fibres lie along the load, f₁ no less than a fifth of f₂, equal layers, no joint missing. What
/// follows is most of the work. Section 6. [-]
double end_fraction_used(const Scene& scene);

/// Whether missing joints leave nothing that bears a load: no way from end to end, or one of hinges
/// that gives way. Pieces that press on each other may still bear something. False where that is
/// not found, or the search was stopped.
bool is_severed(const Scene& scene, const StopAsked& stop_asked = {});

/// Runs a scene in the limit of a vanishing strain rate.
Simulation simulate_quasi_static(const Scene& scene, const Observer& observer = {},
                                 const StopAsked& stop_asked = {});

}  // namespace havers::sim
