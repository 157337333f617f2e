// From rows of a DynamicRun to a simulation: when a run ends, and what waves there are in its
// strength and modulus.
#include "sim/dynamics/time_stepping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/dynamics/dynamic_run.hpp"
#include "sim/dynamics/step_control.hpp"
#include "sim/outcome.hpp"
#include "sim/simulate.hpp"

namespace havers::sim {
namespace {

// Section 7.
std::vector<LeftOut> left_out_in_time(const Scene& scene, const Simulation& simulation) {
  std::vector<LeftOut> list;
  if (simulation.leapt_strain > 0.0)
    list.push_back({fmt::format("time steps up to a strain of {:.4g}", simulation.leapt_strain),
                    "until the first break the motion is uniform and known"});
  if (scene.solver.leave_out && scene.solver.contact != ContactMethod::gauss_seidel)
    list.push_back(
        {"contact of joints that opened", "checked each step, and taken up again when they close"});
  return list;
}

// From step to step, until the run ends.
SimulationStatus follow_in_time(const Scene& scene, DynamicRun& run, const Stepping& stepping,
                                const Observer& observer, Simulation& simulation) {
  constexpr double but_for_rounding = 1.0 - 1e-9;
  // The strain of the row that reaches the limit may miss it by rounding.
  const double end = but_for_rounding * scene.loading.max_strain;
  // From rest the left side bears nothing until a wave has come across, however strong the specimen
  // is: until then the sides do not say whether it is broken.
  const double told = scene.loading.start == Start::rest ? time_across(scene) : 0.0;
  simulation.curve.push_back(run.point());
  while (simulation.curve.back().strain < end) {
    const bool solved = run.advance();
    if (!run.finite()) return SimulationStatus::not_finite;
    if (!solved && run.is_stopped()) return SimulationStatus::cancelled;
    if (!solved)
      return run.determined() ? SimulationStatus::not_converged : SimulationStatus::not_determined;
    simulation.curve.push_back(run.point());
    take_note_of_strength(simulation);
    if (observer)
      observer({simulation.curve.back(), simulation.curve.size() - 1,
                [&run] { return run.outcomes(); }, [&run] { return run.displacements(); }});
    if (run.is_stopped()) return SimulationStatus::cancelled;
    const bool tells = simulation.curve.back().time >= told;
    if (tells && has_failed(simulation, simulation.end_fraction_used))
      return SimulationStatus::broken;
    if (run.steps() == stepping.most) return SimulationStatus::step_limit;
    // Steps may be so short that rounding looks like acceleration in the first of them.
    const bool may_leap = stepping.leap && simulation.uniform_steps == 0;
    if (may_leap && run.steps() > 1 && std::has_single_bit(static_cast<unsigned>(run.steps()))) {
      const double known = run.leap();
      simulation.uniform_steps = run.whole_steps(known);
      if (scene.solver.leave_out) simulation.leapt_strain = scene.loading.strain_rate * known;
    }
  }
  return SimulationStatus::strain_limit;
}

// Uniform motion is one of equilibrium where the stress does not change along the load, and a
// specimen that could leap had it; missing joints and unlike layers across the load set waves free.
bool starts_with_waves(const Scene& scene, const Simulation& simulation) {
  if (scene.loading.start == Start::rest) return true;
  const bool unlike = scene.material.layer_contrast != 1.0 && scene.assembly.orientation != 0.0;
  return simulation.uniform_steps == 0 && (simulation.missing_joints() > 0 || unlike);
}

// After the last break what is left only swings; before a period has passed its mean is that of
// something broken.
double borne_until(const Simulation& simulation) {
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const JointOutcome& joint : simulation.joints)
    if (joint.broke()) last = std::fmax(last, joint.broken_at_strain);
  return std::isnan(last) ? simulation.curve.back().strain : last;
}

// What waves are in the strength and the modulus.
void tell_waves(const Scene& scene, Simulation& simulation) {
  const double of_a_crossing = scene.loading.strain_rate * time_across(scene);
  double modulus = simulation.modulus;
  if (starts_with_waves(scene, simulation)) {
    simulation.crossings = modulus_stretch * strain_of_modulus(simulation) / of_a_crossing;
    if (simulation.missing_joints() > 0)  // waves are as slow as the specimen is soft
      simulation.crossings *= std::sqrt(std::clamp(modulus / scene.material.young, 0.0, 1.0));
    // A modulus measured while waves cross may be anything: it is kept between 0 and the slope of a
    // straight line to the strength.
    modulus = std::clamp(modulus, 0.0, simulation.strength / simulation.failure_strain);
  }
  // The middle of a mean over one period lies half a period before its end; until then the stress
  // rises on, by the modulus times the strain of a crossing.
  if (borne_until(simulation) >= 2.0 * of_a_crossing)
    simulation.strength_over_a_wave = largest_mean_stress(simulation.curve, of_a_crossing);
  const double without_ringing = simulation.strength_over_a_wave + modulus * of_a_crossing;
  simulation.ringing = std::fmax(0.0, simulation.strength / without_ringing - 1.0);
}

}  // namespace

Simulation simulate_dynamic(const Scene& scene, const Observer& observer,
                            const StopAsked& stop_asked) {
  if (!scene.solver.step) return run_in_chosen_steps(scene, observer, stop_asked);
  Simulation run =
      run_in_steps(scene, {*scene.solver.step, knows_first_break(scene)}, observer, stop_asked);
  run.regime_ground = fmt::format(
      "; the step of {} is given, and its error is not known: a run without step_s chooses its own "
      "and says it",
      step_in_words(run.step));
  return run;
}

Simulation run_in_steps(const Scene& scene, const Stepping& stepping, const Observer& observer,
                        const StopAsked& stop_asked) {
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  Simulation simulation;
  simulation.regime = Regime::dynamic;
  simulation.step = stepping.step;
  simulation.step_error.reset();
  simulation.end_fraction_used = scene.loading.end_fraction;
  DynamicRun run(scene, assembly, simulation.step, stop_asked);
  simulation.status = follow_in_time(scene, run, stepping, observer, simulation);
  run.finish(simulation);
  simulation.dropped = assembly.dropped;
  simulation.left_out = left_out_in_time(scene, simulation);
  summarise(simulation);
  tell_waves(scene, simulation);
  return simulation;
}

}  // namespace havers::sim
