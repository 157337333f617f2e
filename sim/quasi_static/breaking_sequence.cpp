#include "sim/quasi_static/breaking_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/outcome.hpp"
#include "sim/quasi_static/breaking_run.hpp"

namespace havers::sim {

double end_fraction_used(const Scene& scene) {
  const JointOptions& joints = scene.joints;
  const bool brittle = joints.thresholds.empty() && joints.distribution == Distribution::uniform &&
                       joints.scatter <= 1.0 && joints.missing == 0.0 &&
                       scene.assembly.layers * scene.assembly.fibres >= 40;
  if (!scene.solver.leave_out || !brittle) return scene.loading.end_fraction;
  const double drop = std::max({0.1, 0.3 * joints.scatter, 2.5 / scene.assembly.layers});
  return std::max(scene.loading.end_fraction, 1.0 - drop);
}

namespace {

// Residual above which a run is done again with care.
constexpr double accurate = 1e-9;

// Breaks at a given strain release energy. What they add up to the strength belongs to it.
double energy_gain(const std::vector<CurvePoint>& curve) {
  std::size_t strongest = 0;
  double gain = 0.0, gain_to_strength = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i].strain == curve[i - 1].strain)
      gain = std::max(gain, curve[i].elastic - curve[i - 1].elastic);
    if (curve[i].stress_right <= curve[strongest].stress_right) continue;
    strongest = i;
    gain_to_strength = gain;
  }
  return gain_to_strength > 0.0 ? gain_to_strength / curve[strongest].elastic : 0.0;
}

bool goes_on(const Observer& observer, const BreakingRun& run, const Simulation& simulation) {
  const CurvePoint& now = simulation.curve.back();
  return !observer ||
         observer({now, simulation.curve.size() - 1, [&] { return run.outcomes(now.strain); },
                   [&] { return run.displacements(now.strain); }});
}

Simulation break_event_by_event(const Scene& scene,
                                const std::shared_ptr<const IntactStructure>& intact, bool careful,
                                const Observer& observer) {
  Simulation simulation;
  simulation.regime = Regime::quasi_static;
  simulation.dropped = intact->assembly().dropped;
  if (!intact->structure().ok()) return simulation;
  BreakingRun run(scene, intact, careful);
  if (run.take_missing() && !run.settle()) return simulation;
  simulation.curve.push_back(run.point(0.0));
  double strain = 0.0, largest_energy = 0.0;
  const double end_fraction = end_fraction_used(scene);

  for (;;) {
    const double event = run.next_event();
    if (event > scene.loading.max_strain) {
      run.stretch(strain, scene.loading.max_strain);
      strain = scene.loading.max_strain;
      simulation.curve.push_back(run.point(strain));
      simulation.status = SimulationStatus::strain_limit;
      break;
    }
    if (event > strain) run.stretch(strain, event);
    strain = std::max(strain, event);
    const CurvePoint before = run.point(strain);
    simulation.curve.push_back(before);
    has_failed(simulation, end_fraction);  // takes note of the strength
    if (!std::isfinite(before.stress_right)) {
      simulation.status = SimulationStatus::not_finite;
      break;
    }
    if (before.stress_right >= simulation.strength)
      simulation.without_contact_to_strength = run.without_contact;
    largest_energy = std::max(largest_energy, before.elastic);

    run.break_joints(event, strain);
    const bool solved = run.settle();
    run.dissipated += before.elastic - run.point(strain).elastic;
    simulation.curve.push_back(run.point(strain));
    ++simulation.steps;
    if (!solved) {
      simulation.status = SimulationStatus::not_converged;
      break;
    }
    if (!goes_on(observer, run, simulation)) {
      simulation.status = SimulationStatus::cancelled;
      break;
    }
    if (has_failed(simulation, end_fraction)) {
      simulation.status = SimulationStatus::broken;
      break;
    }
  }
  largest_energy = std::max(largest_energy, simulation.curve.back().elastic);
  run.finish(strain, largest_energy, simulation);
  simulation.energy_gain = energy_gain(simulation.curve);
  simulation.events_without_contact = run.without_contact;
  return simulation;
}

}  // namespace

Simulation simulate_quasi_static(const Scene& scene, const Observer& observer) {
  const std::shared_ptr<const IntactStructure> intact = intact_structure(scene);
  Simulation quick = break_event_by_event(scene, intact, false, observer);
  if (quick.worst_residual <= accurate || quick.status == SimulationStatus::cancelled) return quick;
  return break_event_by_event(scene, intact, true, observer);
}

}  // namespace havers::sim
