#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

std::string sentence_of(const sim::Simulation& s) {
  if (!s.trusted()) return fmt::format("Not to be trusted: {}.", typeset(s.why_not_trusted()));
  if (s.status == sim::SimulationStatus::severed)
    return "Missing joints sever the specimen: it bears nothing. To be trusted.";
  const std::string at = fmt::format("{} at {} strain", quantity(s.strength / in::MPa, "MPa"),
                                     quantity(s.failure_strain / in::percent, "%", 3));
  return s.status == sim::SimulationStatus::broken
             ? fmt::format("The specimen broke: strength {}. To be trusted.", at)
             : fmt::format(
                   "The specimen did not break: its strength is at least {}. To be trusted as a "
                   "lower bound.",
                   at);
}

std::string step_error_of(const sim::Simulation& s) {
  if (s.regime == sim::Regime::quasi_static) return "";
  if (!s.step_error || std::isnan(s.step_error->failure_strain))
    return " The error of the time step is not known.";
  return fmt::format(
      " The last halving of the time step changed the failure strain by {} and the strength by {}.",
      quantity(s.step_error->failure_strain / in::percent, "%", 2),
      quantity(s.step_error->strength / in::percent, "%", 2));
}

// A time never stands without the error it was bought with.
std::string cost_of(const SimulationReport& report) {
  const sim::Simulation& s = report.simulation;
  return fmt::format(
      "Status {}: {}. {} wall time, for a relative energy defect of {}, a residual of at most {} "
      "and a penetration of at most {}.{}",
      to_string(s.status), explain(s.status), duration(report.wall_seconds),
      number(s.energy_defect, 3), number(s.worst_residual, 3),
      quantity(s.worst_penetration / in::um, "µm", 3), step_error_of(s));
}

Facts key_numbers(const SimulationReport& report) {
  const sim::Simulation& s = report.simulation;
  const bool dynamic = s.regime == sim::Regime::dynamic;
  return {
      {"Strength", quantity(s.strength / in::MPa, "MPa")},
      {"Failure strain", quantity(s.failure_strain / in::percent, "%")},
      {"Modulus", quantity(s.modulus / in::GPa, "GPa")},
      {"Strain of the first break", quantity(s.first_break_strain / in::percent, "%")},
      {"Broken joints", fmt::format("{} of {}", s.broken_joints, report.assembly.joints.size())},
      {"Regime",
       fmt::format("{}: {}", dynamic ? "dynamic" : "quasi-static", typeset(s.regime_ground))},
      {dynamic ? "Time steps" : "Events",
       dynamic ? fmt::format("{} of {}", s.steps, prefixed(s.step, "s")) : std::to_string(s.steps)},
      {"Contact iterations", std::to_string(s.iterations)}};
}

std::string to_string(sim::Distribution distribution) {
  switch (distribution) {
    case sim::Distribution::uniform:
      return "uniform";
    case sim::Distribution::weibull:
      return "Weibull";
    case sim::Distribution::lognormal:
      return "log-normal";
  }
  return "";
}

// What a scene seldom sets, where it does.
std::string unusual(const sim::Material& material) {
  std::string words;
  if (material.viscosity > 0.0) words += ", τ = " + prefixed(material.viscosity, "s");
  if (material.layer_contrast < 1.0)
    words += fmt::format(", every second layer {} E", setting(material.layer_contrast));
  return words;
}

std::string unusual(const sim::JointOptions& joints) {
  std::string words;
  const auto apart = [&](const char* what, const std::optional<double>& stress) {
    if (stress) words += fmt::format(", {} {}", what, setting(*stress / in::MPa, "MPa", 4));
  };
  apart("head-tail shear", joints.head_tail_shear);
  apart("flank tension", joints.flank_tension);
  return words;
}

Facts scene_facts(const sim::Scene& scene) {
  const auto& [assembly, material, joints, loading, solver] = scene;
  return {
      {"Assembly",
       fmt::format("{} layers of {} fibres, {} by {}, at {}, {} triangles a fibre", assembly.layers,
                   assembly.fibres, setting(assembly.fibre_length / in::um, "µm"),
                   setting(assembly.fibre_height / in::um, "µm"), degrees(assembly.orientation),
                   8 * assembly.refinement * assembly.refinement)},
      {"Material",
       fmt::format("E = {}, ν = {}, ρ = {} kg/m³, plane {}{}",
                   setting(material.young / in::GPa, "GPa"), setting(material.poisson),
                   setting(material.density),
                   material.plane == sim::Plane::stress ? "stress" : "strain", unusual(material))},
      {"Joints", fmt::format("σ₁ = {}, σ₂ = {}, r = {}, friction {}{}",
                             setting(joints.head_tail / in::MPa, "MPa", 4),
                             setting(joints.flank / in::MPa, "MPa", 4),
                             setting(ratio(assembly, joints), "", 4), setting(joints.friction),
                             unusual(joints))},
      {"Thresholds", joints.thresholds.empty()
                         ? fmt::format("{}, scatter d = {}, {} of the joints missing, seed {}",
                                       to_string(joints.distribution), setting(joints.scatter),
                                       setting(joints.missing / in::percent, "%"), joints.seed)
                         : "one per joint, given"},
      {"Loading",
       fmt::format("{} 1/s, {} sides, {} start, up to {} strain, followed to {} of the strength",
                   setting(loading.strain_rate),
                   loading.lateral == sim::Lateral::periodic ? "periodic" : "free",
                   loading.start == sim::Start::uniform ? "uniform" : "rest",
                   setting(loading.max_strain / in::percent, "%"), setting(loading.end_fraction))},
      {"Tolerance", setting(solver.tolerance)}};
}

}  // namespace

std::string simulation_page(const SimulationReport& report) {
  const sim::Simulation& simulation = report.simulation;
  return render_page(
      "havers simulate", "simulation",
      {{"grade", text(simulation.trusted() ? "good" : "bad")},
       {"sentence", text(sentence_of(simulation))},
       {"detail", text(cost_of(report))},
       {"facts", mstch::node{fact_list(key_numbers(report))}},
       {"curve", text(draw(simulation_figure(report, "curve")))},
       {"fracture", text(fracture_svg(report.assembly, simulation))},
       {"left_out", left_out_section(simulation.left_out)},
       {"scene",
        mstch::node{mstch::map{{"facts", mstch::node{fact_list(scene_facts(report.scene))}}}}}},
      report.provenance);
}

}  // namespace havers::reports
