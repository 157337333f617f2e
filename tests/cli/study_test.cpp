// synthesize and fit on a study that is small enough for a test.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::replaced_once;
using test::run_havers;
using testing::HasSubstr;

TEST(Synthesize, MakesTheSameFilesForTheSameSeedAndOthersForAnother) {
  const fs::path folder = test::folder_with_study();
  for (const char* arguments :
       {"-o one --seed 3 --threads 1", "-o two --seed 3 --threads 2", "-o three --seed 4"})
    ASSERT_EQ(run_havers(folder, std::string("synthesize study.toml ") + arguments).exit_code, 0);
  for (const char* file : {"B0.csv", "B90.csv", "truth.json", "study.toml"})
    EXPECT_EQ(test::contents(folder / "one" / file), test::contents(folder / "two" / file)) << file;
  EXPECT_NE(test::contents(folder / "one/B0.csv"), test::contents(folder / "three/B0.csv"));
}

TEST(Synthesize, KeepsTheStudyAsItIsWhenTheTruthIsSetApart) {
  const fs::path folder = test::folder_with_study();
  ASSERT_EQ(run_havers(folder, "synthesize study.toml -o made --set model.material.young_GPa=17")
                .exit_code,
            0);
  EXPECT_EQ(test::contents(folder / "made/study.toml"), test::small_study());
  const auto truth = nlohmann::json::parse(test::contents(folder / "made/truth.json"));
  EXPECT_EQ(truth["parameters"]["young_GPa"], 17.0);
}

TEST(Synthesize, RefusesFilesOutsideTheStudysFolder) {
  // Of what is named from elsewhere the copy would find the original.
  const fs::path folder = test::folder_with_study();
  for (const std::string& name :
       {std::string("../B0.csv"), (folder / "B0.csv").string(),
        "../" + folder.filename().string() + "/B0.csv", std::string("tests/../B0.csv")}) {
    test::write_text(folder / "study.toml", replaced_once(test::small_study(), "B0.csv", name));
    const auto answer = run_havers(folder, "synthesize study.toml -o made");
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_THAT(answer.err, HasSubstr("names " + name + ", which may lie outside its folder"));
    EXPECT_FALSE(fs::exists(folder / "made"));
  }
  test::write_text(folder / "study.toml", test::small_study() + "gauge = \"../gauge.csv\"\n");
  EXPECT_THAT(run_havers(folder, "synthesize study.toml -o made").err,
              HasSubstr("names ../gauge.csv, which may lie outside its folder"));
}

TEST(Synthesize, RefusesFilesInThePlaceOfItsOwn) {
  const fs::path folder = test::folder_with_study();
  for (const std::string name : {"truth.json", "study.toml"}) {
    test::write_text(folder / "study.toml", replaced_once(test::small_study(), "B0.csv", name));
    const auto answer = run_havers(folder, "synthesize study.toml -o made");
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_THAT(answer.err, HasSubstr(name + ": would be made twice"));
  }
  test::write_text(folder / "study.toml", test::small_study() + "gauge = \"B0.csv\"\n");
  EXPECT_THAT(run_havers(folder, "synthesize study.toml -o made").err,
              HasSubstr("B0.csv: would be made twice"));
}

TEST(Synthesize, RefusesPorosityThatASectionCannotHold) {
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const fs::path folder = test::folder_with_study();
  test::write_text(folder / "study.toml",
                   test::small_study() + "sections = [\"s.png\"]\nporosity = 0.7\n");
  const auto answer =
      run_havers(folder, "synthesize study.toml -o made --set synthesize.section_pixels=128");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "made"));
  EXPECT_THAT(answer.err, HasSubstr("has porosity 0.7, of which"));
}

TEST(Synthesize, RefusesWhatItDoesNotMake) {
  const fs::path folder = test::folder_with_study();
  test::write_text(folder / "study.toml",
                   test::small_study() +
                       "mask = \"m.png\"\n"
                       "specimen_in_file = 2\ncolumns.force_unit = \"kN\"\n"
                       "gauge = \"g.csv\"\ngauge_columns.strain_unit = \"%\"\n");
  const auto answer = run_havers(folder, "synthesize study.toml -o made");
  EXPECT_EQ(answer.exit_code, 2);
  for (const char* key : {"gauge_columns", "a mask", "specimen_in_file", "columns"})
    EXPECT_THAT(answer.err,
                HasSubstr("study.toml: specimen B90: has " + std::string(key) + ", which is"));
  EXPECT_FALSE(fs::exists(folder / "made"));
}

