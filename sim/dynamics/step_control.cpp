// Halves the step until the answer stands (section 8). How much implicit Euler damps waves depends
// on the step, and waves decide what breaks next, so that no step fits all scenes; what is known of
// the error is the change by halving.
#include "sim/dynamics/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/dynamics/time_stepping.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/outcome.hpp"
#include "sim/simulate.hpp"

namespace havers::sim {
namespace {

constexpr int most_halvings = 10;

// Of a third or later run. Two always run: their difference is the error. A small wall, whose steps
// cost less, takes more.
double most_steps(const Simulation& run) {
  constexpr double of_any = 4e3, of_all_joints = 1e6;
  return std::max(of_any, of_all_joints / static_cast<double>(run.joints.size() + 1));
}

// Whether a run of half the step would be too long. Steps that a run which leaves nothing out takes
// and another leaps over do not count, so that both are halved as often, as far as they can be.
bool has_no_half(const Simulation& run) {
  const long leapt_over = run.leapt_strain > 0.0 ? 0 : run.uniform_steps;
  return 2.0 * static_cast<double>(run.steps - leapt_over) > most_steps(run) ||
         2.0 * run.steps > most_steps_of_a_run;
}

constexpr StepError never_compared{.failure_strain = std::numeric_limits<double>::quiet_NaN(),
                                   .strength = std::numeric_limits<double>::quiet_NaN(),
                                   .over_a_wave = std::numeric_limits<double>::quiet_NaN()};

std::string ground_of(const Simulation& run, double accuracy, const std::string& finer_failed) {
  std::string halved;
  if (!std::isnan(run.step_error->failure_strain))
    halved = fmt::format(
        ": the last halvings to it, two at most, changed the failure strain by up to {:.2g} % and "
        "the strength by up to {:.2g} %",
        100.0 * run.step_error->failure_strain, 100.0 * run.step_error->strength);
  if (run.step_error->largest() > accuracy)
    halved += fmt::format(", more than the {:g} % asked for", 100.0 * accuracy);
  return fmt::format("; the step of {} is chosen{}{}", step_in_words(run.step), halved,
                     finer_failed);
}

// Relative changes; none are known of a run that did not end, as half a run tells nothing.
StepError error_of(const Simulation& finer, const Simulation& coarser) {
  if (!has_ended(finer)) return never_compared;
  const auto change = [](double now, double before) { return std::abs(now - before) / now; };
  return {change(finer.failure_strain, coarser.failure_strain),
          change(finer.strength, coarser.strength),
          change(finer.strength_over_a_wave, coarser.strength_over_a_wave)};
}

// Of two halvings in turn, where there were two: one alone may change little by chance.
StepError larger_of(const StepError& change, const StepError& before) {
  if (std::isnan(change.failure_strain)) return change;
  return {std::fmax(change.failure_strain, before.failure_strain),
          std::fmax(change.strength, before.strength),
          std::fmax(change.over_a_wave, before.over_a_wave)};
}

// A watcher sees the answer last.
void show_again(const Scene& scene, Stepping stepping, const Observer& observer,
                const StopAsked& stop_asked, Simulation& run) {
  if (!observer) return;
  const StepError error = *run.step_error;
  stepping.step = run.step;
  run = run_in_steps(scene, stepping, observer, stop_asked);
  run.step_error = has_ended(run) ? error : never_compared;
}

}  // namespace

bool knows_first_break(const Scene& scene) {
  return scene.loading.start == Start::uniform && (!scene.solver.step || scene.solver.leap);
}

bool may_leap(const Scene& scene) {
  return scene.solver.leave_out && knows_first_break(scene);
}

double first_step(const Scene& scene) {
  const double wave = wave_speed(scene.material);
  const double transit = knows_first_break(scene) ? 0.25 * scene.assembly.fibre_height / wave
                                                  : 0.5 * scene.assembly.fibre_length / wave;
  const double strain =
      std::min(head_tail_strength(scene) / scene.material.young, scene.loading.max_strain);
  // Halved as a whole: thresholds that are read back have another median than their mean was, and
  // the same steps.
  const double most = 0.02 * strain / scene.loading.strain_rate;
  return transit > most
             ? std::ldexp(transit, -static_cast<int>(std::ceil(std::log2(transit / most))))
             : transit;
}

std::string doubt_about_steps(const Scene& scene) {
  if (scene.solver.step || !knows_first_break(scene) ||
      choose_regime(scene).regime == Regime::quasi_static)
    return "";
  const double of_one = first_step(scene) * scene.loading.strain_rate;
  const double strain =
      std::min(scene.loading.max_strain, head_tail_strength(scene) / scene.material.young);
  if (!scene.solver.leave_out)
    return fmt::format(
        "leave_out = false takes every step to the first break: in the first run some {:.2g}, in "
        "each that halves the step twice as many, and up to ten do",
        strain / of_one);
  const double followed = most_steps_of_a_run * of_one;
  if (followed >= strain) return "";
  return fmt::format(
      "a run in time ends after ten million steps, at this rate a strain of at most {:.2g} % "
      "beyond the first break: where the specimen bears longer it takes long and is not trusted "
      "(regime = \"quasi-static\" takes no steps)",
      100.0 * followed);
}

Simulation run_in_chosen_steps(const Scene& scene, const Observer& observer,
                               const StopAsked& stop_asked) {
  Stepping stepping{.step = first_step(scene), .leap = knows_first_break(scene)};
  Simulation run;
  run.failure_strain = run.strength = never_compared.strength;
  std::string finer_failed;
  StepError change{};                  // by the last halving
  int agreed = 0, without_answer = 0;  // in a row
  for (int halving = 0; halving <= most_halvings; ++halving, stepping.step *= 0.5) {
    Simulation finer = run_in_steps(scene, stepping, observer, stop_asked);
    const bool first = !has_ended(run);
    // Long steps may have no answer where friction is strong; short ones do.
    if (first && finer.status == SimulationStatus::not_converged && halving < most_halvings)
      continue;
    if (!first && !has_ended(finer) && finer.status != SimulationStatus::cancelled) {
      // Where friction is strong a length between two that have answers may have none.
      if (++without_answer == 1 && halving < most_halvings) continue;
      finer_failed =
          fmt::format("; runs of shorter ones have no answer: {}", explain(finer.status));
      show_again(scene, stepping, observer, stop_asked, run);
      break;
    }
    // Beside a run of twice the step or, where that has no answer, four times.
    const StepError before = std::exchange(change, error_of(finer, run));
    run = std::move(finer);
    without_answer = 0;
    run.step_error = larger_of(change, before);
    // Two halvings in turn: waves may let two steps agree by chance.
    agreed = change.largest() < 0.5 * scene.solver.step_accuracy ? agreed + 1 : 0;
    if (!has_ended(run) || agreed == 2) break;
    if (!first && has_no_half(run)) break;
  }
  run.regime_ground = ground_of(run, scene.solver.step_accuracy, finer_failed);
  return run;
}

}  // namespace havers::sim
