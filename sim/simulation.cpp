// Words for what a simulation answers, and the judgement whether its numbers may be used.
#include "sim/simulation.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sim/outcome.hpp"

namespace havers::sim {
namespace {

struct StatusWords {
  const char *word, *sentence;
};

// In the order of the enumerators.
constexpr std::array<StatusWords, 8> status_words{{
    {"broken",
     "after a break both sides bear less than the part of the strength to which failure is "
     "followed"},
    {"strain_limit",
     "the strain limit was reached before the specimen broke; the strength is a lower bound"},
    {"severed", "missing joints leave nothing that bears a load from end to end"},
    {"step_limit",
     "ten million time steps were taken before the specimen broke; a rate that is higher, a "
     "smaller max_strain or the quasi-static regime takes fewer"},
    {"not_determined",
     "more than one set of joint forces bears the load, as where nearly all fibres reach from end "
     "to end; more fibres in a layer leave one"},
    {"not_converged", "a step or a break has no answer that was found"},
    {"not_finite", "a number left the range of doubles"},
    {"cancelled", "stopped by the user"},
}};

}  // namespace

std::string to_string(SimulationStatus status) {
  return status_words.at(static_cast<std::size_t>(status)).word;
}

std::string explain(SimulationStatus status) {
  return status_words.at(static_cast<std::size_t>(status)).sentence;
}

std::string explain(const Simulation& simulation) {
  if (simulation.status != SimulationStatus::broken || simulation.end_fraction_used == 0.0)
    return explain(simulation.status);
  return fmt::format("after a break both sides bear less than {:.3g} of the strength",
                     simulation.end_fraction_used);
}

std::string step_in_words(double step) {
  // What would be rounded to 1000 of a unit is given in the next larger one.
  for (const auto& [unit, symbol] : {std::pair(1.0, "s"), {1e-3, "ms"}, {1e-6, "µs"}, {1e-9, "ns"}})
    if (step >= 0.9995 * unit) return fmt::format("{:.3g} {}", step / unit, symbol);
  return fmt::format("{:.3g} ps", step / 1e-12);
}

namespace {
// Changes by the last halving of a chosen step that are still trusted. Waves between breaks change
// the peak of the stress more than its place, and may change it without end where its mean over a
// wave has settled. [-]
constexpr double largest_error_of_failure_strain = 1e-2, largest_error_of_strength = 3e-2;
constexpr const char* instead_of_halving =
    "; a step_s that is shorter still, or the quasi-static regime, may help";
// Relative defect of (M4) in time steps, and in the quasi-static limit, where pieces that swing by
// a hundred times what the specimen stretches, and a material that hardly changes its volume, leave
// fewer digits to forces. [-]
constexpr double largest_energy_defect = 1e-10, largest_energy_defect_of_events = 1e-7;
// Of the forces in an avalanche, whose joints only tell whether it stops. [-]
constexpr double largest_residual_after_strength = 1e-3;
// (M11) whatever is asked for: joint forces err by far more (M10). [-]
constexpr double largest_residual = 1e-6;
// Of the strength, where slender fibres leave joint forces few digits. [-]
constexpr double largest_rounding_error = 1e-4;
// What a break may add to the energy stored, of that at the strength. [-]
constexpr double largest_energy_gain = 1e-2;
// Of the time to failure: a longer given step sees no more of the way than its end. [-]
constexpr double longest_step = 0.1;

bool steps_over_failure(const Simulation& run) {
  if (run.broken_joints == 0 || run.curve.empty()) return false;
  const CurvePoint& last = run.curve.back();
  return run.step * last.strain > longest_step * run.failure_strain * last.time;
}
}  // namespace

// The first check that does not hold: from what kept the run from its end to what its numbers lack.
// !(a <= b) also holds where one of them is NaN.
std::string Simulation::why_not_trusted() const {
  const bool given = regime == Regime::dynamic && !step_error;
  const bool unsolved = status == SimulationStatus::not_converged;
  if (unsolved && regime == Regime::dynamic && contact == ContactMethod::gauss_seidel)
    return explain(status) +
           "; more max_iterations, contact = \"active-set\" or a shorter step_s may find one";
  if (unsolved && given)
    return explain(status) + "; a shorter step_s may have one, and without it one is looked for";
  if (!has_ended(*this)) return explain(status);
  if (status == SimulationStatus::severed) return "";  // however its pieces lie
  if (step_error && std::isnan(step_error->failure_strain))
    return "the error of the chosen time step is not known: no run of half of it has an answer";
  if (step_error && step_error->failure_strain > largest_error_of_failure_strain)
    return fmt::format("halving the time step still changes the failure strain{}",
                       instead_of_halving);
  if (step_error && step_error->strength > largest_error_of_strength &&
      !(step_error->over_a_wave <= largest_error_of_strength))
    return fmt::format("halving the time step still changes the strength{}", instead_of_halving);
  if (steps_over_failure(*this))
    return "a time step is longer than a tenth of the time to failure; a shorter step_s shows more";
  if (!(residual_to_strength <= tolerance)) return "the joints' law is not met to the tolerance";
  if (!(residual_to_strength <= largest_residual))
    return "the joints' law is met to the tolerance, but joint forces err by far more than that; a "
           "tolerance of 1e-6 or less leaves them digits";
  if (!(worst_residual <= largest_residual_after_strength))
    return "after the strength, the joints' law is not met to a thousandth";
  if (!(energy_defect <=
        (regime == Regime::quasi_static ? largest_energy_defect_of_events : largest_energy_defect)))
    return "the energy balance does not close";
  if (!(rounding_error <= largest_rounding_error))
    return "rounding leaves the strength too few digits";
  if (without_contact_to_strength > 0)
    return "the contact of broken joints had no solution in an event before the strength";
  if (energy_gain > largest_energy_gain)
    return "a break added to the energy stored: friction let the contacts take another answer";
  return std::isfinite(strength) ? "" : explain(SimulationStatus::not_finite);
}

double Simulation::strength_without_ringing() const {
  return strength / (1.0 + ringing);
}

std::string Simulation::reservation(bool without_ringing) const {
  constexpr double worth_saying = 0.01;
  std::vector<std::string> reservations;
  if (!step_error)
    reservations.push_back(fmt::format("the time step: {} was given, and its error is not known",
                                       step_in_words(step)));
  if (!step_error && numerical_loss >= worth_saying)
    reservations.push_back(
        fmt::format("steps took {:.0f} % of all energy", 100.0 * numerical_loss));
  if (!without_ringing && ringing >= worth_saying)
    reservations.push_back(
        fmt::format("the strength: waves that ring, which steps and meshes change, raise it by "
                    "{:.2g} %, from {:.4g} MPa, its mean over the period of the longest and what "
                    "the modulus adds in half of it",
                    100.0 * ringing, 1e-6 * strength_without_ringing()));
  // The slope of a stair that a wave climbs by crossing n times errs by up to this over n.
  constexpr double of_a_stair = 0.6;
  if (has_modulus_of_a_shock())
    reservations.push_back(fmt::format(
        "the modulus{} of a shock, as the wave of the start crosses the specimen less than twice "
        "while it is measured",
        std::isnan(strength_over_a_wave) ? " and the strength: they are those" : ": it is that"));
  else if (of_a_stair / crossings >= worth_saying)
    reservations.push_back(
        fmt::format("the modulus: the wave of the start, which crosses the specimen {:.2g} times "
                    "while it is measured, changes it by up to {:.2g} %",
                    crossings, 100.0 * of_a_stair / crossings));
  return fmt::format("{}", fmt::join(reservations, "; "));
}

StepError Simulation::error_beyond_accuracy() const {
  const auto beyond = [&](double error) { return error > step_accuracy ? error : 0.0; };
  const StepError error = step_error.value_or(StepError{});
  return {beyond(error.failure_strain), beyond(error.strength), beyond(error.over_a_wave)};
}

}  // namespace havers::sim
