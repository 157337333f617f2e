// What -h shows.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

using test::own_folder;
using test::run_havers;
using testing::HasSubstr;

constexpr std::array commands{"fit",        "simulate", "import", "porosity", "check",
                              "synthesize", "report",   "bench",  "sweep"};

TEST(Help, ListsEveryCommand) {
  const auto answer = run_havers(own_folder(), "-h");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_TRUE(answer.err.empty()) << answer.err;
  for (const char* command : commands) EXPECT_THAT(answer.out, HasSubstr(command)) << command;
}

TEST(Help, EveryCommandShowsExamplesAndExitCodes) {
  const auto folder = own_folder();
  for (const char* command : commands) {
    const auto answer = run_havers(folder, std::string(command) + " -h");
    EXPECT_EQ(answer.exit_code, 0);
    EXPECT_THAT(answer.out, HasSubstr("Examples:\n  havers " + std::string(command)));
    for (const char* option : {"--json", "-q,", "-v,", "--threads", "--seed", "--set", "--force",
                               "--version", "Exit codes"})
      EXPECT_THAT(answer.out, HasSubstr(option)) << command << " " << option;
  }
}

// Of a scene with a seed beside thresholds, which a note says changes nothing.
TEST(Options, QuietLeavesOutNotesAndVerboseTellsWhatARunLeftOut) {
  const auto folder = test::folder_with_scene();
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
  const auto again = [&](const std::string& option) {
    return run_havers(folder,
                      "simulate scene.toml -o again --force --seed 3 --set "
                      "joints.thresholds_file=out/joints.csv" +
                          option);
  };
  const auto usual = again("");
  EXPECT_THAT(usual.err, HasSubstr("note: --seed changes nothing"));
  EXPECT_THAT(usual.out, testing::Not(HasSubstr("left out")));
  EXPECT_EQ(again(" -q").err, "");
  const auto result = nlohmann::json::parse(test::contents(folder / "again/result.json"));
  ASSERT_FALSE(result["left_out"].empty());
  const auto verbose = again(" -v");
  EXPECT_EQ(verbose.err, usual.err);
  for (const auto& one : result["left_out"])
    EXPECT_THAT(verbose.out, HasSubstr("\nleft out       " + one["what"].get<std::string>() + ": " +
                                       one["why"].get<std::string>() + "\n"));
}

TEST(Help, SaysWhichSeedsAndSettingsChangeNothing) {
  HAVERS_SLOW;
  const auto folder = own_folder();
  for (const std::string command : commands)
    for (const std::string option : {"--seed", "--set"}) {
      const std::string help = run_havers(folder, command + " -h").out;
      const std::string meaning = help.substr(help.find("  " + option + " "), 80);
      const std::string answer = run_havers(folder, command + " none " + option + " 1").err;
      EXPECT_EQ(meaning.find(option == "--set" ? "is refused" : "changes nothing here") !=
                    std::string::npos,
                answer.find("s nothing: havers") != std::string::npos)
          << command << " " << option;
    }
}

// Those of the user's own are in "my/".
TEST(Help, FilesOfTheExamplesAreThere) {
  const auto folder = own_folder();
  namespace fs = std::filesystem;
  const fs::path source = HAVERS_SOURCE_DIR;
  std::size_t looked_at = 0;
  for (const char* command : commands) {
    std::istringstream words(run_havers(folder, std::string(command) + " -h").out);
    for (std::string word; words >> word;) {
      const bool is_file = word.ends_with(".toml") || word.ends_with(".csv") ||
                           word.ends_with(".png") || word.ends_with(".tif");
      if (!is_file || word == "study.toml" || word.starts_with("my/")) continue;
      ++looked_at;
      const std::size_t star = word.find('*');
      if (star == std::string::npos) {
        EXPECT_TRUE(fs::exists(source / word)) << command << ": " << word;
        continue;
      }
      const std::string ending = word.substr(star + 1);
      EXPECT_TRUE(std::ranges::any_of(
          fs::directory_iterator((source / word).parent_path()),
          [&](const auto& entry) { return entry.path().string().ends_with(ending); }))
          << command << ": " << word;
    }
  }
  EXPECT_GT(looked_at, 5U);
}

}  // namespace
}  // namespace havers
