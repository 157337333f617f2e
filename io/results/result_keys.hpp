// The keys of results, declared once for writing and for reading back, like those of scenes. Users'
// scripts rely on these names. What a value of a fit means, and its equation, stands with its field
// in calib/fit/calibration.hpp. Parameters are in their own units; all else is in SI units, unless
// its name says another.
#pragma once

#include "io/config/scene_keys.hpp"
#include "io/config/study_keys.hpp"
#include "io/results/measured_keys.hpp"
#include "io/results/result_files.hpp"

namespace havers::io {

/// A scene in the tables of a scene file. [joints] is written with σ₁ and σ₂, whichever of the four
/// strengths the scene's file gave.
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

/// What a run did without, and why.
template <class Table>
void keys(Table& table, sim::LeftOut& left_out) {
  table.key("what", left_out.what);
  table.key("why", left_out.why);
}

/// What made a result: program, command, and inputs by their SHA-256.
template <class Table>
void keys(Table& table, calib::Provenance& provenance) {
  table.key("havers", provenance.havers);
  table.key("compiler", provenance.compiler);
  table.key("command", provenance.command);
  table.key("inputs", provenance.inputs);
  table.key("wall_s", provenance.wall_seconds);
  table.key("cpu_s", provenance.cpu_seconds);
}

/// A specimen as the study gives it; its test is with its result.
template <class Table>
void keys(Table& table, calib::Specimen& specimen) {
  table.key("id", specimen.id);
  table.key("use", specimen.use);
  table.key("orientation_deg", specimen.orientation, degree);
  table.key("porosity", specimen.porosity);
  table.key("sections", specimen.sections);
}

/// A study, as far as the page of its fit needs it.
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

/// One sentence of the verdict.
template <class Table>
void keys(Table& table, calib::Check& check) {
  table.key("check", check.check);
  table.key("outcome", check.outcome);
  table.key("text", check.text);
  table.key("done", check.done);  // false: there was nothing to check
}

/// Numbers in `unit`. `interval_95` is by profile likelihood where there is a profile, else by the
/// slopes.
template <class Table>
void keys(Table& table, calib::CalibratedParameter& parameter) {
  table.key("name", parameter.name);
  table.key("value", parameter.value);
  table.key("unit", parameter.unit);
  table.key("standard_error", parameter.standard_error);  // null where not identifiable
  table.key("interval_95", parameter.interval_95);
  table.key("slopes_95", parameter.slopes_95);        // (F11)
  table.key("profile_95", parameter.profile_95);      // (F15)
  table.key("bootstrap_95", parameter.bootstrap_95);  // (F16), over specimens
  table.key("profile_missing", parameter.profile_missing);
  table.key("bootstrap_missing", parameter.bootstrap_missing);
  table.key("bounds", parameter.bounds);
  table.key("at_bound", parameter.at_bound);
  table.key("identifiable", parameter.identifiable);
  table.key("left_out_because", parameter.left_out_because);  // empty where fitted
}

/// A simulated quantity over the replicates of a specimen.
template <class Table>
void keys(Table& table, calib::Spread& spread) {
  table.key("mean", spread.mean);
  table.key("sd", spread.sd);
}

/// A term of the cost: a landmark (F4), the parts of its weight (F6) and what it costs. Also the
/// columns of terms.csv.
template <class Table>
void keys(Table& table, calib::TermResult& term) {
  table.key("term", term.term);
  table.key("measured", term.measured);  // landmarks, both
  table.key("simulated", term.simulated);
  table.key("sd_machine", term.machine);        // of the measurement
  table.key("sd_replicates", term.replicates);  // of one draw against a mean of n
  table.key("sd_scatter", term.scatter);        // by the error of the specimen's scatter
  table.key("sd_specimens", term.specimens);    // between specimens, beyond all that
  table.key("sd_parameters", term.parameters);  // by the errors of the fit
  table.key("sd", term.sd);                     // of all together
  table.key("residual", term.residual);         // standardised by sd
  table.key("share", term.share);               // of the cost
  table.key("bound", term.bound);               // the test was stopped: `measured` is a bound
}

/// One simulation at the answer. Also the columns of replicates.csv.
template <class Table>
void keys(Table& table, calib::ReplicateResult& replicate) {
  table.key("seed", replicate.seed);  // joints.seed of its scene
  table.key("failed", replicate.failed);
  table.key("broke", replicate.broke);
  table.key("modulus_Pa", replicate.modulus);
  table.key("strength_Pa", replicate.strength);
  table.key("failure_strain", replicate.failure_strain);
  table.key("pre_peak", replicate.pre_peak);  // landmarks of the curve (F4), as the next two
  table.key("energy", replicate.energy);
  table.key("post_peak", replicate.post_peak);
}

/// How a parameter would move without the specimen, in standard errors.
template <class Table>
void keys(Table& table, calib::Influence& influence) {
  table.key("parameter", influence.parameter);
  table.key("shift", influence.shift);
}

/// A specimen, measured and simulated. Its measured modulus, strength and failure strain come
/// twice, here and in `measured`; the curves are in files of their own.
template <class Table>
void keys(Table& table, calib::SpecimenResult& specimen) {
  table.key("id", specimen.id);
  table.key("use", specimen.use);
  table.key("orientation_deg", specimen.orientation, degree);
  table.key("modulus_Pa", specimen.measured.modulus);
  table.key("strength_Pa", specimen.measured.strength);
  table.key("failure_strain", specimen.measured.failure_strain);
  table.key("porosity", specimen.porosity);
  table.key("scatter", specimen.scatter);  // d, as used
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

/// One stage of the search.
template <class Table>
void keys(Table& table, calib::StageLog& stage) {
  table.key("optimiser", stage.optimiser);
  table.key("cost_before", stage.cost_before);
  table.key("cost_after", stage.cost_after);
  table.key("evaluations", stage.evaluations);
  table.key("message", stage.message);
  table.key("wall_s", stage.wall_seconds);
}

/// Rise of the cost along one parameter, the others refitted (F15).
template <class Table>
void keys(Table& table, calib::Profile& profile) {
  table.key("parameter", profile.parameter);
  table.key("value", profile.value);
  table.key("rise", profile.rise);    // of the cost, by value
  table.key("level", profile.level);  // the rise at the ends of the interval
  table.key("interval_95", profile.interval_95);
}

/// What of the answer is the simulations' own chance (F17).
template <class Table>
void keys(Table& table, calib::Randomness& randomness) {
  table.key("replicates", randomness.replicates);
  table.key("replicates_needed", randomness.replicates_needed);
  table.key("common_gain", randomness.common_gain);  // variance without common seeds over that with
  table.key("simulator_share", randomness.simulator_share);  // of a parameter's variance
  table.key("fresh_cost", randomness.fresh_cost);
  table.key("fresh_shift", randomness.fresh_shift);  // in standard errors
  table.key("fresh_width", randomness.fresh_width);
}

/// One replicate in the quasi-static limit and step by step in time.
template <class Table>
void keys(Table& table, calib::Confirmation& confirmation) {
  table.key("specimen", confirmation.specimen);
  table.key("seed", confirmation.seed);
  table.key("strain_rate_per_s", confirmation.strain_rate);
  table.key("failed", confirmation.failed);
  table.key("strength_quasi_static_Pa", confirmation.strength_limit);
  table.key("strength_in_time_Pa", confirmation.strength_in_time);  // without waves that ring (F21)
  table.key("peak_in_time_Pa", confirmation.peak_in_time);          // with single waves
  table.key("failure_strain_quasi_static", confirmation.failure_strain_limit);
  table.key("failure_strain_in_time", confirmation.failure_strain_in_time);
}

/// A further test, and what it would make of each standard error: after over before.
template <class Table>
void keys(Table& table, calib::NextTest& test) {
  table.key("what", test.what);
  table.key("width", test.width);  // one for each of `fitted`
}

/// The whole answer of a fit; `calibration_json` adds what is for users alone.
template <class Table>
void keys(Table& table, calib::CalibrationResult& result) {
  table.key("status", result.status);
  table.key("verdict", result.verdict);
  table.key("parameters", result.parameters);
  table.key("specimens", result.specimens);
  table.key("stages", result.stages);
  table.key("left_out", result.left_out);
  table.key("notes", result.notes);              // doubts about the study as read
  table.key("fitted", result.fitted);            // parameters with an interval
  table.key("correlation", result.correlation);  // rows and columns as fitted
  table.key("directions", result.directions);    // best determined first, in words
  table.key("profiles", result.profiles);
  table.key("starts", result.starts);  // costs, best first
  table.key("ends", result.ends);      // the same, of those refined
  table.key("randomness", result.randomness);
  table.key("confirmations", result.confirmations);
  table.key("next_tests", result.next_tests);
  table.key("scene", result.scene);
  table.key("cost", result.cost);                        // half the sum of squared residuals
  table.key("specimen_effect", result.specimen_effect);  // of each landmark (F9)
  table.key("evaluations", result.evaluations);          // how many simulations were asked for
  table.key("simulated", result.simulated);              // of these, run and not found in the store
  table.key("distinct_simulations", result.distinct_simulations);  // different ones asked for
  table.key("failed_simulations", result.failed_simulations);
}

}  // namespace havers::io
