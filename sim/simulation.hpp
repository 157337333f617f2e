// What a simulation answers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/assembly/assembly.hpp"
#include "sim/scene.hpp"
#include "sim/stop_asked.hpp"

namespace havers::sim {

/// Why a simulation ended.
enum class SimulationStatus {
  broken,          ///< Both sides dropped below the end fraction after a break.
  strain_limit,    ///< The strain limit came first. The strength is a lower bound.
  severed,         ///< Missing joints leave nothing that bears a load from end to end.
  step_limit,      ///< So many steps, and it did not break. The strength is a lower bound.
  not_determined,  ///< More than one set of joint forces bears the intact specimen's load.
  not_converged,   ///< A step or a break has no answer that was found.
  not_finite,      ///< A number left the range of doubles.
  cancelled,       ///< Somebody asked to stop.
};

/// The status as one word, as written to result.json, and as a sentence.
std::string to_string(SimulationStatus status);
std::string explain(SimulationStatus status);

/// A time step as it is said everywhere: "20 ns", "4.58 ms". [s]
std::string step_in_words(double step);

/// One row of the response. Energies are per unit thickness.
struct CurvePoint {
  double time = 0.0;          ///< [s]
  double strain = 0.0;        ///< ε. [-]
  double stress_right = 0.0;  ///< [Pa]
  double stress_left = 0.0;   ///< [Pa]
  int broken_joints = 0;      ///< Without the missing ones.
  double kinetic = 0.0;       ///< [J/m]
  double elastic = 0.0;       ///< [J/m]
  double dissipated = 0.0;    ///< By joints and viscosity, since the start. [J/m]
  double numerical = 0.0;     ///< Taken by implicit Euler, since the start. [J/m]
};

/// A joint at the end of a run.
struct JointOutcome {
  Threshold threshold;  ///< [N/m]
  bool broken = false;  ///< From the start where it is missing.
  double broken_at_strain = std::numeric_limits<double>::quiet_NaN();  ///< NaN while bonded. [-]
  double reaction_normal = 0.0;   ///< R_N, compression positive. [N/m]
  double reaction_tangent = 0.0;  ///< R_T. [N/m]
  /// g; below 0 where it penetrates, or by rounding. In the limit one of many at a piece that
  /// hangs on nothing, and 0 where that would overlap. [m]
  double gap = 0.0;

  /// In this run: it was not missing from the start.
  [[nodiscard]] bool broke() const { return broken && !is_missing(threshold); }
};

/// Something the run did without, and on what ground. Section 7.
struct LeftOut {
  std::string what, why;
};

/// Relative changes, NaN when the step was never halved. [-]
struct StepError {
  double failure_strain = 0.0, strength = 0.0;
  double over_a_wave = 0.0;  ///< Of `strength_over_a_wave`.

  /// Of the two that a chosen step is to settle.
  [[nodiscard]] double largest() const { return std::max(failure_strain, strength); }
};

/// A finished simulation. Whatever the status, the curve holds what was computed.
struct Simulation {
  SimulationStatus status = SimulationStatus::not_converged;
  Regime regime = Regime::dynamic;  ///< The one used; never automatic.
  double step = 0.0;                ///< h used; 0 in the quasi-static limit. [s]
  std::string regime_ground;        ///< Why this regime and this step, in words.

  std::vector<CurvePoint> curve;
  std::vector<JointOutcome> joints;  ///< In the order of Assembly::joints.
  Eigen::VectorXd displacements;  ///< Of the last row, x and y of every node of the assembly. [m]

  /// Largest stress at the right side; like its strain and the modulus NaN where not even the first
  /// row had an answer. [Pa]
  double strength = 0.0;
  /// Largest mean of the stress over the period 2W/c of the longest wave, in which its two ends
  /// count least (a triangle), as breaks set waves free that no machine sees; NaN in the limit, and
  /// where the last joint broke earlier. [Pa]
  double strength_over_a_wave = std::numeric_limits<double>::quiet_NaN();
  /// By how much the strength is more than that mean and what the specimen's modulus adds to it in
  /// half that period: waves that ring; 0 where it is not, and where that is NaN. [-]
  double ringing = 0.0;
  double failure_strain = 0.0;  ///< Strain of the strength. [-]
  /// Slope from 0.1 (in time from the end of the first step, up to 0.4) to 0.5 of the first break's
  /// strain, or of the last row's without one. [Pa]
  double modulus = 0.0;
  /// How often waves of the start cross the specimen in that stretch: from rest, on a stair of
  /// stress, or in uniform motion where joints are missing or oblique layers differ; NaN without
  /// them. [-]
  double crossings = std::numeric_limits<double>::quiet_NaN();
  /// NaN when nothing broke. [-]
  double first_break_strain = std::numeric_limits<double>::quiet_NaN();
  int broken_joints = 0;  ///< Of the last row: what an avalanche breaks thereafter is not counted.
  /// Part of the strength down to which the run was followed: the scene's `end_fraction`, or more
  /// where the rest of an avalanche is left out. Section 6. [-]
  double end_fraction_used = 0.0;

