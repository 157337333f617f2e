// What a user meets first: version, and mistakes in the command line.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/cli/run_havers.hpp"

namespace havers {
namespace {

using test::own_folder;
using test::run_havers;
using testing::HasSubstr;

TEST(Usage, WithoutACommandTheHelpIsShownAsAMistake) {
  const auto folder = own_folder();
  const auto answer = run_havers(folder, "");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_TRUE(answer.out.empty()) << answer.out;
  EXPECT_EQ(answer.err, run_havers(folder, "-h").out);
}

// As a script gives it whose variable is not set.
TEST(Usage, AnEmptyFolderForTheOutputIsRefused) {
  const auto folder = own_folder();
  for (const char* arguments : {"fit a.toml", "simulate a.toml", "import a.csv", "porosity a.png",
                                "synthesize a.toml", "sweep a.toml", "bench a.toml", "report a"}) {
    const auto answer = run_havers(folder, std::string(arguments) + " -o ''");
    EXPECT_EQ(answer.exit_code, 2) << arguments;
    EXPECT_TRUE(answer.err.starts_with("havers: --output: is empty, must name a folder"))
        << arguments << answer.err;
  }
}

TEST(Usage, SettingsThatSetNothingAreRefused) {
  const auto folder = own_folder();
  for (const char* arguments : {"porosity a.png", "bench --stability -o out"}) {
    const auto answer = run_havers(folder, std::string(arguments) + " --set joints.scatter=0.4");
    EXPECT_EQ(answer.exit_code, 2) << arguments;
    EXPECT_TRUE(answer.err.starts_with("havers: --set joints.scatter=0.4: sets nothing: "))
        << arguments << answer.err;
  }
}

TEST(Usage, ASeedThatChangesNothingIsNoted) {
  const auto folder = own_folder();
  for (const char* arguments : {"porosity a.png", "report out", "import a.csv", "check a.toml",
                                "bench --calibration --set a=1 -o out"}) {
    const std::string with_seed = std::string(arguments) + " --seed 3";
    const auto answer = run_havers(folder, with_seed);
    const std::string without = run_havers(folder, arguments).err;
    EXPECT_THAT(answer.err, testing::MatchesRegex("note: --seed changes nothing: .*\n.*"));
    EXPECT_TRUE(answer.err.ends_with("\n" + without)) << arguments << answer.err;
    EXPECT_EQ(run_havers(folder, with_seed + " -q").err, without) << arguments;
  }
  const auto sound = test::folder_with_scene();
  const auto answer = run_havers(sound, "check scene.toml --seed 3");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.out, run_havers(sound, "check scene.toml").out);
  EXPECT_EQ(answer.err, "note: --seed changes nothing: havers check runs nothing\n");
}

TEST(Usage, KnownDensitiesAreZeroOrMore) {
  for (const std::string wrong :
       {"30=-5", "30=800,5", "30=80kg", "1,2,3,4=5=6", "1:2:3,4=1900", "30"})
    EXPECT_TRUE(
        run_havers(own_folder(), "porosity --density 140=1200 --density " + wrong + " a.png")
            .err.starts_with("havers: --density " + wrong + ": is not understood (write "))
        << wrong;
}

// They wait for a file that nobody writes; timeout kills what a signal does not end.
TEST(Usage, ASignalEndsCommandsThatHaveNothingToLeave) {
  for (const std::string command : {"check", "import"})
    EXPECT_EQ(run_havers(own_folder(),
                         "-h >help; mkfifo never; timeout --preserve-status -k 20 0.5 "
                         "'" HAVERS_PROGRAM "' " +
                             command + " never #")
                  .exit_code,
              128 + SIGTERM)
        << command;
}

TEST(Usage, VersionSaysWhatIsBuiltIn) {
  const auto answer = run_havers(own_folder(), "--version");
  EXPECT_EQ(answer.exit_code, 0);
  for (const char* part :
       {"havers ", "images O", "reports O", "VTK snapshots O", "Eigen 3", "Ceres 2", "NLopt 2"})
    EXPECT_THAT(answer.out, HasSubstr(part)) << part;
}

TEST(Usage, MistakesInTheCommandLineAreOneLineAndExitTwo) {
  const auto folder = own_folder();
  for (const char* arguments :
       {"fly", "simulate", "simulate scene.toml", "check a.toml --threads 0",
        "check a.toml --nonsense", "porosity a.png --pixel-size-um -3"}) {
    SCOPED_TRACE(arguments);
    const auto answer = run_havers(folder, arguments);
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_TRUE(answer.out.empty()) << answer.out;
    EXPECT_EQ(std::ranges::count(answer.err, '\n'), 1) << answer.err;
    EXPECT_TRUE(answer.err.starts_with("havers: ")) << answer.err;
  }
}

TEST(Usage, MistakesInTheCommandLineHaveTheObjectOfJsonToo) {
  const auto answer = run_havers(own_folder(), "simulate --json");
  EXPECT_EQ(answer.exit_code, 2);
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json["status"], "refused");
  EXPECT_EQ(json["problems"][0]["where"], "command line");
  EXPECT_TRUE(answer.err.starts_with("havers: " + json["problems"][0]["what"].get<std::string>()));
}

