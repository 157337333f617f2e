// A scene that a bench runs by all its settings in seconds.
#pragma once

#include "tests/support/scenes.hpp"

namespace havers::test {

inline sim::Scene tiny(sim::Regime regime) {
  sim::Scene scene = small_scene(0.0, 4, 3);
  scene.solver.regime = regime;
  if (regime == sim::Regime::quasi_static) return scene;
  scene.loading.strain_rate = 1e5;  // breaks after 20 steps that Gauss-Seidel is quick with
  scene.solver.step = 2e-9;
  scene.solver.step_accuracy = 0.1;  // chosen steps stay long, and with them the reference's
  return scene;
}

}  // namespace havers::test
