// Follows events to the end of a run, and does a run again with more care where its answer is not
// good enough.
#include "sim/quasi_static/breaking_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/outcome.hpp"
#include "sim/quasi_static/breaking_run.hpp"

namespace havers::sim {

double end_fraction_used(const Scene& scene) {
  const JointOptions& joints = scene.joints;
  // The walls that the rule was found with (section 6): others are followed down to the scene's own
  // end fraction.
  const bool as_drawn = joints.thresholds.empty() && !joints.head_tail_shear &&
                        !joints.flank_tension && scene.material.layer_contrast == 1.0;
  const bool brittle = as_drawn && joints.distribution == Distribution::uniform &&
                       (joints.scatter <= 1.0 || scene.assembly.orientation == 0.0) &&
                       joints.missing == 0.0 && ratio(scene.assembly, joints) >= 0.2;
  if (!scene.solver.leave_out || !brittle) return scene.loading.end_fraction;
  const double fibres = 1.0 * scene.assembly.layers * scene.assembly.fibres;
  // From which none was seen to become stronger.
  const double d = joints.scatter, wide = std::max(0.0, d - 1.0);
  const double fall = 0.005 + 25.0 * (1.0 + 2.0 * wide) / fibres + 0.05 * d * d + 0.1 * wide;
  return std::max(scene.loading.end_fraction, 1.0 - fall);
}

namespace {

// Rounding error of the strength above which a run is done again with care.
constexpr double accurate = 1e-9;

// Breaks at a given strain release energy. What they add up to the strength belongs to it.
double energy_gain(const std::vector<CurvePoint>& curve) {
  std::size_t strongest = 0;
  // Rows before and after a break have the same strain; what loading stores between breaks is no
  // gain.
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

// From break to break, until the run ends.
SimulationStatus follow_events(const Scene& scene, BreakingRun& run, const Observer& observer,
                               const StopAsked& stop_asked, Simulation& simulation) {
  const double end_fraction = simulation.end_fraction_used;
  simulation.curve.push_back(run.point());
  for (;;) {
    const BreakingRun::Event event = run.next_event();
    run.stretch(std::min(event.strain, scene.loading.max_strain));
    simulation.curve.push_back(run.point());
    const double stress = simulation.curve.back().stress_right;
    if (!std::isfinite(stress)) return SimulationStatus::not_finite;
    // The event to come belongs to the strongest row: its strain is checked at the end like its
    // force.
    take_note_of_strength(simulation);
    if (stress >= simulation.strength) {
      simulation.without_contact_to_strength = run.without_contact();
      run.take_note_of_strength(event);
    }
    if (event.strain > scene.loading.max_strain) return SimulationStatus::strain_limit;

    if (!run.break_joints(event.joints))
      return stop_is_asked(stop_asked) ? SimulationStatus::cancelled
                                       : SimulationStatus::not_converged;
    simulation.curve.push_back(run.point());
    take_note_of_strength(simulation);
    ++simulation.steps;
    if (observer)
      observer({simulation.curve.back(), simulation.curve.size() - 1,
                [&] { return run.outcomes(); }, [&] { return run.displacements(); }});
    if (stop_is_asked(stop_asked)) return SimulationStatus::cancelled;
    if (has_failed(simulation, end_fraction)) return SimulationStatus::broken;
  }
}

// Section 7.
std::vector<LeftOut> left_out_in_the_limit(const Scene& scene, const IntactStructure& intact,
                                           const Simulation& simulation) {
  std::vector<LeftOut> list{
      {"contact of pieces that no bonded joint connects to an end",
       "they carry nothing, and without inertia their position is not determined"}};
  if (simulation.events_without_contact > 0)
    list.push_back({fmt::format("contact of broken joints in {} of {} events",
                                simulation.events_without_contact, simulation.steps),
                    "no set of sticking, sliding and open joints was found that obeys friction"});
  if (scene.solver.leave_out)
    list.push_back(
        {"digits beyond single precision in the forces of joints that are not next to break",
         "those that may be, by ten times what is seen to be missed, are computed to "
         "all digits"});
  if (intact.stress_is_known())
    list.push_back({"rounding in the joint forces of the intact specimen",
                    "its stress is uniform, and a solve finds that to 1e-6 or better"});
  if (simulation.end_fraction_used > scene.loading.end_fraction)
    list.push_back(
        {fmt::format("the avalanche below {:.3g} of the strength", simulation.end_fraction_used),
         "next to none with such thresholds was seen to become stronger thereafter"});
  return list;
}

Simulation break_event_by_event(const Scene& scene,
                                const std::shared_ptr<const IntactStructure>& intact, Care care,
                                const Observer& observer, const StopAsked& stop_asked) {
  Simulation simulation;
  simulation.regime = Regime::quasi_static;
  simulation.tolerance = scene.solver.tolerance;
  simulation.end_fraction_used = end_fraction_used(scene);
  simulation.dropped = intact->assembly().dropped;
  // Joints would have forces that no load asks for (S7).
  if (!intact->structure().ok()) {
    simulation.status = SimulationStatus::not_determined;
    return simulation;
  }
  BreakingRun run(scene, intact, care, stop_asked);
  if (!run.take_missing()) {
    if (stop_is_asked(stop_asked)) simulation.status = SimulationStatus::cancelled;
    return simulation;
  }
  simulation.status = follow_events(scene, run, observer, stop_asked, simulation);
  run.finish(simulation);
  simulation.energy_gain = energy_gain(simulation.curve);
  simulation.left_out = left_out_in_the_limit(scene, *intact, simulation);
  summarise(simulation);
  return simulation;
}

bool is_enough(const Simulation& run) {
  return run.trusted() && run.rounding_error <= accurate && run.worst_residual <= run.tolerance;
}

// A run that ended is better than one that did not, and of two that did not the longer one; then
// one that is trusted; then the one that misses least.
bool is_no_worse(const Simulation& a, const Simulation& b) {
  if (has_ended(a) != has_ended(b)) return has_ended(a);
  if (!has_ended(a)) return a.curve.size() >= b.curve.size();  // it came as far
  if (a.trusted() != b.trusted()) return a.trusted();
  const auto missed = [](const Simulation& run) {
    return worse(run.worst_residual, run.rounding_error);
  };
  return !(missed(a) > missed(b));
}

}  // namespace

bool is_severed(const Scene& scene, const StopAsked& stop_asked) {
  if (!some_are_missing(scene.joints)) return false;
  const std::shared_ptr<const IntactStructure> intact = intact_structure(scene);
  if (!intact->structure().ok()) return false;
  // What little effort does not settle may hang on next to nothing, or on nothing.
  for (const Care care : {Care::little, Care::digits, Care::all_effort}) {
    BreakingRun run(scene, intact, care, stop_asked);
    if (run.take_missing()) return !run.bears();
  }
  return false;
}

Simulation simulate_quasi_static(const Scene& scene, const Observer& observer,
                                 const StopAsked& stop_asked) {
  const std::shared_ptr<const IntactStructure> intact = intact_structure(scene);
  const auto run = [&](Care care) {
    return break_event_by_event(scene, intact, care, observer, stop_asked);
  };
  Simulation best = run(Care::little);
  const bool all_solved = has_ended(best) && best.events_without_contact == 0;
  Care of_best = Care::little, last = Care::little;
  // Where a piece hangs on next to nothing either may miss an answer that the other finds.
  for (const Care care : {Care::digits, Care::all_effort}) {
    if (best.status == SimulationStatus::cancelled || is_enough(best) ||
        (care == Care::all_effort && all_solved))
      break;
    Simulation other = run(care);
    last = care;
    if (other.status != SimulationStatus::cancelled && !is_no_worse(other, best)) continue;
    best = std::move(other);
    of_best = care;
  }
  // A watcher sees the answer last.
  if (observer && of_best != last) return run(of_best);
  return best;
}

}  // namespace havers::sim
