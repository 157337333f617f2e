// Each scene takes one thing of a small wall to the ends of what a scene may ask for: steps,
// materials, geometry, strengths, loadings. The last ones have no answer at all.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "sim/assembly/assembly.hpp"
#include "sim/bench/stability.hpp"
#include "sim/bench/watched_run.hpp"

namespace havers::sim {
namespace {

using Scenes = std::vector<StabilityScene>;

Scene wall(int layers = 4, int fibres = 3, double degrees = 0.0) {
  Scene scene;
  scene.assembly.layers = layers;
  scene.assembly.fibres = fibres;
  scene.assembly.orientation = degrees * std::numbers::pi / 180.0;
  return scene;
}

// Both strengths stay the same part of the modulus.
Scene with_modulus(double young, Scene scene = wall()) {
  const double factor = young / scene.material.young;
  scene.material.young = young;
  scene.joints.head_tail *= factor;
  scene.joints.flank *= factor;
  return scene;
}

Scene with_fibres(double length, double height, Scene scene = wall()) {
  scene.assembly.fibre_length = length;
  scene.assembly.fibre_height = height;
  return scene;
}

Scene quasi_static(Scene scene) {
  scene.solver.regime = Regime::quasi_static;
  return scene;
}

// Steps of h c/L = `size`, the first break in the eleventh.
Scene dynamic(double size, Scene scene) {
  const double h = size * scene.assembly.fibre_length / wave_speed(scene.material);
  const double first = first_break_by_uniform_stress(scene);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = h;
  scene.loading.strain_rate = std::min(first, scene.loading.max_strain) / (10.5 * h);
  return scene;
}

void add_both(Scenes& scenes, const std::string& name, const Scene& scene) {
  scenes.push_back({name + ", quasi-static", quasi_static(scene)});
  scenes.push_back({name + ", stepped", dynamic(1.0, scene)});
}

void add_steps_and_materials(Scenes& scenes) {
  // The condition of the joints' operator grows with the square of this (M10).
  for (const double size : {1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6})
    scenes.push_back({fmt::format("h c/L = {:g}", size), dynamic(size, wall())});
  for (const double young : {1e3, 1e12})
    add_both(scenes, fmt::format("modulus {:g} Pa", young), with_modulus(young));
  for (const double density : {1e-3, 1e6}) {
    Scene scene = wall();
    scene.material.density = density;
    scenes.push_back({fmt::format("density {:g} kg/m³", density), dynamic(1.0, scene)});
  }
  for (const double poisson : {0.0, 0.4999}) {
    Scene scene = wall();
    scene.material.plane = Plane::strain;
    scene.material.poisson = poisson;
    add_both(scenes, fmt::format("plane strain, Poisson's ratio {:g}", poisson), scene);
  }
  for (const double contrast : {1e-3, 1e-6}) {
    Scene scene = wall();
    scene.material.layer_contrast = contrast;
    add_both(scenes, fmt::format("every second layer {:g} as stiff", contrast), scene);
  }
  // For layers across the load the closed form holds only without lateral contraction.
  Scene in_series = wall(4, 3, 90.0);
  in_series.material.layer_contrast = 1e-3;
  in_series.material.poisson = 0.0;
  scenes.push_back({"layers in series, every second 0.001 as stiff", quasi_static(in_series)});
  Scene auxetic = wall();
  auxetic.material.poisson = -0.9;
  add_both(scenes, "Poisson's ratio −0.9", auxetic);
  for (const double viscosity : {1e-12, 1e-3}) {
    Scene scene = dynamic(1.0, wall());
    scene.material.viscosity = viscosity;
    // So slow that viscous stress alone takes at most half of what breaks a joint.
    scene.loading.strain_rate =
        std::min(scene.loading.strain_rate, 0.5 * first_break_by_uniform_stress(scene) / viscosity);
    scene.solver.step = 0.05 * first_break_by_uniform_stress(scene) / scene.loading.strain_rate;
    scenes.push_back({fmt::format("viscosity {:g} s", viscosity), scene});
  }
}

void add_geometries(Scenes& scenes) {
  add_both(scenes, "fibres of 10 nm", with_fibres(10e-9, 1e-9));
  add_both(scenes, "fibres of 1 m", with_fibres(1.0, 0.1));
  add_both(scenes, "fibres as long as high", with_fibres(10e-6, 10e-6));
  add_both(scenes, "fibres 1000 times as long as high", with_fibres(10e-3, 10e-6));
  for (const double degrees : {0.01, 45.0, 89.99, 90.0})
    add_both(scenes, fmt::format("fibres at {:g}°", degrees), wall(4, 3, degrees));
  add_both(scenes, "one fibre", wall(1, 1));
  add_both(scenes, "one layer", wall(1, 6));
  add_both(scenes, "two layers of one fibre", wall(2, 1));
  add_both(scenes, "a chain of 1000", wall(1, 1000));
  for (const int refinement : {2, 4}) {
    Scene scene = wall();
    scene.assembly.refinement = refinement;
    add_both(scenes, fmt::format("{} triangles a fibre", 8 * refinement * refinement), scene);
  }
  const auto add_free = [&](const std::string& name, Scene scene) {
    scene.loading.lateral = Lateral::free;
    add_both(scenes, name, scene);
  };
  add_free("free sides at 30°", wall(4, 3, 30.0));
  add_free("one fibre with free sides", wall(1, 1));
  add_free("a chain of hinges at 90° with free sides", wall(1, 2, 90.0));
  add_free("columns of hinges at 90° with free sides", wall(5, 18, 90.0));
}

void add_strengths(Scenes& scenes) {
  for (const double factor : {1e-12, 1e12}) {
    Scene scene = wall();
    scene.joints.head_tail *= factor;
    scene.joints.flank *= factor;
    add_both(scenes, fmt::format("thresholds {:g} of the usual", factor), scene);
  }
  for (const double r : {1e-4, 1e4}) {
    Scene scene = wall();
    scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, r);
    add_both(scenes, fmt::format("r = {:g}", r), scene);
  }
  for (const double scatter : {0.0, 1.99}) {
    Scene scene = wall(6, 5);
    scene.joints.scatter = scatter;
    add_both(scenes, fmt::format("scatter {:g}", scatter), scene);
  }
  for (const double friction : {0.0, 100.0}) {
    Scene scene = wall(6, 5, 45.0);
    scene.joints.friction = friction;
    add_both(scenes, fmt::format("friction {:g} at 45°", friction), scene);
  }
}

void add_loadings(Scenes& scenes) {
  for (const double rate : {1e-6, 1e6}) {
    Scene scene = wall();
    scene.loading.strain_rate = rate;
    scenes.push_back({fmt::format("strain rate {:g} /s, regime and step chosen", rate), scene});
  }
  // Short steps: above h c/L = 1 sweeps need very many (M10).
  for (const double size : {0.01, 0.1}) {
    Scene scene = dynamic(size, wall());
    scene.solver.contact = ContactMethod::gauss_seidel;
    scenes.push_back({fmt::format("Gauss-Seidel at h c/L = {:g}", size), scene});
  }
}

void add_refused(Scenes& scenes) {
  // `spoil` turns a scene into one that has no answer.
  const auto refuse = [&](const std::string& name, const auto& spoil) {
    Scene scene = wall();
    spoil(scene);
    scenes.push_back({name, scene, true});
  };
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  refuse("no stiffness", [](Scene& s) { s.material.young = 0.0; });
  refuse("a modulus that is no number", [](Scene& s) { s.material.young = no_number; });
  refuse("incompressible in plane strain", [](Scene& s) {
    s.material.plane = Plane::strain;
    s.material.poisson = 0.5;
  });
  refuse("no mass", [](Scene& s) { s.material.density = 0.0; });
  refuse("scatter 2: joints without strength", [](Scene& s) { s.joints.scatter = 2.0; });
  refuse("infinite strain rate",
         [](Scene& s) { s.loading.strain_rate = std::numeric_limits<double>::infinity(); });
  refuse("a step of no time", [](Scene& s) { s.solver.step = 0.0; });
  refuse("thresholds of another wall", [](Scene& s) { s.joints.thresholds = {{1.0, 1.0}}; });
  refuse("joints that are there twice", [](Scene& s) {
    const std::size_t joints = build_assembly(s.assembly, s.loading.lateral).joints.size();
    s.joints.thresholds.assign(2 * joints, {1e3, 1e3});
  });
  refuse("six layers of one fibre", [](Scene& s) {
    s.assembly.layers = 6;
    s.assembly.fibres = 1;
  });
  refuse("more fibres than fit", [](Scene& s) { s.assembly.layers = s.assembly.fibres = 100000; });
}

}  // namespace

std::vector<StabilityScene> stability_scenes() {
  Scenes scenes;
  add_steps_and_materials(scenes);
  add_geometries(scenes);
  add_strengths(scenes);
  add_loadings(scenes);
  add_refused(scenes);
  return scenes;
}

}  // namespace havers::sim