// Arguments, each with the sentence that refuses them.
void expect_refused(const std::vector<std::pair<std::string, std::string>>& wrong) {
  const auto folder = own_folder();
  for (const auto& [arguments, sentence] : wrong) {
    const auto answer = run_havers(folder, arguments);
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_EQ(answer.err,
              "havers: " + sentence + " (havers -h and havers COMMAND -h show how it is used)\n");
  }
}

TEST(Usage, WordsThatNothingKnowsAreNamedWithTheNearest) {
  expect_refused(
      {{"simulat x", "simulat is no command, did you mean simulate?"},
       {"frob",
        "frob is no command, known are bench, check, fit, import, porosity, report, simulate, "
        "sweep, synthesize"},
       {"check a.toml --sed 3", "--sed is no option of check, did you mean --seed?"},
       {"fit a.toml --outptu=b", "--outptu=b is no option of fit, did you mean --output?"},
       {"--verison", "--verison is no option of havers, did you mean --version?"},
       {"simulat x.toml -o out", "simulat is no command, did you mean simulate?"},
       {"-o out simulat x.toml", "-o is no option of havers"},
       {"check a.toml --foo", "--foo is no option of check"},
       {"check a.toml --forse", "--forse is no option of check, did you mean --force?"},
       {"check a.toml --frobnicate", "--frobnicate is no option of check"}});
}

TEST(Usage, NumbersThatCannotBeAreNamedWithTheRule) {
  expect_refused(
      {{"import a.csv --width-mm nan", "--width-mm: is nan, must be a number above 0"},
       {"import a.csv --thickness-mm four", "--thickness-mm: is four, must be a number above 0"},
       {"import a.csv --gauge-length-mm=-1", "--gauge-length-mm: is -1, must be a number above 0"},
       {"check a.toml --threads 0", "--threads: is 0, must be a whole number from 1 to 1024"},
       {"check a.toml --threads 1.5", "--threads: is 1.5, must be a whole number from 1 to 1024"},
       {"check a.toml --seed x", "--seed: is x, must be a whole number from 0 to 2^63 - 1"},
       {"check a.toml --seed=-1", "--seed: is -1, must be a whole number from 0 to 2^63 - 1"},
       {"check a.toml --seed 9223372036854775808",
        "--seed: is 9223372036854775808, must be a whole number from 0 to 2^63 - 1"},
       {"bench -o b --porosity --seeds 99999999999",
        "--seeds: is 99999999999, must be a whole number from 1 to 1000000"},
       {"bench -o b --calibration --costly 3",
        "--costly: is 3, must be a whole number from 1 to 2"},
       {"porosity a.png --rim-um inf", "--rim-um: is inf, must be a number, 0 or more"},
       {"porosity a.png --pores grey", "--pores: is grey, must be one of: found, dark, bright"}});
}

// The answer that was lost is no answer, whether it filled the buffer or waited in it. A build
// without pages says before it that it makes none.
TEST(Usage, AnAnswerThatCannotBePrintedIsSaid) {
  const auto folder = own_folder();
  test::write_text(folder / "good.toml", test::small_scene());
  for (const char* arguments :
       {"check good.toml", "check good.toml --json", "simulate good.toml -o out --force --json",
        "--version", "fit -h"}) {
    const auto answer = run_havers(folder, std::string(arguments) + " >/dev/full 2>said #");
    EXPECT_EQ(answer.exit_code, 1) << arguments;
    EXPECT_TRUE(test::contents(folder / "said")
                    .ends_with("havers: stdout: cannot be written (is the disk full?)\n"))
        << arguments;
  }
}

TEST(Usage, NamesOfFilesNeedNotBeUtf8) {
  const auto folder = own_folder();
  const std::string name = "\xE9prouvette.csv";
  test::write_text(folder / name, "Time (s),Load (N)\n0,1\n1,2\n2,3\n");
  const auto answer = run_havers(folder, "import " + name + " --json -o out");
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json["file"], "\uFFFDprouvette.csv");
  EXPECT_EQ(nlohmann::json::parse(test::contents(folder / "out/import.json")), json);
}

TEST(Usage, AMissingFileAFolderAndOneThatIsForbiddenAreToldApart) {
  const auto folder = own_folder();
  std::filesystem::create_directory(folder / "sub");
  const auto said = [&](const std::string& file) {
    return run_havers(folder, "check " + file).err;
  };
  EXPECT_EQ(said("none.toml"), "havers: none.toml: is not there (a TOML file is expected there)\n");
  EXPECT_EQ(said("sub"), "havers: sub: is a folder (a TOML file is expected there)\n");
  std::filesystem::create_symlink("loop.toml", folder / "loop.toml");
  EXPECT_TRUE(said("loop.toml").starts_with("havers: loop.toml: cannot be read: "));
}

