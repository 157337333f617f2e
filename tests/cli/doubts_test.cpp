// Studies that can be read and are hardly meant so, and tests that did not end in a break.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/machine/read_test.hpp"
#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::folder_with_tests;
using test::own_folder;
using test::replaced_once;
using test::run_havers;
using testing::HasSubstr;

// As if the machine had been stopped at a part of the strength.
void stop(const fs::path& file, double part) {
  calib::RawTest raw = io::read_test(file).test;
  const double most = part * std::ranges::max(raw.force);
  const auto rows = static_cast<std::size_t>(
      std::ranges::find_if(raw.force, [&](double f) { return f >= most; }) - raw.force.begin());
  for (auto* channel : {&raw.time, &raw.force, &raw.extension, &raw.strain, &raw.stress})
    channel->resize(std::min(channel->size(), rows));
  io::write_bluehill(file, raw);
}

TEST(StoppedTest, IsSaidToBeNoneThatBroke) {
  const fs::path folder = folder_with_tests();
  stop(folder / "made/B0.csv", 0.6);
  EXPECT_THAT(run_havers(folder, "import made/B0.csv").out,
              testing::AllOf(HasSubstr("strength at least "), HasSubstr("no break was seen")));
  const auto json = nlohmann::json::parse(run_havers(folder, "import made/B0.csv --json").out);
  EXPECT_EQ(json["broke"], false);
  const auto checked = run_havers(folder, "check made/study.toml");
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_THAT(checked.out, HasSubstr("B0.csv: no break was seen"));
}

// At 0.6 of its strength nothing had failed: the other specimen tells the strength of the joints.
TEST(StoppedTest, IsALowerBoundOfTheFit) {
  HAVERS_SLOW;
  const fs::path folder = folder_with_tests();
  stop(folder / "made/B0.csv", 0.6);
  const auto fitted = [&](const std::string& study, const std::string& output) {
    const auto answer = run_havers(folder, "fit made/" + study + " -o " + output + " --json");
    EXPECT_NE(answer.exit_code, 2) << answer.err;
    return nlohmann::json::parse(answer.out);
  };
  const auto result = fitted("study.toml", "out");
  EXPECT_EQ(result["specimens"][0]["measured"]["broke"], false);
  EXPECT_EQ(result["specimens"][1]["measured"]["broke"], true);
  EXPECT_NEAR(result["parameters"][1]["value"].get<double>(), 80.0, 8.0);

  test::write_text(folder / "made/broke.toml", replaced_once(test::small_study(), "id = \"B0\"\n",
                                                             "id = \"B0\"\nbroke = true\n"));
  const auto pulled = fitted("broke.toml", "pulled");
  EXPECT_EQ(pulled["specimens"][0]["measured"]["broke"], true);
  EXPECT_LT(pulled["parameters"][1]["value"].get<double>(), 72.0);
}

// Neither passed nor failed; and what was left out is counted when all is done.
TEST(FitSummary, TicksNoCheckThatWasNotDoneAndCountsSimulationsOnce) {
  HAVERS_SLOW;
  const fs::path folder = folder_with_tests();
  const auto answer = run_havers(folder, "fit made/study.toml -o out -v");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out, HasSubstr("\n  -    held-out specimens: Not checked"));
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  ASSERT_FALSE(result["left_out"].empty());
  for (const auto& one : result["left_out"])
    EXPECT_THAT(answer.out,
                HasSubstr(fmt::format("\nleft out: {}: {}\n", one["what"].get<std::string>(),
                                      one["why"].get<std::string>())));
  EXPECT_THAT(result["left_out"].dump(),
              HasSubstr(fmt::format(" of {} simulations", result["evaluations"].get<long>())));
}

TEST(Check, DoubtsExchangedTestsAndAnglesInRadians) {
  const fs::path folder = folder_with_tests();
  fs::rename(folder / "made/B0.csv", folder / "made/other.csv");
  fs::rename(folder / "made/B90.csv", folder / "made/B0.csv");
  fs::rename(folder / "made/other.csv", folder / "made/B90.csv");
  test::write_text(
      folder / "made/study.toml",
      replaced_once(test::small_study(), "orientation_deg = 90", "orientation_deg = 1.571"));
  const auto checked = run_havers(folder, "check made/study.toml");
  EXPECT_THAT(checked.out, HasSubstr("B0.csv is of specimen B90 by its own words, and specimen B0 "
                                     "has it: are two exchanged?"));
  EXPECT_THAT(checked.out, HasSubstr("the largest is 1.571: were radians meant?"));
}

// The page's first line and the terminal's say the same.
TEST(FitSummary, NamesTheChecksThatFailed) {
  HAVERS_SLOW;
  const fs::path folder = folder_with_tests();
  const auto answer =
      run_havers(folder, "fit made/study.toml -o out --set model.loading.max_strain=0.0002");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.out, testing::StartsWith("NOT to be trusted: "));
  EXPECT_THAT(answer.out, testing::Not(HasSubstr("\nleft out: ")));  // but by -v
  EXPECT_THAT(answer.out, HasSubstr(" checks failed (simulations break"));
  EXPECT_THAT(answer.out, HasSubstr("raise model.loading.max_strain"));
}

