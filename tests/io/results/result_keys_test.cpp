// Which number stands under which key: keys are declared once, for writing and for reading, so that
// no round trip sees two that are exchanged. All numbers here are different.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "io/results/result_files.hpp"
#include "tests/support/results.hpp"
#include "tests/support/scratch_folder.hpp"

namespace havers::io {
namespace {

using nlohmann::literals::operator""_json;

calib::TermResult strength_term() {
  return {.term = "strength",
          .measured = 1.5,
          .simulated = 2.5,
          .machine = 0.01,
          .replicates = 0.02,
          .scatter = 0.03,
          .specimens = 0.04,
          .parameters = 0.05,
          .sd = 0.06,
          .residual = -0.7,
          .share = 0.8,
          .bound = true};
}

calib::ReplicateResult third_replicate() {
  return {.seed = 3,
          .failed = false,
          .broke = true,
          .modulus = 12e9,
          .strength = 41e6,
          .failure_strain = 0.0035,
          .pre_peak = 1.25,
          .energy = 1.75,
          .post_peak = 2.25};
}

calib::MeasuredTest measured_bar() {
  calib::MeasuredTest test;
  test.area = 8e-6;
  test.modulus = 13e9;
  test.modulus_standard_error = 1e8;
  test.window_low = 0.001;
  test.window_high = 0.002;
  test.max_force = 320.0;
  test.strength = 40e6;
  test.strength_standard_error = 2e5;
  test.failure_strain = 0.003;
  test.broke = false;
  test.strain_rate = 0.004;
  test.energy_to_failure = 6e4;
  test.linearity = 0.98;
  test.corrections = {{"toe", "strain shifted"}};
  test.warnings = {"coarse"};
  test.unit_doubt = "no bone";
  return test;
}

calib::SpecimenResult turned_bar() {
  calib::SpecimenResult specimen;
  specimen.id = "A1";
  specimen.use = calib::Use::validate;
  specimen.orientation = 0.5 * std::numbers::pi;
  specimen.porosity = 0.11;
  specimen.scatter = 0.12;
  specimen.measured = measured_bar();
  specimen.modulus = {14e9, 15e7};
  specimen.strength = {42e6, 43e5};
  specimen.failure_strain = {0.0031, 0.00032};
  specimen.residual = {1.1, -1.2, 1.3};
  specimen.terms = {strength_term()};
  specimen.replicates = {third_replicate()};
  specimen.influence = {{"ratio", -0.9}};
  specimen.failed_simulations = 5;
  return specimen;
}

nlohmann::json json_of_result(const calib::CalibrationResult& result) {
  return calibration_json({}, result, {});
}

TEST(ResultKeys, OfASpecimenNameItsNumbers) {
  calib::CalibrationResult result;
  result.specimens = {turned_bar()};
  EXPECT_EQ(json_of_result(result)["specimens"][0], R"({
    "id": "A1", "use": "validate", "orientation_deg": 90.0,
    "modulus_Pa": 13e9, "strength_Pa": 40e6, "failure_strain": 0.003,
    "porosity": 0.11, "scatter": 0.12,
    "measured": {
      "area_m2": 8e-6, "modulus_Pa": 13e9, "modulus_standard_error_Pa": 1e8,
      "window_low": 0.001, "window_high": 0.002, "max_force_N": 320.0, "strength_Pa": 40e6,
      "strength_standard_error_Pa": 2e5, "failure_strain": 0.003, "broke": false,
      "strain_rate_per_s": 0.004, "energy_to_failure_J_per_m3": 6e4, "linearity": 0.98,
      "corrections": [{"what": "toe", "detail": "strain shifted"}], "warnings": ["coarse"],
      "unit_doubt": "no bone"},
    "simulated": {
      "modulus_Pa": {"mean": 14e9, "sd": 15e7}, "strength_Pa": {"mean": 42e6, "sd": 43e5},
      "failure_strain": {"mean": 0.0031, "sd": 0.00032}},
    "residual": {"modulus": 1.1, "strength": -1.2, "failure_strain": 1.3},
    "terms": [{
      "term": "strength", "measured": 1.5, "simulated": 2.5, "sd_machine": 0.01,
      "sd_replicates": 0.02, "sd_scatter": 0.03, "sd_specimens": 0.04, "sd_parameters": 0.05,
      "sd": 0.06, "residual": -0.7, "share": 0.8, "bound": true}],
    "replicates": [{
      "seed": 3, "failed": false, "broke": true, "modulus_Pa": 12e9, "strength_Pa": 41e6,
      "failure_strain": 0.0035, "pre_peak": 1.25, "energy": 1.75, "post_peak": 2.25}],
    "influence": [{"parameter": "ratio", "shift": -0.9}],
    "failed_simulations": 5})"_json);
}

TEST(ResultKeys, OfAParameterNameItsNumbers) {
  calib::CalibrationResult result;
  result.parameters = {{.name = "ratio",
                        .unit = "-",
                        .value = 1.5,
                        .standard_error = 0.25,
                        .interval_95 = {1.01, 1.02},
                        .bounds = {0.1, 10.0},
                        .slopes_95 = {1.03, 1.04},
                        .profile_95 = {1.05, 1.06},
                        .bootstrap_95 = {1.07, 1.08},
                        .profile_missing = "flat",
                        .bootstrap_missing = "one specimen",
                        .at_bound = false,
                        .identifiable = true,
                        .left_out_because = "nothing informs it"}};
  EXPECT_EQ(json_of_result(result)["parameters"][0], R"({
    "name": "ratio", "value": 1.5, "unit": "-", "standard_error": 0.25,
    "interval_95": [1.01, 1.02], "slopes_95": [1.03, 1.04], "profile_95": [1.05, 1.06],
    "bootstrap_95": [1.07, 1.08], "profile_missing": "flat", "bootstrap_missing": "one specimen",
    "bounds": [0.1, 10.0], "at_bound": false, "identifiable": true,
    "left_out_because": "nothing informs it"})"_json);
}