TEST(Usage, MissingFilesAreNamed) {
  const auto folder = own_folder();
  for (const char* arguments :
       {"simulate none.toml -o out", "fit none.toml -o out", "check none.toml", "import none.csv",
        "synthesize none.toml -o out"}) {
    SCOPED_TRACE(arguments);
    const auto answer = run_havers(folder, arguments);
    EXPECT_EQ(answer.exit_code, 2);
    EXPECT_THAT(answer.err, HasSubstr("none."));
    EXPECT_TRUE(std::filesystem::is_empty(folder));
  }
}

TEST(Check, DoubtsASlowSceneInTime) {
  const auto folder = own_folder();
  test::write_text(folder / "slow.toml",
                   "[loading]\nstrain_rate_per_s = 1e-3\n[solver]\nregime = \"dynamic\"\n");
  const auto answer = run_havers(folder, "check slow.toml");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_TRUE(answer.out.starts_with("note: a run in time ends after ten million steps, "))
      << answer.out;
}

TEST(Check, SaysNoProblemsOrAllOfThem) {
  const auto folder = own_folder();
  test::write_text(folder / "good.toml", test::small_scene());
  test::write_text(folder / "bad.toml",
                   "[assembly]\nlayer = 3\nfibres = \"many\"\n[joints]\nscatter = 2.5\n");
  auto answer = run_havers(folder, "check good.toml");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.out, "no problems in this scene\n");
  answer = run_havers(folder, "check good.toml --json");
  EXPECT_EQ(nlohmann::json::parse(answer.out).at("kind"), "scene");

  test::write_text(folder / "empty.toml", "# layers = 3\n");
  answer = run_havers(folder, "check empty.toml");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_TRUE(answer.err.starts_with("havers: empty.toml: is empty (")) << answer.err;

  answer = run_havers(folder, "check bad.toml");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_TRUE(answer.out.empty());
  for (const char* word : {"layers", "fibres", "scatter"}) EXPECT_THAT(answer.err, HasSubstr(word));

  answer = run_havers(folder, "check bad.toml --json");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(nlohmann::json::parse(answer.out).at("problems").size(), 3U);
  answer = run_havers(folder, "simulate bad.toml -o out --json");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(nlohmann::json::parse(answer.out).at("problems").size(), 3U);
  EXPECT_EQ(nlohmann::json::parse(answer.out).at("status"), "refused");
}

// Whatever way of TOML the tables are written in.
TEST(Check, TakesForAStudyWhatFitTakesForOne) {
  const auto folder = test::folder_with_tests();
  std::string indented = test::small_study();
  for (std::size_t at = 0; (at = indented.find("\n[", at)) != std::string::npos; at += 4)
    indented.insert(at + 1, "  ");
  const std::string specimens =
      R"(specimen = [{id = "B0", test = "B0.csv", width_mm = 4.0, thickness_mm = 2.0,)"
      " gauge_length_mm = 25.0, orientation_deg = 0}]\n";
  const std::pair<const char*, std::string> studies[] = {
      {"indented", indented},
      {"inline", "study.name = \"dotted\"\n" + specimens},
      {"nameless", specimens}};
  for (const auto& [name, study] : studies) {
    test::write_text(folder / "made" / name, study);
    const auto answer = run_havers(folder, fmt::format("check made/{} --json", name));
    EXPECT_EQ(answer.exit_code, 0) << name << answer.out;
    EXPECT_EQ(nlohmann::json::parse(answer.out).at("kind"), "study") << name;
  }
}

TEST(Check, DoesNotKnowTheKindOfAFileThatCannotBeRead) {
  const auto folder = own_folder();
  test::write_text(folder / "study.toml", "[study]\nname = = 2\n");
  test::write_text(folder / "empty.toml", "");
  for (const std::string file : {"study.toml", "empty.toml", "none.toml"}) {
    const auto answer = run_havers(folder, "check --json " + file);
    EXPECT_EQ(answer.exit_code, 2);
    const auto json = nlohmann::json::parse(answer.out);
    EXPECT_TRUE(json.at("kind").is_null()) << json.dump();
    EXPECT_EQ(json.at("problems").size(), 1U);
  }
}

TEST(Check, TellsAStudyFromASceneAndReportsAllItsFiles) {
  const auto folder = test::folder_with_study();
  const auto answer = run_havers(folder, "check study.toml");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("B0.csv"));
  EXPECT_THAT(answer.err, HasSubstr("B90.csv"));
}

}  // namespace
}  // namespace havers
