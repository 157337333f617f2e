// The page of one run. A number stands with what limits it: its error by the time step, that it is
// only a bound, or that not all breaks were counted.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "reports/figures/figures.hpp"
#include "reports/pages/page.hpp"
#include "reports/text/format.hpp"

namespace havers::reports {
namespace {

using Status = sim::SimulationStatus;

// Stands behind a value: its relative error by the time step. Nothing if the error is within the
// accuracy that was asked for.
std::string by_step(double error) {
  return error > 0.0
             ? fmt::format(" (±\u00a0{} of it by the step)", quantity(error / in::percent, "%", 2))
             : "";
}

std::string sentence_of(const sim::Simulation& s) {
  if (!s.trusted()) return fmt::format("Not to be trusted: {}.", typeset(s.why_not_trusted()));
  if (s.status == Status::severed)
    return "Missing joints leave nothing that bears a load from end to end. To be trusted.";
  const sim::StepError error = s.error_beyond_accuracy();
  const std::string at = fmt::format(
      "{}{} at {} strain{}", quantity(s.strength / in::MPa, "MPa"), by_step(error.strength),
      quantity(s.failure_strain / in::percent, "%", 3), by_step(error.failure_strain));
  const std::string reservation =
      s.reservation().empty() ? "" : " but for " + typeset(s.reservation());
  return s.status == Status::broken
             ? fmt::format("The specimen broke: strength {}. To be trusted{}.", at, reservation)
             : fmt::format(
                   "The specimen did not break: its strength is at least {}. To be trusted as a "
                   "lower bound{}.",
                   at, reservation);
}

// A time step that leaves an error in the answer, or one that is not known, is not all good.
mstch::node grade_of(const sim::Simulation& s) {
  return grade(s.trusted(), s.reservation().empty() && s.error_beyond_accuracy().largest() == 0.0);
}

std::string step_error_of(const sim::Simulation& s) {
  if (s.regime == sim::Regime::quasi_static) return "";
  if (!s.step_error || std::isnan(s.step_error->failure_strain))
    return " The error of the time step is not known.";
  return fmt::format(
      " The last halvings of the time step, two at most, changed the failure strain by up to {}, "
      "the strength by up to {}{}. Implicit Euler took {} of all energy.",
      quantity(s.step_error->failure_strain / in::percent, "%", 2),
      quantity(s.step_error->strength / in::percent, "%", 2),
      std::isnan(s.step_error->over_a_wave)
          ? ""
          : " and its mean over the longest wave by up to " +
                quantity(s.step_error->over_a_wave / in::percent, "%", 2),
      quantity(s.numerical_loss / in::percent, "%", 2));
}

// A time never stands without the error it was bought with.
std::string cost_of(const SimulationReport& report) {
  const sim::Simulation& s = report.simulation;
  return fmt::format(
      "Why it ended: {}. {} wall time, for a relative energy defect of {}, a residual of at most "
      "{} and a penetration of at most {}.{}",
      explain(s), duration(report.provenance.wall_seconds), number(s.energy_defect, 3),
      number(s.worst_residual, 3), quantity(s.worst_penetration / in::um, "µm", 3),
      step_error_of(s));
}

// Of a run that did not break the strain of the largest stress says nothing.
std::string failure_strain_of(const SimulationReport& report) {
  const sim::Simulation& s = report.simulation;
  if (s.status == Status::broken)
    return quantity(s.failure_strain / in::percent, "%") +
           by_step(s.error_beyond_accuracy().failure_strain);
  if (s.status == Status::severed) return "–";
  if (s.status != Status::strain_limit) return "not reached";
  return fmt::format("not reached within the strain limit of {}",
                     setting(report.scene.loading.max_strain / in::percent, "%"));
}

// Whether the rest of an avalanche is left out.
bool ends_early(const SimulationReport& report) {
  return report.simulation.end_fraction_used > report.scene.loading.end_fraction;
}

std::string broken_joints_of(const SimulationReport& report) {
  const sim::Simulation& s = report.simulation;
  std::string joints = fmt::format("{} of {}", s.broken_joints, report.assembly.joints.size());
  if (s.status == Status::broken && ends_early(report))
    joints +=
        fmt::format(", counted down to {} of the strength", setting(s.end_fraction_used, "", 3));
  if (const long missing = s.missing_joints(); missing > 0)
    joints += fmt::format("; {} missing from the start", missing);
  return joints;
}

// A run that leaps to its first break takes no steps on the way there.
std::string steps_of(const sim::Simulation& s) {
  if (s.regime == sim::Regime::quasi_static) return std::to_string(s.steps);
  const std::string step = typeset(sim::step_in_words(s.step));
  return s.leapt_strain > 0.0 ? fmt::format("{}, of {} from the first break on", s.steps, step)
                              : fmt::format("{} of {}", s.steps, step);
}

Facts key_numbers(const SimulationReport& report) {
  const sim::Simulation& s = report.simulation;
  const bool dynamic = s.regime == sim::Regime::dynamic;
  const bool bounded =
      s.status != Status::broken && s.status != Status::severed && !std::isnan(s.strength);
  Facts facts{{bounded ? "Strength, at least" : "Strength",
               quantity(s.strength / in::MPa, "MPa") + by_step(s.error_beyond_accuracy().strength)},
              {"Failure strain", failure_strain_of(report)},
              {"Modulus", quantity(s.modulus / in::GPa, "GPa")},
              {"Strain of the first break", quantity(s.first_break_strain / in::percent, "%")},
              {"Broken joints", broken_joints_of(report)},
              {"Regime", fmt::format("{}: {}", dynamic ? "dynamic" : "quasi-static",
                                     typeset(s.regime_ground))},
              {dynamic ? "Time steps" : "Events", steps_of(s)},
              {"Contact iterations", std::to_string(s.iterations)}};
  if (!std::isnan(s.strength_over_a_wave))
    // Right behind the strength, which it explains.
    facts.insert(facts.begin() + 1, {"Strength without waves that ring",
                                     quantity(s.strength_without_ringing() / in::MPa, "MPa") +
                                         by_step(s.error_beyond_accuracy().over_a_wave)});
  return facts;
}

// Under the figure of the assembly: when it looked so.
std::string end_of(const SimulationReport& report) {
  const sim::Simulation& s = report.simulation;
  if (s.status != Status::broken) return "The assembly at the end of the run.";
  const std::string when = fmt::format(
      "The assembly when both sides first bear less than {} of the strength, where the run ends",
      setting(s.end_fraction_used, "", 3));
  if (!ends_early(report)) return when + ".";
  return fmt::format(
      "{}: what the avalanche breaks thereafter is neither shown nor counted (solver.leave_out = "
      "false follows it on, to {}).",
      when, setting(report.scene.loading.end_fraction));
}

// What is not there at all would look like a drawing's fault.
std::string gaps_of(const sim::Simulation& s) {
  return s.missing_joints() > 0 ? " Joints that are missing from the start leave gaps." : "";
}

// Down to which part of its strength the run was followed.
std::string followed_to(const SimulationReport& report) {
  const std::string part = setting(report.simulation.end_fraction_used, "", 3);
  return ends_early(report) ? fmt::format("{} of the strength ({} where nothing is left out)", part,
                                          setting(report.scene.loading.end_fraction))
                            : part + " of the strength";
}

// In the order of sim::Distribution.
std::string to_string(sim::Distribution distribution) {
  constexpr std::array words{"uniform", "Weibull", "log-normal"};
  return words.at(static_cast<std::size_t>(distribution));
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

// The whole scene in a few lines; settings that scenes seldom change are shown only if they are
// changed.
Facts scene_facts(const SimulationReport& report) {
  const auto& [assembly, material, joints, loading, solver] = report.scene;
  return {
      {"Assembly",
       fmt::format("{} of {}, {} by {}, at {}, {} triangles a fibre",
                   count(assembly.layers, "layer"), count(assembly.fibres, "fibre"),
                   setting(assembly.fibre_length / in::um, "µm"),
                   setting(assembly.fibre_height / in::um, "µm"), degrees(assembly.orientation),
                   8 * assembly.refinement * assembly.refinement)},
      {"Material",
       fmt::format("E = {}, ν = {}, ρ = {}\u00a0kg/m³, plane {}{}",
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
      {"Loading", fmt::format("{}\u00a01/s, {} sides, from {}, up to {} strain, followed to {}",
                              setting(loading.strain_rate),
                              loading.lateral == sim::Lateral::periodic ? "periodic" : "free",
                              loading.start == sim::Start::uniform ? "uniform motion" : "rest",
                              setting(loading.max_strain / in::percent, "%"), followed_to(report))},
      {"Tolerance", setting(solver.tolerance)}};
}

}  // namespace

std::string simulation_page(const SimulationReport& report) {
  const sim::Simulation& simulation = report.simulation;
  return render_page(
      "havers simulate" + (report.file.empty() ? "" : ": " + report.file), "simulation",
      {{"grade", grade_of(simulation)},
       {"sentence", text(sentence_of(simulation))},
       {"detail", text(cost_of(report))},
       {"facts", fact_list(key_numbers(report))},
       {"curve", text(simulation.curve.size() < 2 ? "" : draw(simulation_figure(report, "curve")))},
       {"in_time", simulation.regime == sim::Regime::dynamic},
       {"loses", loses_energy(simulation)},
       {"end", text(end_of(report) + gaps_of(simulation))},
       {"fracture", text(fracture_svg(report.assembly, simulation))},
       {"left_out", left_out_section(simulation.left_out)},
       {"scene", mstch::map{{"facts", fact_list(scene_facts(report))}}}},
      report.provenance);
}

}  // namespace havers::reports
