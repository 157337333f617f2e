// Small scenes for tests of the model.
#pragma once

#include <numbers>

#include "sim/scene.hpp"

namespace havers::test {

inline constexpr double degree = std::numbers::pi / 180.0;

/// Orientations at which the clipping differs in kind. [°]
inline constexpr double orientations[] = {0.0, 17.0, 45.0, 63.4, 90.0};

/// Walls of which the clipping leaves less than 1e-6 of some half fibres.
struct SliverWall {
  int layers, fibres;
  double slenderness, orientation_deg;
};
inline constexpr SliverWall walls_with_slivers[] = {
    {1, 5, 10.0, 35.0}, {6, 5, 10.0, 53.5}, {1, 5, 10.0, 58.0},          {4, 3, 10.0, 0.01},
    {4, 3, 10.0, 1e-4}, {4, 3, 10.0, 1e-6}, {5, 4, 10.0, 89.9999348911}, {1, 4, 600.0, 89.99999}};

inline sim::AssemblyOptions assembly_of(const SliverWall& wall) {
  return {.layers = wall.layers,
          .fibres = wall.fibres,
          .fibre_length = wall.slenderness * 1e-5,
          .fibre_height = 1e-5,
          .orientation = wall.orientation_deg * degree};
}

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
