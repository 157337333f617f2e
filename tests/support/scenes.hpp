// Small scenes for tests of the model.
#pragma once

#include <numbers>

#include "sim/scene.hpp"

namespace havers::test {

inline constexpr double degree = std::numbers::pi / 180.0;

/// Orientations at which the clipping differs in kind. [°]
inline constexpr double orientations[] = {0.0, 17.0, 45.0, 63.4, 90.0};

/// A scene of a few fibres in the quasi-static limit.
inline sim::Scene small_scene(double orientation_deg = 0.0, int layers = 6, int fibres = 5) {
  sim::Scene scene;
  scene.assembly.layers = layers;
  scene.assembly.fibres = fibres;
  scene.assembly.orientation = orientation_deg * degree;
  scene.solver.regime = sim::Regime::quasi_static;
  return scene;
}

/// The same by time steps. @param step  h [s]
inline sim::Scene dynamic_scene(double orientation_deg = 0.0, double step = 2e-8) {
  sim::Scene scene = small_scene(orientation_deg);
  scene.solver.regime = sim::Regime::dynamic;
  scene.solver.step = step;
  return scene;
}

}  // namespace havers::test