// `import` finds the clocks and the modulus that the truth has.
TEST(Synthesize, MakesTheGaugesOfASecondLogger) {
  const fs::path folder = test::folder_with_study();
  const std::string study = replaced_once(test::small_study(), "test = \"B90.csv\"",
                                          "test = \"B90.csv\"\ngauge = \"gauges/B90.csv\"");
  test::write_text(folder / "study.toml", study);
  const auto made = run_havers(folder, "synthesize study.toml -o made");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_EQ(run_havers(folder, "check made/study.toml").exit_code, 0);
  EXPECT_THAT(test::contents(folder / "made/B90.csv"), testing::Not(HasSubstr("strain")));
  const auto truth = nlohmann::json::parse(test::contents(folder / "made/truth.json"));
  EXPECT_FALSE(truth["specimens"][0].contains("gauge_clock_at_first_row_s"));
  const auto& specimen = truth["specimens"][1];
  const auto read = nlohmann::json::parse(
      run_havers(folder, "import made/B90.csv --gauge made/gauges/B90.csv --json").out);
  EXPECT_EQ(read["specimen_id"], "B90");
  const auto& clocks = read["clocks"];
  EXPECT_NEAR(
      clocks["machine_time_at_reference_s"].get<double>(),
      clocks["reference_s"].get<double>() - specimen["gauge_clock_at_first_row_s"].get<double>(),
      4.0 * clocks["machine_time_standard_error_s"].get<double>());
  EXPECT_LT(clocks["machine_time_standard_error_s"].get<double>(), 0.02) << "a row's time";
  EXPECT_NEAR(read["modulus_Pa"].get<double>(), specimen["modulus_Pa"].get<double>(),
              4.0 * read["modulus_standard_error_Pa"].get<double>());
  EXPECT_NEAR(read["failure_strain"].get<double>() / specimen["failure_strain"].get<double>(), 1.0,
              0.05);
}

TEST(Synthesize, WritesNoBreakThatTheModelDidNotHave) {
  const fs::path folder = test::folder_with_study();
  const std::vector<std::pair<std::string, std::string>> cases{
      {"model.loading.max_strain=0.002",
       "specimen B0: does not break within model.loading.max_strain = 0.2 %: raise it\n"},
      {"model.joints.missing=0.99", "specimen B0: missing joints leave nothing that bears"}};
  for (const auto& [setting, sentence] : cases) {
    const auto answer = run_havers(folder, "synthesize study.toml -o made --set " + setting);
    EXPECT_EQ(answer.exit_code, 1);
    EXPECT_TRUE(answer.err.starts_with(sentence)) << answer.err;
    EXPECT_FALSE(fs::exists(folder / "made"));
  }
}

// A preload beyond the strength leaves rows after the break alone.
TEST(Synthesize, SaysWhichTestsNoFitCanUse) {
  const fs::path folder = test::folder_with_study();
  const auto answer =
      run_havers(folder, "synthesize study.toml -o made --set synthesize.preload_N=150");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.err, HasSubstr("note: specimen B90: no test for a fit: 5 rows are too few"));
  EXPECT_THAT(answer.err, testing::Not(HasSubstr("specimen B0:")));
}

TEST(Synthesize, BringsTheLawsOfTheStudyAlong) {
  const fs::path folder = test::folder_with_study();
  const std::string laws = R"({"laws": [{"response": "strength", "status": "fitted",
    "terms": ["joints.scatter"], "coefficients": [1.0, 2.0]}]})";
  fs::create_directories(folder / "sweep");
  test::write_text(folder / "sweep/laws.json", laws);
  const std::string study = replaced_once(test::small_study(), "[calibrate]\n",
                                          "[calibrate]\nlaws = \"sweep/laws.json\"\n");
  test::write_text(folder / "study.toml", study);
  ASSERT_EQ(run_havers(folder, "synthesize study.toml -o made").exit_code, 0);
  EXPECT_EQ(test::contents(folder / "made/sweep/laws.json"), laws);
  EXPECT_EQ(run_havers(folder, "check made/study.toml").exit_code, 0);

  fs::create_directories(folder / "deep");
  test::write_text(folder / "deep/study.toml", replaced_once(study, "sweep/laws", "../sweep/laws"));
  const auto outside = run_havers(folder, "synthesize deep/study.toml -o again");
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_THAT(outside.err, HasSubstr("outside"));
}

