// Settings differ from the scene's own in few things, so that a bench shows what these cost and
// change.
#include "sim/bench/bench_setting.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/bench/watched_run.hpp"
#include "sim/simulate.hpp"

namespace havers::sim {
namespace {

constexpr int finest = 4;  // refinement of the last mesh that is tried

BenchSetting stepped(BenchSetting setting, double step) {
  setting.regime = Regime::dynamic;
  setting.step = step;
  return setting;
}

BenchSetting on_mesh(BenchSetting setting, int refinement) {
  setting.refinement = refinement;
  return setting;
}

// Of a scene in the limit. On finer meshes the limit has no other error than that of the mesh.
std::vector<BenchSetting> settings_of_limit(const BenchSetting& own, double h) {
  std::vector<BenchSetting> settings{own};
  for (const double step : {h, h / 4.0, h / 16.0}) settings.push_back(stepped(own, step));
  for (int finer = 2 * own.refinement; finer <= finest; finer *= 2)
    settings.push_back(on_mesh(own, finer));
  return settings;
}

// Of a scene in time. What is left out shows at a given step: a chosen one is many runs, each of
// which would take every step to the first break. A finer mesh is shown at the longest step, where
// what it changes is mostly the step's error drawn anew (failure strains of
// data_samples/scenes/bench.toml: 1 to 10 %, by the step alone 3 %), and at the shortest, where the
// mesh shows (0.3 to 0.4 %, 0.2 %).
std::vector<BenchSetting> settings_in_time(const BenchSetting& own, double h) {
  std::vector<BenchSetting> settings{without_omissions(stepped(own, h))};
  for (const double step : {h, h / 4.0, h / 16.0}) settings.push_back(stepped(own, step));
  settings.push_back(own);
  for (const double tolerance : {1e-4, 1e-6, 1e-8})
    for (const double step : {h, h / 4.0})
      settings.push_back({.contact = ContactMethod::gauss_seidel,
                          .tolerance = tolerance,
                          .step = step,
                          .refinement = own.refinement});
  for (int finer = 2 * own.refinement; finer <= finest; finer *= 2)
    for (const double step : {h, h / 16.0}) settings.push_back(on_mesh(stepped(own, step), finer));
  return settings;
}

}  // namespace

std::string to_string(const BenchSetting& setting) {
  // All descriptions end with the mesh.
  const std::string rest =
      fmt::format("{}, {} triangles a fibre", setting.leave_out ? "" : ", nothing left out",
                  8 * setting.refinement * setting.refinement);
  if (setting.regime == Regime::quasi_static) return "quasi-static" + rest;
  std::string step = setting.step ? "h = " + step_in_words(*setting.step) : "h chosen";
  if (setting.leap) step += " from the first break on";
  if (setting.contact == ContactMethod::gauss_seidel)
    return fmt::format("Gauss-Seidel {:.0e}, {}{}", setting.tolerance, step, rest);
  return fmt::format("active set, {}{}", step, rest);
}

bool has_chosen_steps(const BenchSetting& setting) {
  return setting.regime == Regime::dynamic && !setting.step;
}

Scene with_setting(const BenchSetting& setting, Scene scene) {
  scene.solver.regime = setting.regime;
  scene.solver.contact = setting.contact;
  scene.solver.tolerance = setting.tolerance;
  scene.solver.step = setting.step;
  scene.solver.leap = setting.leap;
  scene.solver.leave_out = setting.leave_out;
  scene.assembly.refinement = setting.refinement;
  return scene;
}

double base_step(const Scene& scene) {
  if (choose_regime(scene).regime == Regime::quasi_static)
    return 1e-2 * std::min(first_break_by_uniform_stress(scene), scene.loading.max_strain) /
           scene.loading.strain_rate;
  return scene.solver.step.value_or(0.25 * scene.assembly.fibre_length /
                                    wave_speed(scene.material));
}

BenchSetting direct_setting(const Scene& scene) {
  return {.regime = choose_regime(scene).regime,
          .tolerance = scene.solver.tolerance,
          .refinement = scene.assembly.refinement};
}

BenchSetting without_omissions(BenchSetting setting) {
  setting.leave_out = false;
  return setting;
}

std::vector<BenchSetting> bench_settings(const Scene& scene) {
  const BenchSetting own = direct_setting(scene);
  const double h = base_step(scene);
  return own.regime == Regime::quasi_static ? settings_of_limit(own, h) : settings_in_time(own, h);
}

}  // namespace havers::sim
