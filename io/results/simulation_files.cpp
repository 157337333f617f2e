// What a simulation leaves. Its numbers are written in SI units, as it has them.
#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "io/results/csv_numbers.hpp"
#include "io/results/json_table.hpp"
#include "io/results/result_files.hpp"
#include "io/results/result_keys.hpp"

namespace havers::io {

nlohmann::json simulation_json(const SceneFile& file, const sim::Simulation& simulation,
                               const calib::Provenance& provenance) {
  nlohmann::json scene = scene_json(file.scene);
  scene["output"]["snapshots"] = file.snapshots;
  // The error is told by halving the step; a given step is not halved, so its error is not known.
  const sim::StepError error = simulation.step_error.value_or(sim::StepError{NAN, NAN, NAN});
  return {
      {"status", sim::to_string(simulation.status)},
      {"status_text", sim::explain(simulation)},
      {"trusted", simulation.trusted()},
      {"regime", word(simulation.regime)},
      {"regime_ground", simulation.regime_ground},
      {"step_s", json_of(simulation.step)},
      {"step_error", json_of(error.failure_strain)},
      {"step_error_of_strength", json_of(error.strength)},
      {"step_error_over_a_wave", json_of(error.over_a_wave)},
      {"strength_Pa", json_of(simulation.strength)},
      {"strength_over_a_wave_Pa", json_of(simulation.strength_over_a_wave)},
      {"strength_without_ringing_Pa", json_of(simulation.strength_without_ringing())},
      {"failure_strain",
       json_of(simulation.status == sim::SimulationStatus::broken ? simulation.failure_strain
                                                                  : NAN)},  // not reached: null
      {"modulus_Pa", json_of(simulation.modulus)},
      {"first_break_strain", json_of(simulation.first_break_strain)},
      {"broken_joints", simulation.broken_joints},
      {"missing_joints", simulation.missing_joints()},
      {"end_fraction_used", json_of(simulation.end_fraction_used)},
      {"steps", simulation.steps},
      {"iterations", simulation.iterations},
      {"energy_defect", json_of(simulation.energy_defect)},
      {"rounding_error", json_of(simulation.rounding_error)},
      {"numerical_loss", json_of(simulation.numerical_loss)},
      {"energy_gain", json_of(simulation.energy_gain)},
      {"worst_residual", json_of(simulation.worst_residual)},
      {"residual_to_strength", json_of(simulation.residual_to_strength)},
      {"worst_penetration_m", json_of(simulation.worst_penetration)},
      {"wall_s", json_of(provenance.wall_seconds)},
      {"left_out", json_of(simulation.left_out)},
      {"scene", scene},
      {"provenance", provenance_object(provenance)},
  };
}

void write_curve(const std::filesystem::path& file, const sim::Simulation& simulation) {
  std::string text =
      "time_s,strain,stress_right_Pa,stress_left_Pa,broken_joints,kinetic_J_per_m,elastic_J_per_m,"
      "dissipated_J_per_m\n";
  for (const sim::CurvePoint& point : simulation.curve)
    text += fmt::format(
        "{},{},{},{},{},{},{},{}\n", csv_number(point.time), csv_number(point.strain),
        csv_number(point.stress_right), csv_number(point.stress_left), point.broken_joints,
        csv_number(point.kinetic), csv_number(point.elastic), csv_number(point.dissipated));
  write_file(file, text);
}

void write_joints(const std::filesystem::path& file, const sim::Assembly& assembly,
                  const sim::Simulation& simulation) {
  // One row for each joint, numbered by its place in both lists.
  assert(assembly.joints.size() == simulation.joints.size());
  std::string text =
      "joint,kind,x_m,y_m,normal_x,normal_y,length_m,f_N,f_T,status,broken_at_strain,"
      "reaction_N_N_per_m,reaction_T_N_per_m,gap_m\n";
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) {
    const sim::Joint& joint = assembly.joints[i];
    const sim::JointOutcome& outcome = simulation.joints[i];
    text += fmt::format(
        "{},{},{},{},{},{},{},", i, joint.kind == sim::JointKind::flank ? "flank" : "head_tail",
        csv_number(joint.position.x()), csv_number(joint.position.y()),
        csv_number(joint.normal.x()), csv_number(joint.normal.y()), csv_number(joint.length));
    text += fmt::format("{},{},{},{},{},{},{}\n", csv_number(outcome.threshold.normal),
                        csv_number(outcome.threshold.tangent), outcome.broken ? "broken" : "bonded",
                        csv_number(outcome.broken_at_strain), csv_number(outcome.reaction_normal),
                        csv_number(outcome.reaction_tangent), csv_number(outcome.gap));
  }
  write_file(file, text);
}

}  // namespace havers::io
