// The choice between the limit and time (M12), and the frame of a run in either: what was asked
// for, how it ended where nothing is borne, what was left out.
#include "sim/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "sim/dynamics/time_stepping.hpp"
#include "sim/joint/cohesive_cone.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/outcome.hpp"
#include "sim/quasi_static/breaking_sequence.hpp"
#include "sim/simulation.hpp"

namespace havers::sim {

double time_across(const Scene& scene) {
  const double slowest = std::sqrt(scene.material.layer_contrast) * wave_speed(scene.material);
  return scene.assembly.width() / slowest;
}

RegimeChoice choose_regime(const Scene& scene) {
  RegimeChoice choice;
  choice.inertia_number = scene.loading.strain_rate * time_across(scene) * scene.material.young /
                          head_tail_strength(scene);
  // The inertia number is told all the same.
  if (scene.solver.regime != Regime::automatic) {
    choice.regime = scene.solver.regime;
    choice.ground = fmt::format(
        "asked for by the scene; inertia number {:.2g}{}", choice.inertia_number,
        choice.regime == Regime::quasi_static && choice.inertia_number >= quasi_static_below
            ? fmt::format(", while auto runs in time from {:g} on", quasi_static_below)
            : "");
    return choice;
  }
  // Viscosity, a shock and a given time step have no meaning without time.
  const bool needs_time = scene.material.viscosity > 0.0 || scene.loading.start == Start::rest ||
                          scene.solver.step || scene.solver.contact == ContactMethod::gauss_seidel;
  const bool slow = choice.inertia_number < quasi_static_below;
  choice.regime = slow && !needs_time ? Regime::quasi_static : Regime::dynamic;
  choice.ground =
      fmt::format("inertia number {:.2g} is {} {:g}{}", choice.inertia_number,
                  slow ? "below" : "not below", quasi_static_below,
                  !slow        ? ""
                  : needs_time ? ", but the scene asks for something that needs time"
                               : "; waves that a break releases are taken to fade at once");
  return choice;
}

namespace {

// Whether (M5) gives an intact joint a wider cone than its thresholds do.
bool is_widened(const JointOutcome& joint) {
  constexpr double but_for_rounding = 1.0 - 1e-9;
  return joint.threshold.tangent < but_for_rounding * least_friction * joint.threshold.normal;
}

// Section 7: what the scene and its regime do without; a run adds its own omissions.
std::vector<LeftOut> left_out_by_choice(const Scene& scene, const Simulation& simulation) {
  std::vector<LeftOut> list;
  if (scene.material.viscosity == 0.0) list.push_back({"viscosity", "viscosity_s is 0"});
  if (scene.joints.friction < least_friction)
    list.push_back({"friction below 0.001",
                    "it counts as 0.001: without any, rounding decides which way a joint slides"});
  if (std::ranges::any_of(simulation.joints, is_widened))
    list.push_back(
        {"shear thresholds below 0.001 of those in tension",
         "they count as 0.001 of these: with none, rounding decides which way a joint slides"});
  if (scene.loading.lateral == Lateral::free)
    list.push_back({"periodic ties", "the sides are free"});
  if (simulation.dropped > 0)
    list.push_back({fmt::format("{} half fibre{} at the specimen's sides", simulation.dropped,
                                simulation.dropped == 1 ? "" : "s"),
                    "less than 1e-6 of one is inside, and its neighbours fill the place"});
  if (simulation.regime == Regime::quasi_static) {
    if (scene.material.viscosity > 0.0)
      list.push_back({"viscosity", "the quasi-static limit has no rates"});
    if (scene.loading.start == Start::rest)
      list.push_back({"the start from rest", "the quasi-static limit has no motion"});
    if (scene.solver.step || scene.solver.contact == ContactMethod::gauss_seidel)
      list.push_back({"step_s and contact", "the quasi-static limit has no steps"});
    list.push_back({"inertia and time steps", simulation.regime_ground});
  }
  const bool factorised = simulation.regime == Regime::quasi_static ||
                          scene.solver.contact != ContactMethod::gauss_seidel;
  if (factorised)
    list.push_back(
        {"the friction problem of joints inside their cone",
         "they hold, which is a linear condition; contact = \"gauss-seidel\" asks each"});
  if (scene.solver.leave_out)
    list.push_back({"one operator for each body", "equal bodies share theirs"});
  if (scene.solver.leave_out && factorised)
    list.push_back({"parts of the intact specimen's factor that repeat others",
                    "congruent parts have the same values bit for bit and share them"});
  return list;
}

}  // namespace

Simulation simulate(const Scene& scene, const Observer& observer, const StopAsked& stop_asked) {
  assert(scene.problems().empty());
  RegimeChoice choice = choose_regime(scene);
  // In time its pieces would swing on their own for as long as they are watched.
  if (choice.regime == Regime::dynamic && is_severed(scene, stop_asked)) {
    choice.regime = Regime::quasi_static;
    choice.ground +=
        ", but missing joints leave nothing that bears a load, and the limit says so at once";
  }
  // A run in time adds to the ground which step it took.
  Simulation simulation = choice.regime == Regime::quasi_static
                              ? simulate_quasi_static(scene, observer, stop_asked)
                              : simulate_dynamic(scene, observer, stop_asked);
  simulation.regime_ground = choice.ground + simulation.regime_ground;
  simulation.tolerance = scene.solver.tolerance;
  simulation.contact = scene.solver.contact;
  simulation.step_accuracy = scene.solver.step_accuracy;
  // A run that ended without having borne anything was in pieces from the start.
  if (simulation.strength == 0.0 && has_ended(simulation) && some_are_missing(scene.joints))
    simulation.status = SimulationStatus::severed;
  if (!has_ended(simulation) && simulation.curve.size() < 2)  // nothing has an answer
    simulation.strength = simulation.failure_strain = simulation.modulus =
        std::numeric_limits<double>::quiet_NaN();
  // What the choice leaves out comes before what the run did.
  const std::vector<LeftOut> list = left_out_by_choice(scene, simulation);
  simulation.left_out.insert(simulation.left_out.begin(), list.begin(), list.end());
  return simulation;
}

}  // namespace havers::sim