TEST(Check, SaysWhatAStudyLeavesOutAndTakesTwice) {
  const fs::path folder = folder_with_tests();
  std::string study = replaced_once(test::small_study(), "orientation_deg = 0\n", "");
  study = replaced_once(study, "\"B90.csv\"", "\"B0.csv\"");
  test::write_text(folder / "made/doubtful.toml", study);
  const auto answer = run_havers(folder, "check made/doubtful.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("specimen B0 has no orientation_deg"));
  EXPECT_THAT(answer.out, HasSubstr("specimens B0 and B90 have the same test"));
  EXPECT_THAT(answer.out, testing::EndsWith("\nno problems in this study, 3 notes\n"));
  EXPECT_EQ(run_havers(folder, "check made/study.toml").out, "no problems in this study\n");

  EXPECT_THAT(
      run_havers(folder, "check made/study.toml --set model.loading.strain_rate_per_s=7").out,
      testing::StartsWith("note: model.loading.strain_rate_per_s changes nothing: every test has"));

  const auto made = run_havers(folder, "synthesize made/doubtful.toml -o again");
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_THAT(made.err, HasSubstr("B0.csv: would be made twice"));
  EXPECT_FALSE(fs::exists(folder / "again"));
}

TEST(Check, SaysWhichAnglesHardlyDiffer) {
  const fs::path folder = folder_with_tests();
  const auto noted = [&](const std::string& degrees) {
    test::write_text(folder / "made/turned.toml",
                     replaced_once(test::small_study(), "orientation_deg = 0\n",
                                   "orientation_deg = " + degrees + "\n"));
    return run_havers(folder, "check made/turned.toml").out;
  };
  EXPECT_THAT(noted("89.2"),
              HasSubstr("orientation_deg of 89.2 (B0) and 90 (B90) count as different"));
  EXPECT_EQ(noted("86"), "no problems in this study\n");
}

// What went over the terminal stands in the results too.
TEST(Fit, LeavesItsNotesOnThePageAndInTheResult) {
  const fs::path folder = folder_with_tests();
  test::write_text(folder / "made/study.toml",
                   replaced_once(test::small_study(), "orientation_deg = 0\n", ""));
  const std::string doubt = "specimen B0 has no orientation_deg: 0 is taken, fibres along the load";
  EXPECT_THAT(run_havers(folder, "fit made/study.toml -o out").err, HasSubstr(doubt));
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  EXPECT_EQ(result["notes"], nlohmann::json::array({doubt}));
  if (!fs::exists(folder / "out/report.html")) GTEST_SKIP() << "this build makes no pages";
  const std::string page = test::contents(folder / "out/report.html");
  EXPECT_THAT(page, HasSubstr("<li>" + doubt));
  run_havers(folder, "report out");
  EXPECT_EQ(test::contents(folder / "out/report.html"), page);
}

// A thousand a second is no testing machine's rate.
TEST(Check, SaysWhichRateIsTakenWhereNoTimeTellsIt) {
  const fs::path folder = folder_with_tests();
  calib::RawTest raw = io::read_test(folder / "made/B0.csv").test;
  raw.time.clear();
  io::write_bluehill(folder / "made/B0.csv", raw);
  const auto noted = [&](const std::string& settings) {
    return run_havers(folder, "check made/study.toml" + settings).out;
  };
  EXPECT_THAT(noted(""), testing::StartsWith("note: no time tells the strain rate of specimen B0: "
                                             "1000 1/s is taken"));
  for (const char* settled :
       {" --set model.loading.strain_rate_per_s=1e-3", " --set model.solver.regime=quasi-static"})
    EXPECT_EQ(noted(settled), "no problems in this study\n");
}

// In the limit modulus and strength scale what was simulated; the ratio does not.
TEST(Check, SaysWhichSearchHasNothingToDo) {
  const fs::path folder = folder_with_tests();
  const auto noted = [&](const std::string& parameters, const std::string& option) {
    return run_havers(folder, "check made/study.toml --set 'calibrate.parameters=" + parameters +
                                  "' --set calibrate.options." + option)
        .out;
  };
  const std::string none = R"(["young_GPa", "head_tail_MPa"])", one = R"(["young_GPa", "ratio"])",
                    two = R"(["ratio", "friction"])";
  for (const char* option : {"local=cobyla", "smooth=false"}) {
    EXPECT_THAT(noted(none, option),
                testing::ContainsRegex("note: calibrate.options.[a-z]+ changes "
                                       "nothing: what is fitted needs no new"));
    EXPECT_EQ(noted(one, option), "no problems in this study\n");
  }
  EXPECT_THAT(noted(one, "local=bobyqa"), HasSubstr("\"sbplx\" is taken"));
  EXPECT_EQ(noted(two, "local=bobyqa"), "no problems in this study\n");
}

// Of the study, of a test, of a logger and of a section, though the study's own would end the
// reading.
TEST(Check, TellsTheProblemsOfAllStagesAtOnce) {
  const fs::path folder = own_folder();
  test::write_text(folder / "B0.csv", "");
  test::write_text(folder / "gauge.csv", "not a test\n");
  test::write_text(folder / "study.toml",
                   replaced_once(test::small_study(), "test = \"B0.csv\"\n",
                                 "test = \"B0.csv\"\ngauge = \"gauge.csv\"\nwidht_mm = 4\n"
                                 "sections = [\"gauge.csv\", \"none.png\"]\n"));
  const auto answer = run_havers(folder, "check study.toml");
  EXPECT_EQ(answer.exit_code, 2);
  for (const char* words : {"specimen.widht_mm: is not a known key", "B90.csv, which is not there",
                            "B0.csv: ", "gauge.csv: ", "none.png, which is not there"})
    EXPECT_THAT(answer.err, HasSubstr(words));
  EXPECT_EQ(std::ranges::count(answer.err, '\n'), 6) << answer.err;
}

TEST(Check, TellsDoubtsBesideProblems) {
  const fs::path folder = folder_with_tests();
  const auto answer = run_havers(folder,
                                 "check made/study.toml --set calibrate.local=sbplx --set "
                                 "calibrate.bounds.friction=[0.1,0.5]");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("calibrate.local: is not a known key"));
  EXPECT_EQ(answer.out,
            "note: calibrate.bounds.friction changes nothing: friction is not fitted\n");
}

