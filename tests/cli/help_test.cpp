// What -h shows.
#include <gmock/gmock.h>

#include <array>
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
    for (const char* option : {"--json", "-q", "-v", "--threads", "--seed", "--set", "--force",
                               "--version", "Exit codes"})
      EXPECT_THAT(answer.out, HasSubstr(option)) << command << " " << option;
  }
}

TEST(Help, SaysWhichSeedsAndSettingsAreRefused) {
  HAVERS_SLOW;
  const auto folder = own_folder();
  for (const std::string command : commands)
    for (const std::string option : {"--seed", "--set"}) {
      const std::string help = run_havers(folder, command + " -h").out;
      const std::string meaning = help.substr(help.find("  " + option + " "), 80);
      const std::string answer = run_havers(folder, command + " none " + option + " 1").err;
      EXPECT_EQ(meaning.find("is refused") != std::string::npos,
                answer.find("sets nothing: havers") != std::string::npos)
          << command << " " << option;
    }
}

// Those of the user's own are in "my/".
TEST(Help, FilesOfTheExamplesAreThere) {
  const auto folder = own_folder();
  const std::filesystem::path source = HAVERS_SOURCE_DIR;
  for (const char* command : commands) {
    std::istringstream words(run_havers(folder, std::string(command) + " -h").out);
    for (std::string word; words >> word;) {
      const bool is_file = word.ends_with(".toml") || word.ends_with(".csv") ||
                           word.ends_with(".png") || word.ends_with(".tif");
      if (!is_file || word == "study.toml" || word.starts_with("my/")) continue;
      const bool is_pattern = word.find('*') != std::string::npos;
      EXPECT_TRUE(
          std::filesystem::exists(is_pattern ? (source / word).parent_path() : source / word))
          << command << ": " << word;
    }
  }
}

}  // namespace
}  // namespace havers
