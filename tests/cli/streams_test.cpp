// What is on stdout and stderr when something is refused, or when they cannot be written.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_havers.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::run_havers;

// Notes, progress and complaints are lost then, and nothing else.
TEST(Streams, AStderrThatCannotBeWrittenEndsNoRun) {
  const fs::path folder = test::folder_with_tests();
  for (const std::string stderr_is : {" >said 2>/dev/full #", " >said 2>&- #"}) {
    EXPECT_EQ(
        run_havers(folder, "import made/B0.csv --seed 1 -o out --force" + stderr_is).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder / "out/import.json"));
    EXPECT_EQ(run_havers(folder, "import none.csv" + stderr_is).exit_code, 2);
    EXPECT_EQ(run_havers(folder, "import --frob" + stderr_is).exit_code, 2);
    EXPECT_EQ(run_havers(folder, stderr_is).exit_code, 2);
    fs::remove_all(folder / "out");
  }
}

TEST(Streams, AProblemOfAFileThatIsNamedTwiceIsOneLine) {
  EXPECT_EQ(run_havers(test::own_folder(), "import none.csv none.csv").err,
            "havers: none.csv: there is no such file\n");
}

// The one object on stdout of what is refused, and the lines on stderr that say the same.
TEST(Streams, JsonHasTheProblemsOfWhateverIsRefused) {
  const fs::path folder = test::folder_with_tests();
  fs::create_directories(folder / "mine");
  test::write_text(folder / "mine/import.json", "mine");
  const std::string long_name(300, 'x');
  for (const std::string& arguments :
       {std::string("import made/B0.csv --set columns.forc=2"),
        std::string("import made/B0.csv -o made"),
        std::string("import made/B0.csv -o mine --force"),
        std::string("import made/B0.csv made/B90.csv --gauge made/B0.csv"),
        std::string("porosity a.png --density foo"), std::string("porosity a.png --set a=1"),
        "simulate made/study.toml -o " + long_name}) {
    const auto answer = run_havers(folder, arguments + " --json");
    EXPECT_EQ(answer.exit_code, 2) << arguments;
    const auto json = nlohmann::json::parse(answer.out, nullptr, false);
    ASSERT_TRUE(json.contains("problems")) << arguments << answer.out << answer.err;
    EXPECT_EQ(json["status"], "refused");
    EXPECT_THAT(answer.err, testing::HasSubstr(json["problems"][0]["what"].get<std::string>()));
  }
}

}  // namespace
}  // namespace havers