TEST(Import, TakesOneOfSeveralSpecimensByNameOrNumber) {
  const fs::path folder = own_folder();
  std::string text;
  for (const char* id : {"North", "South"}) {
    text += fmt::format(
        "Specimen ID,{}\nWidth,4,mm\nThickness,2,mm\n\nTime (s),Load (N),Strain (%)\n", id);
    for (int i = 0; i <= 100; ++i) text += fmt::format("{},{},{:.4f}\n", i, 5 * i, 0.004 * i);
    text += "101,0,0\n";
  }
  test::write_text(folder / "two.csv", text);
  for (const char* second : {"South", "2"}) {
    const auto answer =
        run_havers(folder, std::string("import two.csv --json --set specimen_in_file=") + second);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_EQ(nlohmann::json::parse(answer.out)["specimen_id"], "South");
  }
  test::write_text(folder / "study.toml", "[[specimen]]\nid = \"A\"\ntest = \"two.csv\"\n");
  EXPECT_THAT(run_havers(folder, "check study.toml").err,
              HasSubstr("say which by specimen_in_file"));
  const std::string twice =
      "[[specimen]]\nid = \"A\"\ntest = \"two.csv\"\nspecimen_in_file = \"South\"\n"
      "[[specimen]]\nid = \"B\"\ntest = \"two.csv\"\nspecimen_in_file = 2\n";
  test::write_text(folder / "study.toml", twice);
  EXPECT_THAT(run_havers(folder, "check study.toml").out,
              HasSubstr("specimens A and B have the same test, two.csv: it counts twice"));
  test::write_text(folder / "study.toml", twice + "use = \"validate\"\n");
  EXPECT_THAT(run_havers(folder, "check study.toml").out,
              HasSubstr("the same test, two.csv: the fit sees what is to test it"));
}

// A logger's file is as easily exchanged as a test's.
TEST(Check, DoubtsALoggersFileThatIsOfAnotherSpecimen) {
  const fs::path folder = folder_with_tests();
  fs::copy_file(folder / "made/B0.csv", folder / "made/logger.csv");
  std::string study = test::small_study();
  for (const std::string id : {"B0", "B90"})
    study = replaced_once(study, "test = \"" + id + ".csv\"",
                          "test = \"" + id + ".csv\"\ngauge = \"logger.csv\"");
  test::write_text(folder / "made/study.toml", study);
  const auto checked = run_havers(folder, "check made/study.toml");
  EXPECT_THAT(checked.out, HasSubstr("specimens B0 and B90 have the same gauge, "));
  EXPECT_THAT(checked.out, HasSubstr("logger.csv: is it of both tests?"));
  EXPECT_THAT(checked.out, HasSubstr("logger.csv is of specimen B0 by its own words, and specimen "
                                     "B90 has it: are two exchanged?"));
  EXPECT_THAT(checked.out, testing::Not(HasSubstr("and specimen B0 has it")));
  const auto warnings = [&](const std::string& test) {
    return run_havers(folder, "import made/" + test + ".csv --gauge made/logger.csv --json").out;
  };
  EXPECT_THAT(warnings("B90"),
              HasSubstr("logger.csv is of specimen B0 by its own words, and made/B90.csv of B90: "
                        "are they of one test?"));
  EXPECT_THAT(warnings("B0"), testing::Not(HasSubstr("are they of one test?")));
}

}  // namespace
}  // namespace havers
