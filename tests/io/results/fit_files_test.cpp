#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "io/results/result_files.hpp"
#include "tests/io/complaints.hpp"
#include "tests/support/results.hpp"

namespace havers::io {
namespace {

using testing::HasSubstr;
using testing::Pointwise;

// As havers fit leaves it: result.json, and the curves beside it.
void write_folder(const test::ScratchFolder& folder, const test::FitSample& fit,
                  const calib::Provenance& provenance) {
  folder.write("result.json", calibration_json(fit.study, fit.result, provenance).dump(2));
  std::filesystem::create_directories(folder.path() / "curves");
  for (const calib::SpecimenResult& specimen : fit.result.specimens) {
    write_band(folder.path() / band_file(specimen.id), specimen.band);
    write_measured(folder.path() / measured_file(specimen.id), specimen.measured);
  }
}

test::FitSample sample() {
  test::FitSample fit = test::fit_sample();
  fit.study.calibrate.automatic = true;
  fit.study.calibrate.bounds["young_GPa"] = {5.0, 30.0};
  fit.study.calibrate.level["ratio"] = calib::Level::specimen;
  fit.study.calibrate.budget = 77;
  fit.study.porosity.to_modulus = calib::ToModulus::power;
  fit.study.porosity.linear_slope = 0.3;
  fit.study.model.material.poisson = 0.31;
  fit.result.scene.material.young = 13.1234e9;
  fit.result.specimen_effect = {0.01, 0.02, 0.03};
  fit.result.distinct_simulations = 99;
  return fit;
}

TEST(FitFolder, GivesBackTheWholeResult) {
  const test::ScratchFolder folder;
  test::FitSample fit = sample();
  fit.study.specimens.at(0).sections.at(0).doubtful = true;
  calib::Provenance provenance;
  provenance.command = "havers fit study.toml -o r";
  provenance.havers = "9.9.9";
  provenance.inputs = {{"study.toml", "abcd"}};
  provenance.wall_seconds = 4.5;
  write_folder(folder, fit, provenance);
  const FitFolder again = read_fit_folder(folder.path());

  // All that result.json holds is there again, to the last digit; the curves are looked at below.
  EXPECT_EQ(calibration_json(again.study, again.result, again.provenance),
            calibration_json(fit.study, fit.result, provenance));
  EXPECT_EQ(again.provenance.havers, "9.9.9");
  EXPECT_EQ(again.study.name, "bovine femur A");
  EXPECT_EQ(again.study.calibrate.bounds.at("young_GPa").second, 30.0);
  EXPECT_EQ(again.study.calibrate.level.at("ratio"), calib::Level::specimen);
  EXPECT_EQ(again.study.calibrate.budget, 77);
  EXPECT_EQ(again.study.model.material.poisson, 0.31);
  EXPECT_EQ(again.study.porosity.to_modulus, calib::ToModulus::power);
  EXPECT_EQ(again.result.scene.material.young, 13.1234e9);
  EXPECT_EQ(again.result.status, calib::CalibrationStatus::converged);
  EXPECT_EQ(again.result.verdict.at(3).outcome, calib::Outcome::warn);
  EXPECT_EQ(again.result.parameters.at(0).interval_95[1], 13.2974);
  EXPECT_TRUE(std::isnan(again.result.parameters.at(2).standard_error));
  EXPECT_EQ(again.result.stages.at(1).optimiser, "Ceres Levenberg-Marquardt");
  EXPECT_EQ(again.result.stages.at(1).wall_seconds, 6.25);
  EXPECT_EQ(again.study.specimens.at(0).sections.at(0).pore_area, 3.1e-7);
  EXPECT_TRUE(again.study.specimens.at(0).sections.at(0).doubtful);
}

TEST(FitFolder, GivesBackTheCurves) {
  const test::ScratchFolder folder;
  const test::FitSample fit = sample();
  write_folder(folder, fit, {});
  const FitFolder again = read_fit_folder(folder.path());
  ASSERT_EQ(again.result.specimens.size(), fit.result.specimens.size());
  for (std::size_t i = 0; i < fit.result.specimens.size(); ++i) {
    const calib::SpecimenResult& before = fit.result.specimens[i];
    const calib::SpecimenResult& after = again.result.specimens[i];
    EXPECT_THAT(after.band.strain, Pointwise(testing::Eq(), before.band.strain));
    EXPECT_THAT(after.band.median, Pointwise(testing::Eq(), before.band.median));
    EXPECT_THAT(after.band.lower, Pointwise(testing::Eq(), before.band.lower));
    EXPECT_THAT(after.band.upper, Pointwise(testing::Eq(), before.band.upper));
    EXPECT_THAT(after.band.measured,
                Pointwise(testing::NanSensitiveDoubleEq(), before.band.measured));
    EXPECT_THAT(after.band.residual,
                Pointwise(testing::NanSensitiveDoubleEq(), before.band.residual));
    EXPECT_THAT(after.measured.strain, Pointwise(testing::Eq(), before.measured.strain));
    EXPECT_THAT(after.measured.stress, Pointwise(testing::Eq(), before.measured.stress));
    EXPECT_EQ(again.study.specimens[i].test.stress.size(), before.measured.stress.size());
  }
}

TEST(CalibrationJson, HoldsTheKeysOfTheContract) {
  const test::FitSample fit = sample();
  calib::Provenance provenance;
  provenance.command = "havers fit";
  provenance.wall_seconds = 4.5;
  const nlohmann::json json = calibration_json(fit.study, fit.result, provenance);
  EXPECT_EQ(json["status"], "converged");
  EXPECT_EQ(json["trusted"], fit.result.trusted());
  EXPECT_EQ(json["verdict"][3], (nlohmann::json{{"check", "failed simulations"},
                                                {"outcome", "warn"},
                                                {"text", "12 of 4128 simulations failed"},
                                                {"done", true}}));
  EXPECT_TRUE(json["parameters"][2]["interval_95"][0].is_null());
  EXPECT_EQ(json["wall_s"], 4.5);
  EXPECT_EQ(json["scene"]["material"]["young_GPa"], 13.1234);
  EXPECT_EQ(json["scene"]["joints"]["reinforced_boundary"], true);  // the default at 0°, filled in
}

TEST(CalibrationJson, SpellsStatusesAndOutcomes) {
  test::FitSample fit = sample();
  using enum calib::CalibrationStatus;
  for (const auto& [status, word] :
       {std::pair(converged, "converged"), std::pair(budget_spent, "budget_spent"),
        std::pair(all_failed, "all_failed"), std::pair(nothing_to_fit, "nothing_to_fit"),
        std::pair(cancelled, "cancelled")}) {
    fit.result.status = status;
    EXPECT_EQ(calibration_json(fit.study, fit.result, {})["status"], word);
  }
  // As on the page.
  for (const auto outcome : {calib::Outcome::pass, calib::Outcome::warn, calib::Outcome::fail}) {
    fit.result.verdict[0].outcome = outcome;
    EXPECT_EQ(calibration_json(fit.study, fit.result, {})["verdict"][0]["outcome"],
              to_string(outcome));
  }
}

TEST(FitFolder, SaysWhatIsWrongWithAFolder) {
  const test::ScratchFolder folder;
  const auto refusal = [&] { return test::refusal_of([&] { read_fit_folder(folder.path()); }); };
  EXPECT_THAT(refusal(),
              HasSubstr("result.json: is not there (name a fit's folder or its result.json)"));
  folder.write("result.json", "{ \"verdict\": ");
  EXPECT_THAT(refusal(),
              HasSubstr("result.json: is not JSON (name a fit's folder or its result.json)"));
  folder.write("result.json", R"({"status": "broken"})");
  EXPECT_THAT(refusal(),
              HasSubstr("result.json: is not the result of a fit (havers fit STUDY.toml"));
  folder.write("result.json", R"({"verdict": [], "study": {}, "status": 3})");
  EXPECT_THAT(refusal(), HasSubstr("result.json: lacks what the result of a fit has, or has "
                                   "it otherwise (run the fit again"));
  write_folder(folder, sample(), {});
  std::filesystem::remove(folder.path() / "curves/A1.csv");
  EXPECT_THAT(refusal(), HasSubstr("A1.csv: is not there"));
  test::FitSample shorter = sample(), nameless = sample();
  shorter.result.fitted = {"ratio"};
  shorter.result.correlation = {{1.0, 0.0}, {0.0, 1.0}};
  nameless.result.parameters[0].name = "";
  for (const test::FitSample& fit : {shorter, nameless}) {
    write_folder(folder, fit, {});
    EXPECT_THAT(refusal(), HasSubstr("result.json: lacks what the result of a fit has"));
  }
}

TEST(ImportJson, HoldsTheKeysOfTheContract) {
  TestFile file;
  file.file = "A1.csv";
  file.encoding = "UTF-8";
  file.delimiter = ",";
  file.decimal = ".";
  file.columns = {{"Load", "N", Quantity::force}};
  file.rows = 3000;
  file.test = test::raw_test(13e9, 40e6, 1);
  file.test.warnings = {"first"};
  calib::Reduction reduction;
  reduction.test = test::measured_test(13e9, 40e6, 1);
  reduction.test.warnings = {"second"};
  const nlohmann::json json = import_json(file, reduction);
  EXPECT_EQ(json["columns"],
            (nlohmann::json::array({{{"name", "Load"}, {"unit", "N"}, {"quantity", "force"}}})));
  EXPECT_EQ(json["specimen_id"], "A1");
  EXPECT_EQ(json["width_m"], 4e-3);
  EXPECT_EQ(json["area_m2"], 8e-6);
  EXPECT_EQ(json["strength_Pa"], 40e6);
  EXPECT_EQ(json["max_force_N"], 320.0);
  EXPECT_EQ(json["warnings"].back(), "second");
  for (const char* key :
       {"file", "encoding", "delimiter", "decimal", "rows", "thickness_m", "gauge_length_m",
        "modulus_Pa", "modulus_standard_error_Pa", "failure_strain"})
    EXPECT_TRUE(json.contains(key)) << key;
  file.test.width.reset();
  EXPECT_TRUE(import_json(file, reduction)["width_m"].is_null());
}

TEST(ImportJson, TellsAZeroFromWhatIsNotKnown) {
  calib::Reduction reduction{.test = test::measured_test(13e9, 40e6, 1)};
  reduction.test.modulus_standard_error = reduction.test.window_low = 0.0;
  reduction.test.strain_rate = 0.0;  // without time
  const nlohmann::json json = import_json(TestFile{}, reduction);
  EXPECT_EQ(json["modulus_standard_error_Pa"], 0.0);
  EXPECT_EQ(json["window_low"], 0.0);
  EXPECT_TRUE(json["strain_rate_per_s"].is_null());
  reduction.problems = {"no modulus"};
  EXPECT_TRUE(import_json(TestFile{}, reduction)["modulus_standard_error_Pa"].is_null());
}

// (K5) Of pores that take joints away no fit would use a scatter.
TEST(PorosityJson, HasNoScatterWherePoresTakeJointsAway) {
  calib::SectionPorosity section = test::section_sample("s.png");
  section.window_area = 1e-9;
  section.pore_area_ratio = 2e-9;
  EXPECT_TRUE(porosity_json(section, 0.4)["scatter"].is_null());
  EXPECT_EQ(porosity_json(section, 0.4)["missing_joints"], 0.048);
  EXPECT_TRUE(mean_porosity_json(calib::pool_sections({section}))["scatter"].is_null());
}

}  // namespace
}  // namespace havers::io
