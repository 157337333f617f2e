// Which number of a sweep stands in which column and under which key: all are different.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "io/sweep/sweep_files.hpp"
#include "io/sweep/sweep_keys.hpp"
#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

using nlohmann::literals::operator""_json;
using testing::HasSubstr;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

calib::Sweep sweep_of_two_keys() {
  calib::Sweep sweep;
  sweep.name = "Hand-made";
  sweep.plan.keys = {{"joints.scatter", {"0.2"}}, {"joints.distribution", {"weibull"}}};
  calib::SweepPoint point;
  point.values = {"0.2", "weibull"};
  point.numbers = {0.2, unknown};
  point.inertia_number = 0.125;
  sweep.points = {point};
  return sweep;
}

calib::SweepRun run_of(std::uint64_t seed, bool failed, bool broke, const std::string& why) {
  calib::SweepRun run;
  run.seed = seed;
  run.failed = failed;
  run.broke = broke;
  run.why = why;
  run.measures = {1e6, 0.002, 3e9, 0.4, 0.5, 6.0, 7.0, 0.8, unknown};
  if (failed) run.measures.fill(unknown);
  return run;
}

calib::Law fitted_law() {
  calib::Law law;
  law.request = {calib::Measure::strength, {"joints.scatter"}, "joints.ratio"};
  law.at = "3";
  law.status = calib::LawStatus::fitted;
  law.coefficients = {-2e6, 5e6};
  law.standard_errors = {1e5, 2e5};
  law.confidence_factor = 2.5;
  law.residual_sd = 3e5;
  law.explained = 0.75;
  law.runs = 9;
  law.lack_of_fit = 1.25;
  law.lack_of_fit_p = 0.35;
  return law;
}

calib::SweepResult result_of(const calib::Sweep& sweep) {
  calib::SweepResult result;
  result.points = sweep.points;
  result.runs = {run_of(7, false, true, ""), run_of(8, false, false, "a step, given"),
                 run_of(9, true, false, "nothing holds")};
  calib::PointSummary summary{.runs = 30, .failed = 4, .unbroken = 5, .reserved = 6};
  summary.measures[0] = {.n = 16, .mean = 1e6, .sd = 2e4};
  summary.measures[1] = {.n = 4, .mean = 0.002, .sd = 0.0006};
  summary.measures[2] = {.n = 1, .mean = 3e9, .sd = unknown};
  result.summaries = {summary};
  result.strengths = {{.runs = 16,
                       .weibull_modulus = 12.0,
                       .weibull_modulus_95 = {11.0, 13.0},
                       .weibull_scale = 14e5,
                       .gumbel_location = 15e5,
                       .gumbel_width = 16e4,
                       .log_likelihood_gain = 1.7}};
  result.laws = {fitted_law()};
  result.simulated = 20;
  result.failed = 4;
  result.most_failed_because = "nothing holds";
  result.most_reserved_because = "a step was given";
  return result;
}

TEST(SweepRows, OfRunsHoldEachMeasureThatAnyPointTells) {
  const calib::Sweep sweep = sweep_of_two_keys();
  EXPECT_EQ(runs_csv(sweep, result_of(sweep)),
            "point,level,joints.scatter,joints.distribution,seed,outcome,strength_Pa,"
            "failure_strain,modulus_Pa,why\n"
            "0,1,0.2,weibull,7,broken,1000000,0.002,3000000000,\n"
            "0,1,0.2,weibull,8,unbroken,1000000,0.002,3000000000,\"a step, given\"\n"
            "0,1,0.2,weibull,9,failed,,,,nothing holds\n");
}

TEST(SweepRows, OfTheSummaryHoldMeanDeviationAndError) {
  const calib::Sweep sweep = sweep_of_two_keys();
  EXPECT_EQ(summary_csv(sweep, result_of(sweep)),
            "point,level,joints.scatter,joints.distribution,inertia_number,measure,n,mean,sd,"
            "standard_error\n"
            "0,1,0.2,weibull,0.125,strength_Pa,16,1000000,20000,5000\n"
            "0,1,0.2,weibull,0.125,failure_strain,4,0.002,0.0006,0.0003\n"
            "0,1,0.2,weibull,0.125,modulus_Pa,1,3000000000,,\n");
}

TEST(SweepMeasures, CarryTheirUnitInTheirNames) {
  std::vector<std::string> names;
  for (const calib::Measure m : calib::all_measures) names.push_back(name_of(m));
  EXPECT_THAT(names, testing::ElementsAre("strength_Pa", "failure_strain", "modulus_Pa",
                                          "linear_part", "fall_part", "head_tail_broken",
                                          "flank_broken", "crack_span", "crack_linked"));
}