TEST(Fit, WritesItsFilesAndResumesOnlyWhatHasNoResult) {
  const fs::path folder = test::folder_with_study();
  ASSERT_EQ(run_havers(folder, "synthesize study.toml -o made --set model.material.young_GPa=16")
                .exit_code,
            0);
  const auto first = run_havers(folder, "fit made/study.toml -o out --json");
  ASSERT_NE(first.exit_code, 2) << first.err;
  const auto result = nlohmann::json::parse(first.out);
  EXPECT_EQ(first.exit_code, result["trusted"].get<bool>() ? 0 : 1);
  EXPECT_NEAR(result["parameters"][0]["value"].get<double>(), 16.0, 0.3);
  EXPECT_EQ(result["provenance"]["inputs"].size(), 3U) << "the study and its tests";
  for (const char* file : {"curves/B0.csv", "curves/B90.csv", "evaluations.sqlite", "result.json"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;

  EXPECT_EQ(run_havers(folder, "fit made/study.toml -o out").exit_code, 2)
      << "a result is not replaced unasked";
  fs::remove(folder / "out/result.json");
  const auto resumed = run_havers(folder, "fit made/study.toml -o out --json");
  EXPECT_EQ(resumed.exit_code, first.exit_code) << resumed.err;
  EXPECT_EQ(nlohmann::json::parse(resumed.out)["parameters"], result["parameters"]);
}

TEST(Fit, GivesTheSameAnswerAgainAndForAnyNumberOfThreads) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_tests();
  nlohmann::json first;
  for (const std::string threads : {"1", "1", "2", "4"}) {
    SCOPED_TRACE("on " + threads);
    const auto answer =
        run_havers(folder, "fit made/study.toml -o out --force --json --threads " + threads);
    ASSERT_NE(answer.exit_code, 2) << answer.err;
    const auto result = nlohmann::json::parse(answer.out);
    fs::remove(folder / "out/evaluations.sqlite");  // what is kept would answer for the next
    if (first.empty()) first = result;
    EXPECT_GT(result["simulated"], 0);
    for (const char* key : {"verdict", "parameters", "specimens", "cost", "evaluations", "scene"})
      EXPECT_EQ(result[key], first[key]) << key;
  }
}

TEST(Fit, ReportsTheProblemsOfAllFilesAtOnceAndWritesNothing) {
  const fs::path folder = test::folder_with_study();
  test::write_text(folder / "B0.csv", "");
  test::write_text(folder / "B90.csv", "not a test\n");
  const auto answer = run_havers(folder, "fit study.toml -o out");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("B0.csv"));
  EXPECT_THAT(answer.err, HasSubstr("B90.csv"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

// At the model's own rate there are few.
TEST(Fit, RefusesStepsThatAreTooManyAtTheRateOfATest) {
  const fs::path folder = test::folder_with_tests();
  const std::string settings =
      " made/study.toml --set model.solver.regime=dynamic --set model.solver.step_s=2e-8 --set "
      "model.loading.strain_rate_per_s=1000";
  for (const std::string command : {"check", "fit -o out", "synthesize -o out"}) {
    const auto answer = run_havers(folder, command + settings);
    EXPECT_EQ(answer.exit_code, 2) << answer.out;
    EXPECT_THAT(answer.err, HasSubstr("made/study.toml: model.solver.step_s: is 2e-08: a strain"));
    EXPECT_THAT(answer.err, HasSubstr("steps away (as specimen B0 is tested) (leave step_s out"));
  }
}

// The object that --json promises, of runs that have no result.
TEST(Json, SaysHowARunEndedThatLeavesNothing) {
  const fs::path folder = test::folder_with_study();
  const auto failed = run_havers(folder,
                                 "synthesize study.toml -o made --json --set "
                                 "model.solver.regime=dynamic --set model.solver.max_iterations=1 "
                                 "--set model.solver.contact=gauss-seidel --set "
                                 "model.loading.strain_rate_per_s=1000");
  ASSERT_EQ(failed.exit_code, 1) << failed.err;
  const auto answer = nlohmann::json::parse(failed.out);
  EXPECT_EQ(answer["status"], "failed");
  EXPECT_EQ(answer["trusted"], false);
  EXPECT_THAT(failed.err, HasSubstr("nothing was written"));
}

// Into "out", with what it says in "said" and "why".
test::Answer stopped_fit(const fs::path& folder) {
  return run_havers(
      folder, "-h >help; '" HAVERS_PROGRAM
              "' fit made/study.toml -o out --json --set calibrate.options.replicates=20 >said "
              "2>why & "
              "for i in $(seq 1000); do [ -e out/.run ] && break; sleep 0.01; done; "
              "kill $!; wait $! #");
}

TEST(Json, SaysThatAFitWasCancelled) {
  const fs::path folder = test::folder_with_tests();
  EXPECT_EQ(stopped_fit(folder).exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(test::contents(folder / "said"))["status"], "cancelled");
  EXPECT_FALSE(fs::exists(folder / "out/result.json"));
}

// Its simulations would serve no other study, and its folder hold another one's results.
TEST(Fit, ThatWasStoppedGoesOnWithItsOwnStudyAlone) {
  const fs::path folder = test::folder_with_tests();
  fs::copy(folder / "made", folder / "other");
  ASSERT_EQ(stopped_fit(folder).exit_code, 1);

  const std::string holds =
      "out: holds an unfinished fit of " + fs::canonical(folder / "made/study.toml").string();
  for (const char* command : {"fit other/study.toml -o out", "sweep sweep.toml -o out"}) {
    test::write_text(folder / "sweep.toml",
                     "[sweep]\n[sweep.keys]\n\"joints.scatter\" = [0.1]\n" + test::small_scene());
    const auto refused = run_havers(folder, command);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr(holds)) << command;
  }
  const auto report = run_havers(folder, "report out");
  EXPECT_EQ(report.exit_code, 2);
  EXPECT_THAT(report.err,
              testing::AnyOf(HasSubstr("out: has no result yet"), HasSubstr("makes no pages")));

  const auto same = run_havers(folder, "fit made/study.toml -o out");
  EXPECT_NE(same.exit_code, 2) << same.err;
  EXPECT_THAT(same.err, HasSubstr("going on with the simulations kept in out"));
  EXPECT_FALSE(fs::exists(folder / "out/.run"));
}

}  // namespace
}  // namespace havers
