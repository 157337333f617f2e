#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::own_folder;
using test::run_havers;

std::string header_of(const std::string& table) {
  return table.substr(0, table.find('\n'));
}

TEST(Bench, LeavesPageFigureTableAndResult) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder, "bench scene.toml -o out --seeds 1");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  EXPECT_TRUE(result["complete"]);
  EXPECT_EQ(result["cheapest"].size(), 15U);
  const std::string table = test::contents(folder / "out/bench.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), static_cast<long>(result["rows"].size()) + 1);
  EXPECT_TRUE(answer.out.starts_with(result["summary"].get<std::string>())) << answer.out;
  for (const auto& [name, value] : result["rows"][0].items())
    EXPECT_THAT(("," + header_of(table) + ","),
                testing::HasSubstr("," + (name == "text" ? "setting" : name) + ","))
        << name;
  for (const char* column :
       {"regime", "contact", "tolerance", "step (ns)", "refinement", "leave out", "dynamic",
        "quasi-static", "active-set", "With nothing left out the answer differs by"})
    EXPECT_THAT(answer.out, testing::HasSubstr(column)) << column;
}

TEST(Bench, NeedsASceneUnlessAFlagSaysOtherwise) {
  const fs::path folder = own_folder();
  const auto answer = run_havers(folder, "bench -o out");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(answer.err, "havers: bench: no scene is given (havers bench SCENE.toml -o DIR)\n");
}

TEST(Bench, RefusesWhatItsModeDoesNotUse) {
  const fs::path folder = own_folder();
  const auto refused = [](const std::string& option, const std::string& mode) {
    return "havers: " + option + ": changes nothing with " + mode + " (leave it out)\n";
  };
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"--porosity --studies 3 --costly 2",
       refused("--studies", "--porosity") + refused("--costly", "--porosity")},
      {"scene.toml --stability", refused("SCENE", "--stability")},
      {"--stability --seeds 3", refused("--seeds", "--stability")},
      {"--coverage --costly 2", refused("--costly", "--coverage")},
      {"--calibration --seeds 3", refused("--seeds", "--calibration")},
      {"scene.toml --studies 3", refused("--studies", "a SCENE alone")},
      {"--porosity --coverage", refused("--coverage", "--porosity")}};
  for (const auto& [arguments, sentences] : wrong) {
    const auto answer = run_havers(folder, "bench -o out " + arguments);
    EXPECT_EQ(answer.exit_code, 2) << arguments;
    EXPECT_EQ(answer.err, sentences);
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

// Of times and processors nothing is the same again.
std::vector<nlohmann::json> numbers_of_rows(const nlohmann::json& result) {
  std::vector<nlohmann::json> rows;
  for (const auto& row : result["rows"])
    rows.push_back({row["text"], row["iterations"], row["last_strain"], row["strength_error"]});
  return rows;
}

TEST(Bench, DrawsThresholdsByItsSeed) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_scene();
  const auto rows = [&](const std::string& seed) {
    const auto answer = run_havers(folder,
                                   "bench scene.toml -o out --force --json --seeds 1 --set "
                                   "assembly.layers=2 --set assembly.fibres=2" +
                                       seed);
    return numbers_of_rows(nlohmann::json::parse(answer.out));
  };
  const auto usual = rows("");
  ASSERT_FALSE(usual.empty());
  EXPECT_EQ(rows(" --seed 1"), usual);
  EXPECT_NE(rows(" --seed 2"), usual);
}

// No residual is that small.
TEST(Bench, ExitsOneWhereItsReferenceIsNotToBeTrusted) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder,
                                 "bench scene.toml -o out --seeds 1 --set solver.tolerance=1e-30 "
                                 "--set assembly.layers=2 --set assembly.fibres=2");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_TRUE(answer.out.starts_with("The reference is not to be trusted: 0 of 1 runs"));
  EXPECT_TRUE(nlohmann::json::parse(test::contents(folder / "out/result.json"))["complete"]);
}

TEST(Bench, RunsTheStabilityScenesWithoutAScene) {
  HAVERS_SLOW;
  const fs::path folder = own_folder();
  const auto answer = run_havers(folder, "bench --stability -o out --json");
  const auto result = nlohmann::json::parse(answer.out);
  EXPECT_GE(result["scenes"].size(), 40U);
  EXPECT_EQ(result["complete"], true);
  for (const auto& scene : result["scenes"]) EXPECT_EQ(scene["as_it_must"], true) << scene.dump();
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "out/stability.csv"));
}