TEST(SweepJson, NamesItsNumbers) {
  const calib::Sweep sweep = sweep_of_two_keys();
  nlohmann::json json = sweep_json(sweep, result_of(sweep));
  EXPECT_EQ(json["scene"]["assembly"]["layers"], sweep.points[0].scene.assembly.layers);
  json.erase("scene");
  const nlohmann::json expected = R"({
    "name": "Hand-made", "trusted": false, "evaluations": 3, "simulated": 20,
    "failed_simulations": 4, "most_failed_because": "nothing holds",
    "most_reserved_because": "a step was given", "findings": [],
    "points": [{
      "level": 1, "keys": {"joints.scatter": 0.2, "joints.distribution": "weibull"},
      "inertia_number": 0.125, "runs": 30, "failed": 4, "unbroken": 5, "with_reservation": 6,
      "measures": {
        "strength_Pa": {"n": 16, "mean": 1e6, "sd": 2e4, "standard_error": 5e3},
        "failure_strain": {"n": 4, "mean": 0.002, "sd": 0.0006, "standard_error": 0.0003},
        "modulus_Pa": {"n": 1, "mean": 3e9, "sd": null, "standard_error": null}},
      "strength_law": {
        "runs": 16, "weibull_modulus": 12.0, "weibull_modulus_95": [11.0, 13.0],
        "weibull_scale_Pa": 14e5, "gumbel_location_Pa": 15e5, "gumbel_width_Pa": 16e4,
        "log_likelihood_gain": 1.7}}],
    "laws": [{
      "response": "strength", "per": "joints.ratio", "at": "3", "status": "fitted",
      "terms": ["joints.scatter"], "coefficients": [-2e6, 5e6], "standard_errors": [1e5, 2e5],
      "confidence_factor_95": 2.5, "residual_sd": 3e5, "r_squared": 0.75, "runs": 9,
      "lack_of_fit_F": 1.25, "lack_of_fit_p": 0.35}]})"_json;
  EXPECT_EQ(json, expected);
}

TEST(SweepJson, NamesTheNumbersOfAFinding) {
  const calib::Sweep sweep = sweep_of_two_keys();
  calib::SweepResult result = result_of(sweep);
  calib::Finding finding{.id = "A", .claim = "it falls", .per = "joints.ratio", .at = "3"};
  finding.test = calib::FindingTest::falls;
  finding.response = calib::Measure::modulus;
  finding.outcome = calib::FindingOutcome::disagrees;
  finding.value = 0.2;
  finding.low = 0.1;
  finding.high = 0.3;
  finding.compared = {{"joints.scatter", "0.8", "0.2"}};
  finding.ground = "as asked";
  finding.meaning = "so it is not";
  finding.comparisons = 11;
  finding.runs = 12;
  finding.inertia_low = 0.01;
  finding.inertia_high = 0.02;
  result.findings = {finding};
  EXPECT_EQ(sweep_json(sweep, result)["findings"][0], R"({
    "id": "A", "claim": "it falls", "per": "joints.ratio", "at": "3", "test": "falls",
    "response": "modulus", "outcome": "disagrees", "value": 0.2, "low": 0.1, "high": 0.3,
    "what": "joints.scatter = 0.8 against 0.2", "ground": "as asked", "meaning": "so it is not",
    "comparisons": 11, "runs": 12, "inertia_low": 0.01, "inertia_high": 0.02})"_json);
}

// What laws.json says with one law of its own, changed by a patch.
nlohmann::json laws_with(const nlohmann::json& patch) {
  const calib::Sweep sweep = sweep_of_two_keys();
  nlohmann::json laws = laws_json(result_of(sweep));
  laws["laws"][0].merge_patch(patch);
  return laws;
}

TEST(Laws, AreReadWithTheirPlaceAndNumbers) {
  const test::ScratchFolder folder;
  const auto laws =
      read_laws(folder.write("laws.json", laws_with(nlohmann::json::object()).dump()));
  ASSERT_EQ(laws.size(), 1U);
  EXPECT_EQ(laws[0].per, "joints.ratio");
  EXPECT_EQ(laws[0].at, 3.0);
  EXPECT_THAT(laws[0].terms, testing::ElementsAre("joints.scatter"));
  EXPECT_THAT(laws[0].coefficients, testing::ElementsAre(-2e6, 5e6));
}

TEST(Laws, ThatNoSpecimenCanBePutIntoAreRefused) {
  const test::ScratchFolder folder;
  for (const nlohmann::json& patch :
       {R"({"terms": ["loading.strain_rate_per_s"]})"_json, R"({"per": "assembly.layers"})"_json,
        R"({"coefficients": [5e6]})"_json, R"({"coefficients": [5e6, 1e6, 1e5]})"_json,
        R"({"response": "modulus"})"_json, R"({"status": "unbroken_runs"})"_json}) {
    const auto file = folder.write("laws.json", laws_with(patch).dump());
    EXPECT_THAT(test::refusal_of([&] { read_laws(file); }), HasSubstr("has no law of strength"))
        << patch;
  }
}

TEST(Laws, ArePerOrientationOrForAllToo) {
  const test::ScratchFolder folder;
  for (const nlohmann::json& patch :
       {R"({"per": "assembly.orientation_deg"})"_json, R"({"per": "", "at": ""})"_json,
        R"({"terms": ["joints.ratio"]})"_json})
    EXPECT_EQ(read_laws(folder.write("laws.json", laws_with(patch).dump())).size(), 1U) << patch;
}

}  // namespace
}  // namespace havers::io