TEST(ResultKeys, OfTheSearchNameItsNumbers) {
  calib::CalibrationResult result;
  result.stages = {{"NLopt BOBYQA", 9.5, 8.5, 21, "small steps", 0.75}};
  result.profiles = {{"ratio", {1.0, 2.0}, {3.0, 4.0}, 1.92, {1.1, 1.9}}};
  result.randomness = {.replicates = 4,
                       .replicates_needed = 7,
                       .common_gain = 3.5,
                       .simulator_share = 0.15,
                       .fresh_cost = 8.75,
                       .fresh_shift = 0.35,
                       .fresh_width = 1.15};
  result.confirmations = {{.specimen = "A1",
                           .seed = 11,
                           .strain_rate = 0.005,
                           .failed = false,
                           .strength_limit = 40e6,
                           .strength_in_time = 41e6,
                           .peak_in_time = 42e6,
                           .failure_strain_limit = 0.003,
                           .failure_strain_in_time = 0.004}};
  result.next_tests = {{"one more at 45 deg", {0.6, 0.7}}};
  result.left_out = {{"ratio", "nothing informs it"}};
  const nlohmann::json json = json_of_result(result);
  const nlohmann::json expected = R"({
    "stages": [{"optimiser": "NLopt BOBYQA", "cost_before": 9.5, "cost_after": 8.5,
                "evaluations": 21, "message": "small steps", "wall_s": 0.75}],
    "profiles": [{"parameter": "ratio", "value": [1.0, 2.0], "rise": [3.0, 4.0], "level": 1.92,
                  "interval_95": [1.1, 1.9]}],
    "randomness": {"replicates": 4, "replicates_needed": 7, "common_gain": 3.5,
                   "simulator_share": 0.15, "fresh_cost": 8.75, "fresh_shift": 0.35,
                   "fresh_width": 1.15},
    "confirmations": [{
      "specimen": "A1", "seed": 11, "strain_rate_per_s": 0.005, "failed": false,
      "strength_quasi_static_Pa": 40e6, "strength_in_time_Pa": 41e6, "peak_in_time_Pa": 42e6,
      "failure_strain_quasi_static": 0.003, "failure_strain_in_time": 0.004}],
    "next_tests": [{"what": "one more at 45 deg", "width": [0.6, 0.7]}],
    "left_out": [{"what": "ratio", "why": "nothing informs it"}]})"_json;
  for (const auto& [key, value] : expected.items()) EXPECT_EQ(json[key], value) << key;
}

TEST(ResultKeys, OfTheWholeNameItsNumbers) {
  calib::CalibrationResult result;
  result.notes = {"a doubt"};
  result.fitted = {"young_GPa", "ratio"};
  result.correlation = {{1.0, 0.25}, {0.35, 1.0}};
  result.directions = {"the ratio"};
  result.starts = {3.0, 4.0};
  result.ends = {1.0, 2.0};
  result.cost = 0.5;
  result.specimen_effect = {0.01, 0.02, 0.03};
  result.evaluations = 40;
  result.simulated = 30;
  result.distinct_simulations = 35;
  result.failed_simulations = 6;
  const nlohmann::json json = json_of_result(result);
  const nlohmann::json expected = R"({
    "status": "all_failed", "trusted": false, "notes": ["a doubt"],
    "fitted": ["young_GPa", "ratio"], "correlation": [[1.0, 0.25], [0.35, 1.0]],
    "directions": ["the ratio"], "starts": [3.0, 4.0], "ends": [1.0, 2.0], "cost": 0.5,
    "evaluations": 40, "simulated": 30, "distinct_simulations": 35,
    "failed_simulations": 6})"_json;
  for (const auto& [key, value] : expected.items()) EXPECT_EQ(json[key], value) << key;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(json["specimen_effect"][i], result.specimen_effect.at(i));
}