TEST(Bench, ComparesWaysToMeasurePorosityWithoutAScene) {
  HAVERS_SLOW;
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const fs::path folder = own_folder();
  const auto answer = run_havers(folder, "bench --porosity --seeds 1 -o out --json");
  ASSERT_NE(answer.exit_code, 2) << answer.err;
  const auto result = nlohmann::json::parse(answer.out);
  ASSERT_EQ(result["methods"].size(), 4U);
  EXPECT_EQ(result["hardships"].size(), 7U);
  EXPECT_GT(result["methods"][0]["worst_error"], 0.4);
  EXPECT_LT(result["methods"][3]["worst_error"], 0.003);
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_TRUE(fs::exists(folder / "out/porosity.csv"));
  EXPECT_FALSE(fs::exists(folder / "out/section.png"));
}

TEST(Bench, SaysThatItWasStoppedAmongSections) {
  if (!test::reads_images()) GTEST_SKIP() << "this build reads no images";
  const fs::path folder = own_folder();
  const auto stopped =
      run_havers(folder, "-h >help; '" HAVERS_PROGRAM
                         "' bench --porosity --seeds 100 -o out >said & "
                         "for i in $(seq 1000); do [ -e .out.partial ] && break; sleep 0.01; done; "
                         "kill $!; wait $! #");
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_TRUE(test::contents(folder / "said").starts_with("stopped before all sections"));
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  EXPECT_FALSE(result["complete"]);
}

// As a shell has it for what a script runs in the background.
TEST(Bench, GoesOnWhereAParentIgnoresInterrupts) {
  const fs::path folder = test::folder_with_scene();
  const auto answer =
      run_havers(folder, "-h >help; trap '' INT; '" HAVERS_PROGRAM
                         "' bench scene.toml -o out --seeds 1 >said & "
                         "for i in $(seq 1000); do [ -e .out.partial ] && break; sleep 0.01; done; "
                         "kill -INT $!; wait $! #");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_TRUE(nlohmann::json::parse(test::contents(folder / "out/result.json"))["complete"]);
}

TEST(Bench, ComparesChainsOfOptimisersWithoutAScene) {
  HAVERS_SLOW;
  const fs::path folder = own_folder();
  const auto answer = run_havers(folder, "bench --calibration --studies 1 -o out --json");
  const auto result = nlohmann::json::parse(answer.out);
  ASSERT_FALSE(result["chains"].empty());
  // Well where no chain is better than the first, which fits use.
  EXPECT_EQ(answer.exit_code, result["winner"] == result["chains"][0]["chain"] ? 0 : 1);
  EXPECT_EQ(result["fits"], result["chains"].size());
  for (const auto& chain : result["chains"]) {
    EXPECT_LT(chain["error_10_50_90"][1], 0.2) << chain["chain"];
    EXPECT_GT(chain["by_simulations"].size(), 5U);
  }
  EXPECT_TRUE(fs::exists(folder / "out/chains.csv"));
}

TEST(Bench, MeasuresWhatIntervalsHoldWithoutAScene) {
  HAVERS_SLOW;
  const fs::path folder = own_folder();
  const auto answer = run_havers(folder, "bench --coverage --studies 1 -o out --json");
  const auto result = nlohmann::json::parse(answer.out);
  ASSERT_EQ(result["coverage"].size(), 12U);
  for (const auto& row : result["coverage"]) {
    EXPECT_EQ(row["studies"], 1);
    EXPECT_EQ(row["intervals"], "too few to tell");
  }
  EXPECT_EQ(answer.exit_code, 0);  // none is too narrow
  const std::string table = test::contents(folder / "out/coverage.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), 13);
}

TEST(Bench, ReadsTheSceneThatIsShippedForIt) {
  const fs::path folder = own_folder();
  const auto answer = run_havers(
      folder, "check " + std::string(HAVERS_SOURCE_DIR) + "/data_samples/scenes/bench.toml");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
}

}  // namespace
}  // namespace havers
