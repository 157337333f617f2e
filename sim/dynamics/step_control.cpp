#include "sim/dynamics/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/dynamics/time_stepping.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/outcome.hpp"

namespace havers::sim {
namespace {

constexpr int most_halvings = 10;
// Of a third or later run. Two always run: their difference is the error.
constexpr int most_steps = 4000;

std::string ground_of(const Simulation& run, double accuracy) {
  std::string halved;
  if (!std::isnan(run.step_error->failure_strain))
    halved = fmt::format(
        ": halving to it changed the failure strain by {:.2g} % and the strength by {:.2g} %",
        100.0 * run.step_error->failure_strain, 100.0 * run.step_error->strength);
  if (run.step_error->largest() > accuracy)
    halved += fmt::format(", more than the {:g} % asked for", 100.0 * accuracy);
  return fmt::format("; the step of {:.3g} ns is chosen{}", 1e9 * run.step, halved);
}

}  // namespace

bool may_leap(const Scene& scene) {
  return scene.solver.leave_out && scene.loading.start == Start::uniform;
}

double first_step(const Scene& scene) {
  const double wave = wave_speed(scene.material);
  const double transit = may_leap(scene) ? 0.25 * scene.assembly.fibre_height / wave
                                         : 0.5 * scene.assembly.fibre_length / wave;
  const double strain = 0.02 * head_tail_strength(scene) / scene.material.young;
  return std::min(transit, strain / scene.loading.strain_rate);
}

Simulation run_in_chosen_steps(const Scene& scene, const Observer& observer) {
  Stepping stepping{.step = first_step(scene), .leap = may_leap(scene)};
  Simulation run;
  constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  run.failure_strain = run.strength = not_known;
  int agreed = 0;
  for (int halving = 0; halving <= most_halvings; ++halving) {
    const double strain = run.failure_strain, strength = run.strength;  // with twice the step
    run = run_in_steps(scene, stepping, observer);
    summarise(run);
    run.step_error = has_ended(run)
                         ? StepError{std::abs(run.failure_strain - strain) / run.failure_strain,
                                     std::abs(run.strength - strength) / run.strength}
                         : StepError{not_known, not_known};  // half a run tells nothing
    agreed = run.step_error->largest() < 0.5 * scene.solver.step_accuracy ? agreed + 1 : 0;
    if (!has_ended(run) || agreed == 2) break;
    if (halving > 0 && 2 * run.steps > most_steps) break;
    stepping.step *= 0.5;
  }
  run.regime_ground = ground_of(run, scene.solver.step_accuracy);
  return run;
}

}  // namespace havers::sim