calib::SectionPorosity measured_section() {
  return {.file = "s.png",
          .pixel_size = 5e-6,
          .method = "half maximum",
          .threshold = 0.45,
          .porosity = 0.05,
          .porosity_standard_error = 0.002,
          .porosity_by_grey = 0.06,
          .pore_count = 21,
          .pore_density = 3e7,
          .pore_area = 4e-12,
          .bone_area = 8e-12,
          .total_area = 16e-12,
          .marrow_area = 2e-12,
          .mean_pore_area = 1e-12,
          .pore_area_sd = 0.5e-12,
          .mean_pore_diameter = 32e-6,
          .pore_diameter_sd = 7e-6,
          .pore_area_ratio = 0.25e-12,
          .window_area = 32e-12,
          .window_sd = 0.11,
          .window_sd_standard_error = 0.012,
          .crack_count = 22,
          .crack_area = 64e-12,
          .speck_count = 23,
          .classes = {{"small", 24, 128e-12}},
          .zones = {{"outer", 0.07, 256e-12}},
          .density = 1900.0,
          .density_residual = 13.0,
          .warnings = {"dark"},
          .doubtful = true};
}

TEST(ResultKeys, OfASectionNameItsNumbers) {
  EXPECT_EQ(porosity_json(measured_section(), 0.4), R"({
    "file": "s.png", "pixel_size_um": 5.0, "method": "half maximum", "threshold": 0.45,
    "porosity": 0.05, "porosity_standard_error": 0.002, "porosity_by_grey": 0.06,
    "pore_count": 21, "pore_density_per_m2": 3e7, "pore_area_um2": 4.0, "bone_area_um2": 8.0,
    "total_area_um2": 16.0, "marrow_area_um2": 2.0, "mean_pore_area_um2": 1.0,
    "pore_area_sd_um2": 0.5, "mean_pore_diameter_um": 32.0, "pore_diameter_sd_um": 7.0,
    "pore_area_ratio_um2": 0.25, "window_area_um2": 32.0, "window_sd": 0.11,
    "window_sd_standard_error": 0.012, "crack_count": 22, "crack_area_um2": 64.0,
    "speck_count": 23, "classes": [{"name": "small", "count": 24, "area_um2": 128.0}],
    "zones": [{"name": "outer", "porosity": 0.07, "bone_area_um2": 256.0}],
    "density_kg_per_m3": 1900.0, "density_residual_kg_per_m3": 13.0, "warnings": ["dark"],
    "doubtful": true, "scatter": 0.4, "missing_joints": 0.0})"_json);
}

TEST(BandFile, HoldsTheColumnsOfTheContract) {
  const test::ScratchFolder folder;
  calib::CurveBand band;
  band.strain = {0.001, 0.002};
  band.median = {3.0, 4.0};
  band.lower = {1.0, 2.0};
  band.upper = {5.0, 6.0};
  band.measured = {7.0, test::nan};
  band.residual = {-4.0, test::nan};
  write_band(folder.path() / "a.csv", band);
  EXPECT_EQ(test::contents(folder.path() / "a.csv"),
            "strain,measured_Pa,simulated_median_Pa,simulated_lower_Pa,simulated_upper_Pa,"
            "residual_Pa\n0.001,7,3,1,5,-4\n0.002,,4,2,6,\n");
}

TEST(MeasuredFile, HoldsTheColumnsOfTheContract) {
  const test::ScratchFolder folder;
  calib::MeasuredTest measured;
  measured.strain = {0.001};
  measured.stress = {13e6};
  write_measured(folder.path() / "a.csv", measured);
  EXPECT_EQ(test::contents(folder.path() / "a.csv"), "strain,stress_Pa\n0.001,13000000\n");
}

TEST(TermsFile, HoldsTheColumnsOfTheContract) {
  const test::ScratchFolder folder;
  write_terms(folder.path() / "terms.csv", {turned_bar()});
  EXPECT_EQ(test::contents(folder.path() / "terms.csv"),
            "specimen,term,measured,simulated,sd_machine,sd_replicates,sd_scatter,sd_specimens,"
            "sd_parameters,sd,residual,share,bound\n"
            "A1,strength,1.5,2.5,0.01,0.02,0.03,0.04,0.05,0.06,-0.7,0.8,1\n");
}

TEST(ReplicatesFile, HoldsTheColumnsOfTheContract) {
  const test::ScratchFolder folder;
  write_replicates(folder.path() / "replicates.csv", {turned_bar()});
  EXPECT_EQ(test::contents(folder.path() / "replicates.csv"),
            "specimen,seed,failed,broke,modulus_Pa,strength_Pa,failure_strain,pre_peak,energy,"
            "post_peak\n"
            "A1,3,0,1,12000000000,41000000,0.0035,1.25,1.75,2.25\n");
}

}  // namespace
}  // namespace havers::io
