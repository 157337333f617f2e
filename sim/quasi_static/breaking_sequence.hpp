// The quasi-static limit: the breaking sequence, event by event, without time steps. Section 6 of
// sim/README.md.
#pragma once

#include "sim/simulation.hpp"

namespace havers::sim {

/// Part of the strength below which a quasi-static run no longer follows an avalanche: the scene's
/// end fraction, or more where a specimen was never seen to become stronger thereafter: uniform
/// thresholds of d ≤ 1 in 40 fibres or more without missing joints. None of 5750 such avalanches
/// stopped below 1 − 0.25 d but where one of the layers had gone, and none of 135 more led to a
/// greater strength: neither that nor the failure strain depends on what follows, and it is most of
/// the work. [-]
double end_fraction_used(const Scene& scene);

/// Runs a scene in the limit of a vanishing strain rate.
Simulation simulate_quasi_static(const Scene& scene, const Observer& observer);

}  // namespace havers::sim
