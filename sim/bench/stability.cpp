// Judges runs by closed forms of the bonded specimen (M1). A run that says itself that it is not to
// be trusted has failed; one that is trusted and misses the closed form is wrong.
#include "sim/bench/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/bench/watched_run.hpp"
#include "sim/joint/thresholds.hpp"

namespace havers::sim {
namespace {

constexpr double largest_error = 1e-8;        // relative, of what closed forms say
constexpr double largest_penetration = 1e-9;  // of the fibre length

// Largest deviation of the loading curve from σ = E(ε + τε̇), relative to the largest stress until
// the first break.
double stress_error(const Scene& scene, const Simulation& run) {
  const double modulus = bonded_modulus(scene);
  const double viscous =
      run.regime == Regime::dynamic ? scene.material.viscosity * scene.loading.strain_rate : 0.0;
  double error = 0.0, largest = 0.0;
  for (const CurvePoint& point : run.curve) {
    if (point.broken_joints > 0) break;
    // Nothing is computed yet in the row a run starts with.
    if (point.strain == 0.0) continue;
    const double expected = modulus * (point.strain + viscous);
    largest = std::max(largest, expected);
    error = std::max(
        {error, std::abs(point.stress_right - expected), std::abs(point.stress_left - expected)});
  }
  return largest > 0.0 ? error / largest : 0.0;
}

// How far the first break is from where it must be. A run in steps finds it at the end of the step.
double first_break_error(const Scene& scene, const Simulation& run) {
  double expected = first_break_by_uniform_stress(scene);
  double lag = 0.0;
  if (run.regime == Regime::dynamic) {
    // Viscous stress is there from the start, and breaks joints at less strain.
    expected = std::max(0.0, expected - scene.material.viscosity * scene.loading.strain_rate);
    lag = scene.loading.strain_rate * run.step;
  }
  const bool must_break = expected + lag < scene.loading.max_strain;
  if (run.broken_joints == 0) return must_break ? 1.0 : 0.0;
  const double late = run.first_break_strain - expected;
  return std::max({0.0, -late, late - lag}) / run.first_break_strain;
}

// A row of fibres in the quasi-static limit is a chain: as strong as its weakest joint.
double strength_error(const Scene& scene, const Simulation& run) {
  const AssemblyOptions& row = scene.assembly;
  if (run.regime != Regime::quasi_static || row.layers != 1 || row.orientation != 0.0 ||
      run.broken_joints == 0)
    return 0.0;
  double weakest = std::numeric_limits<double>::infinity();
  for (const Threshold& threshold :
       draw_thresholds(scene, build_assembly(row, scene.loading.lateral)))
    weakest = std::min(weakest, threshold.normal);
  return std::abs(run.strength * row.fibre_height / weakest - 1.0);
}

bool all_finite(const Simulation& run) {
  const auto finite = [](const CurvePoint& point) {
    return std::isfinite(point.stress_right) && std::isfinite(point.stress_left) &&
           std::isfinite(point.kinetic) && std::isfinite(point.elastic) &&
           std::isfinite(point.dissipated);
  };
  return std::ranges::all_of(run.curve, finite) && run.displacements.allFinite() &&
         std::isfinite(run.worst_residual) && std::isfinite(run.energy_defect) &&
         std::isfinite(run.worst_penetration);
}

// Empty where nothing is wrong.
std::string what_is_wrong(const StabilityResult& result, bool finite) {
  if (!finite) return "a number that is not finite left the run";
  if (result.error > largest_error)
    return fmt::format("misses the known answer by {:.1e}", result.error);
  if (result.penetration > largest_penetration)
    return fmt::format("fibres overlap by {:.1e} of their length", result.penetration);
  return {};
}

}  // namespace

std::string to_string(StabilityOutcome outcome) {
  constexpr std::array words{"solved", "refused", "failed", "wrong"};
  return words.at(static_cast<std::size_t>(outcome));
}

bool StabilityBench::good() const {
  return complete && std::ranges::all_of(scenes, &StabilityResult::as_it_must);
}

std::string summary(const StabilityBench& bench) {
  const auto good = std::ranges::count(bench.scenes, true, &StabilityResult::as_it_must);
  return fmt::format("{}{} of {} scenes solved or refused as they must be.",
                     bench.complete ? "" : "Stopped before all scenes were run: ", good,
                     bench.scenes.size());
}

StabilityResult run_stability_scene(const StabilityScene& scene, const StopAsked& stop_asked) {
  StabilityResult result{.name = scene.name};
  const std::vector<Scene::Problem> problems = scene.scene.problems();
  if (!problems.empty()) {
    result.outcome = StabilityOutcome::refused;
    result.reason = problems.front().key + " " + problems.front().what;
    result.as_it_must = scene.refused;
    return result;
  }
  const WatchedRun watched = watch(scene.scene, {}, stop_asked);
  const Simulation& run = watched.simulation;
  const bool finite = all_finite(run);
  result.wall = watched.wall;
  result.residual = run.worst_residual;
  result.energy_defect = run.energy_defect;
  result.penetration = run.worst_penetration / scene.scene.assembly.fibre_length;
  result.error = std::max({stress_error(scene.scene, run), first_break_error(scene.scene, run),
                           strength_error(scene.scene, run)});
  result.reason = what_is_wrong(result, finite);
  if (!run.trusted()) {
    result.outcome = finite ? StabilityOutcome::failed : StabilityOutcome::wrong;
    result.reason = watched.out_of_time ? "took longer than a minute" : run.why_not_trusted();
  } else {
    result.outcome = result.reason.empty() ? StabilityOutcome::solved : StabilityOutcome::wrong;
  }
  result.as_it_must = result.outcome == StabilityOutcome::solved && !scene.refused;
  return result;
}

}  // namespace havers::sim
