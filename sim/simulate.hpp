// Which regime a scene is simulated in, and why. (simulate itself is declared in simulation.hpp.)
#pragma once

#include <string>

#include "sim/scene.hpp"

namespace havers::sim {

/// The regime a scene will be run in. Never automatic.
struct RegimeChoice {
  Regime regime = Regime::dynamic;
  double inertia_number = 0.0;  ///< I = ε̇ (W/c) / (σ₁/E), c of the softer layers (M12). [-]
  std::string ground;           ///< Why, in one sentence.
};

/// Below this inertia number `automatic` takes the quasi-static limit.
inline constexpr double quasi_static_below = 2e-4;

/// The scene's regime or, where that is automatic, the one that (M12) gives. Lays an assembly where
/// the scene gives thresholds, as σ₁ follows from these.
RegimeChoice choose_regime(const Scene& scene);

/// W/c of the softer layers: how long a wave takes from end to end (M12). [s]
double time_across(const Scene& scene);

}  // namespace havers::sim