  /// What the last two halvings of a chosen step changed at most; 0 in the quasi-static limit, none
  /// where the step was given.
  std::optional<StepError> step_error = StepError{};
  long uniform_steps = 0;       ///< In time: whole ones of uniform motion, from where that was seen
                                ///< to one before the first break or the strain limit.
  double leapt_strain = 0.0;    ///< What was stretched there without these steps. [-]
  double step_accuracy = 0.0;   ///< Of both by a chosen step, as asked for. [-]
  int steps = 0;                ///< Time steps, or events of the quasi-static sequence.
  long iterations = 0;          ///< Of the contact solver, all steps together.
  double energy_defect = 0.0;   ///< Largest relative defect of (M4) over the steps; quasi-static:
                                ///< that of the state at the strength. [-]
  double numerical_loss = 0.0;  ///< Part of all energy that implicit Euler took: no bone's. [-]
  double energy_gain = 0.0;     ///< Quasi-static: the most that a break up to the strength added to
                                ///< the energy stored, of that at the strength. [-]
  double rounding_error = 0.0;  ///< Quasi-static: of the strength or its strain, as far as a solve
                                ///< of the whole structure in that state shows it. [-]
  double worst_residual = 0.0;  ///< Largest (M11) over the steps or events. [-]
  double residual_to_strength = 0.0;  ///< The same over the events up to the strength; in time over
                                      ///< all steps. [-]
  double tolerance = 0.0;             ///< Of the residual, as asked for. [-]
  ContactMethod contact = ContactMethod::active_set;  ///< As asked for; the limit has its own.
  double worst_penetration = 0.0;                     ///< Largest −g. [m]
  int events_without_contact =
      0;  ///< Quasi-static: events whose contact had no solution and was left out.
  int without_contact_to_strength = 0;  ///< Those of them before the strength.
  int dropped = 0;                      ///< Half fibres of which the clipping left but a sliver.
  std::vector<LeftOut> left_out;

  /// Joints that were missing from the start.
  [[nodiscard]] long missing_joints() const {
    return std::ranges::count_if(joints, is_missing, &JointOutcome::threshold);
  }
  /// Whether the numbers may be used: the run ended as it should and the checks hold.
  [[nodiscard]] bool trusted() const { return why_not_trusted().empty(); }
  /// The check that does not hold, as a sentence; empty when all do. What helps, where that is
  /// known, stands behind a semicolon.
  [[nodiscard]] std::string why_not_trusted() const;
  /// The strength without waves that ring, as a testing machine would see it; the strength itself
  /// in the limit, and where the last joint broke before that period had passed. [Pa]
  [[nodiscard]] double strength_without_ringing() const;
  /// Whether waves of the start leave the modulus little more than a shock's: they cross the
  /// specimen less than twice while it is measured.
  [[nodiscard]] bool has_modulus_of_a_shock() const { return crossings < 2.0; }
  /// What a trusted run is to be trusted but for: a time step that was given, whose error nobody
  /// knows; waves in the strength, where that is not taken `strength_without_ringing`, or in the
  /// modulus. Nouns with what is to be said of them, semicolons between; empty where there is
  /// nothing.
  [[nodiscard]] std::string reservation(bool without_ringing = false) const;
  /// The step error, where that is more than was asked for; else 0.
  [[nodiscard]] StepError error_beyond_accuracy() const;
};

/// Why a simulation ended, with the part of the strength down to which it was followed.
std::string explain(const Simulation& simulation);

/// What a caller may watch while a simulation runs.
struct Progress {
  const CurvePoint& point;
  std::size_t row;                                    ///< Of the curve, from 0.
  std::function<std::vector<JointOutcome>()> joints;  ///< In the order of Assembly::joints.
  /// x and y of every node; in the quasi-static limit a solve, which the run itself does without.
  /// [m]
  std::function<Eigen::VectorXd()> displacements;
};

/// Called after each step or break. Where a run is done again, with a shorter step or more care,
/// rows are seen again, from no later one. Watching changes nothing.
using Observer = std::function<void(const Progress&)>;

/// Runs a scene, until it ends or is stopped (status `cancelled`). Precondition: scene.problems()
/// is empty.
Simulation simulate(const Scene& scene, const Observer& observer = {},
                    const StopAsked& stop_asked = {});

}  // namespace havers::sim
