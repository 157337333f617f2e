// The keys of results, declared once for writing and for reading back, like those of scenes.
#pragma once

#include "io/config/scene_keys.hpp"
#include "io/config/study_keys.hpp"
#include "io/results/measured_keys.hpp"
#include "io/results/result_files.hpp"

namespace havers::io {

template <class Table>
void keys(Table& table, sim::Scene& scene) {
  table.key("assembly", scene.assembly);
  table.key("material", scene.material);
  table.group("joints", [&](auto& joints) {
    joints.key("head_tail_MPa", scene.joints.head_tail, megapascal);
    joints.key("flank_MPa", scene.joints.flank, megapascal);
    keys(joints, scene.joints);
  });
  table.key("loading", scene.loading);
  table.key("solver", scene.solver);
}

template <class Table>
void keys(Table& table, sim::LeftOut& left_out) {
  table.key("what", left_out.what);
  table.key("why", left_out.why);
}

template <class Table>
void keys(Table& table, calib::Provenance& provenance) {
  table.key("havers", provenance.havers);
  table.key("compiler", provenance.compiler);
  table.key("command", provenance.command);
  table.key("inputs", provenance.inputs);
  table.key("wall_s", provenance.wall_seconds);
  table.key("cpu_s", provenance.cpu_seconds);
}

template <class Table>
void keys(Table& table, calib::Specimen& specimen) {
  table.key("id", specimen.id);
  table.key("use", specimen.use);
  table.key("orientation_deg", specimen.orientation, degree);
  table.key("porosity", specimen.porosity);
  table.key("sections", specimen.sections);
}

template <class Table>
void keys(Table& table, calib::Study& study) {
  table.key("name", study.name);
  table.key("specimens", study.specimens);
  table.key("model", study.model);
  table.key("porosity", study.porosity);
  table.group("calibrate", [&](auto& calibrate) {
    calibrate.key("parameters", study.calibrate.parameters);
    calibrate.key("automatic", study.calibrate.automatic);
    calibrate.key("bounds", study.calibrate.bounds);
    calibrate.key("level", study.calibrate.level);
    calibrate.key("options", study.calibrate);
  });
}

template <class Table>
void keys(Table& table, calib::Check& check) {
  table.key("check", check.check);
  table.key("outcome", check.outcome);
  table.key("text", check.text);
  table.key("done", check.done);
}

template <class Table>
void keys(Table& table, calib::CalibratedParameter& parameter) {
  table.key("name", parameter.name);
  table.key("value", parameter.value);
  table.key("unit", parameter.unit);
  table.key("standard_error", parameter.standard_error);
  table.key("interval_95", parameter.interval_95);
  table.key("slopes_95", parameter.slopes_95);
  table.key("profile_95", parameter.profile_95);
  table.key("bootstrap_95", parameter.bootstrap_95);
  table.key("profile_missing", parameter.profile_missing);
  table.key("bootstrap_missing", parameter.bootstrap_missing);
  table.key("bounds", parameter.bounds);
  table.key("at_bound", parameter.at_bound);
  table.key("identifiable", parameter.identifiable);
  table.key("left_out_because", parameter.left_out_because);
}

template <class Table>
void keys(Table& table, calib::Spread& spread) {
  table.key("mean", spread.mean);
  table.key("sd", spread.sd);
}

template <class Table>
void keys(Table& table, calib::TermResult& term) {
  table.key("term", term.term);
  table.key("measured", term.measured);
  table.key("simulated", term.simulated);
  table.key("sd_machine", term.machine);
  table.key("sd_replicates", term.replicates);
  table.key("sd_scatter", term.scatter);
  table.key("sd_specimens", term.specimens);
  table.key("sd_parameters", term.parameters);
  table.key("sd", term.sd);
  table.key("residual", term.residual);
  table.key("share", term.share);
  table.key("bound", term.bound);
}

template <class Table>
void keys(Table& table, calib::ReplicateResult& replicate) {
  table.key("seed", replicate.seed);
  table.key("failed", replicate.failed);
  table.key("broke", replicate.broke);
  table.key("modulus_Pa", replicate.modulus);
  table.key("strength_Pa", replicate.strength);
  table.key("failure_strain", replicate.failure_strain);
  table.key("pre_peak", replicate.pre_peak);
  table.key("energy", replicate.energy);
  table.key("post_peak", replicate.post_peak);
}

template <class Table>
void keys(Table& table, calib::Influence& influence) {
  table.key("parameter", influence.parameter);
  table.key("shift", influence.shift);
}

template <class Table>
void keys(Table& table, calib::SpecimenResult& specimen) {
  table.key("id", specimen.id);
  table.key("use", specimen.use);
  table.key("orientation_deg", specimen.orientation, degree);
  table.key("modulus_Pa", specimen.measured.modulus);
  table.key("strength_Pa", specimen.measured.strength);
  table.key("failure_strain", specimen.measured.failure_strain);
  table.key("porosity", specimen.porosity);
  table.key("scatter", specimen.scatter);
  table.key("measured", specimen.measured);
  table.group("simulated", [&](auto& simulated) {
    simulated.key("modulus_Pa", specimen.modulus);
    simulated.key("strength_Pa", specimen.strength);
    simulated.key("failure_strain", specimen.failure_strain);
  });
  table.group("residual", [&](auto& residual) {
    residual.key("modulus", specimen.residual[0]);
    residual.key("strength", specimen.residual[1]);
    residual.key("failure_strain", specimen.residual[2]);
  });
  table.key("terms", specimen.terms);
  table.key("replicates", specimen.replicates);
  table.key("influence", specimen.influence);
  table.key("failed_simulations", specimen.failed_simulations);
}

template <class Table>
void keys(Table& table, calib::StageLog& stage) {
  table.key("optimiser", stage.optimiser);
  table.key("cost_before", stage.cost_before);
  table.key("cost_after", stage.cost_after);
  table.key("evaluations", stage.evaluations);
  table.key("message", stage.message);
  table.key("wall_s", stage.wall_seconds);
}

template <class Table>
void keys(Table& table, calib::Profile& profile) {
  table.key("parameter", profile.parameter);
  table.key("value", profile.value);
  table.key("rise", profile.rise);
  table.key("level", profile.level);
  table.key("interval_95", profile.interval_95);
}

template <class Table>
void keys(Table& table, calib::Randomness& randomness) {
  table.key("replicates", randomness.replicates);
  table.key("replicates_needed", randomness.replicates_needed);
  table.key("common_gain", randomness.common_gain);
  table.key("simulator_share", randomness.simulator_share);
  table.key("fresh_cost", randomness.fresh_cost);
  table.key("fresh_shift", randomness.fresh_shift);
  table.key("fresh_width", randomness.fresh_width);
}

template <class Table>
void keys(Table& table, calib::Confirmation& confirmation) {
  table.key("specimen", confirmation.specimen);
  table.key("seed", confirmation.seed);
  table.key("strain_rate_per_s", confirmation.strain_rate);
  table.key("failed", confirmation.failed);
  table.key("strength_quasi_static_Pa", confirmation.strength_limit);
  table.key("strength_in_time_Pa", confirmation.strength_in_time);
  table.key("peak_in_time_Pa", confirmation.peak_in_time);
  table.key("failure_strain_quasi_static", confirmation.failure_strain_limit);
  table.key("failure_strain_in_time", confirmation.failure_strain_in_time);
}

template <class Table>
void keys(Table& table, calib::NextTest& test) {
  table.key("what", test.what);
  table.key("width", test.width);
}

template <class Table>
void keys(Table& table, calib::CalibrationResult& result) {
  table.key("status", result.status);
  table.key("verdict", result.verdict);
  table.key("parameters", result.parameters);
  table.key("specimens", result.specimens);
  table.key("stages", result.stages);
  table.key("left_out", result.left_out);
  table.key("notes", result.notes);
  table.key("fitted", result.fitted);
  table.key("correlation", result.correlation);
  table.key("directions", result.directions);
  table.key("profiles", result.profiles);
  table.key("starts", result.starts);
  table.key("ends", result.ends);
  table.key("randomness", result.randomness);
  table.key("confirmations", result.confirmations);
  table.key("next_tests", result.next_tests);
  table.key("scene", result.scene);
  table.key("cost", result.cost);
  table.key("specimen_effect", result.specimen_effect);
  table.key("evaluations", result.evaluations);
  table.key("simulated", result.simulated);
  table.key("distinct_simulations", result.distinct_simulations);
  table.key("failed_simulations", result.failed_simulations);
}

}  // namespace havers::io
