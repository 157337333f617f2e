// havers sweep, as its user runs it.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/run_havers.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::own_folder;
using test::run_havers;
using testing::HasSubstr;

constexpr const char* small = R"(
[sweep]
seeds = 4
[sweep.keys]
"joints.scatter" = [0.2, 0.8]
[assembly]
layers = 4
fibres = 3
[solver]
regime = "quasi-static"
[[law]]
response = "strength"
terms = ["joints.scatter"]
[[finding]]
id = "F1"
claim = "Strength falls with the scatter"
test = "falls"
keys = ["joints.scatter"]
[[figure]]
x = "joints.scatter"
)";

fs::path folder_with_sweep(const std::string& text = small) {
  const fs::path folder = own_folder();
  test::write_text(folder / "small.toml", text);
  return folder;
}

TEST(Sweep, LeavesTablesLawsResultAndStore) {
  const fs::path folder = folder_with_sweep();
  const auto answer = run_havers(folder, "sweep small.toml -o out");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  for (const char* file : {"small/runs.csv", "small/summary.csv", "small/laws.json", "result.json",
                           "evaluations.sqlite"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  EXPECT_EQ(result["evaluations"], 8);
  EXPECT_EQ(result["sweeps"][0]["simulated"], 8);
  EXPECT_THAT(answer.out, HasSubstr("F1"));
}

TEST(Sweep, ReadsWholeNumbersOfAnyBase) {
  const fs::path folder = folder_with_sweep(
      test::replaced_once(small, "[assembly]", "\"assembly.fibres\" = [0x3, 0b101]\n[assembly]"));
  EXPECT_EQ(run_havers(folder, "sweep small.toml -o out").exit_code, 0);
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  EXPECT_EQ(result["sweeps"][0]["points"].back()["keys"]["assembly.fibres"], 5);
}

TEST(Sweep, PrintsMeansInTheirUnitAndDifferencesInPerCent) {
  const fs::path folder = folder_with_sweep(std::string(small) +
                                            "[[finding]]\nid = \"F2\"\nclaim = \"Stiff\"\n"
                                            "test = \"above\"\nresponse = \"modulus\"\n"
                                            "margin = 1e9\nper = \"joints.scatter\"\n");
  EXPECT_THAT(run_havers(folder, "sweep small.toml -o out").out,
              testing::AllOf(testing::ContainsRegex("F1 .*strength -?[0-9]+ % "),
                             testing::ContainsRegex("F2 .*scatter = 0.8: modulus 13.[0-9]+ GPa ")));
}

TEST(Sweep, AgainTakesItsRunsFromTheStore) {
  const fs::path folder = folder_with_sweep();
  const std::string first = run_havers(folder, "sweep small.toml -o out").out;
  const auto again = run_havers(folder, "sweep small.toml -o out --force --json");
  EXPECT_EQ(nlohmann::json::parse(again.out)["sweeps"][0]["simulated"], 0);
  EXPECT_EQ(nlohmann::json::parse(again.out)["simulated"], 0);
  EXPECT_THAT(first, HasSubstr("; 8 of them simulated now, in "));
  EXPECT_THAT(run_havers(folder, "sweep small.toml -o out --force").out,
              HasSubstr("; 0 of them simulated now, in "));
}

TEST(Sweep, IsNotTrustedWhereRunsDidNotBreak) {
  const fs::path folder = folder_with_sweep();
  const auto answer = run_havers(folder, "sweep small.toml -o out --set loading.max_strain=0.001");
  EXPECT_EQ(answer.exit_code, 1) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("NOT to be trusted: too many runs failed or did not break"));
  EXPECT_THAT(answer.out, HasSubstr("8 runs, 0 failed, 8 did not break"));
  EXPECT_THAT(answer.out, HasSubstr("undecided   strength -; 0 runs"));
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  EXPECT_EQ(result["trusted"], false);
  EXPECT_EQ(result["unbroken_simulations"], 8);
  EXPECT_EQ(result["sweeps"][0]["laws"][0]["status"], "unbroken_runs");
}

TEST(Sweep, NamesTheProblemsOfAllFilesTogether) {
  const fs::path folder = own_folder();
  test::write_text(folder / "a.toml", "[sweep]\nseeds = 0\n");
  test::write_text(folder / "b.toml", "[sweep.keys]\n\"joints.scater\" = [0.1]\n");
  const auto answer = run_havers(folder, "sweep a.toml b.toml -o out");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("a.toml"));
  EXPECT_THAT(answer.err, HasSubstr("did you mean scatter?"));
  fs::create_directories(folder / "other");
  test::write_text(folder / "other/a.toml", small);
  EXPECT_THAT(
      run_havers(folder, "sweep a.toml other/a.toml -o out").err,
      HasSubstr("other/a.toml: has the file name of another sweep or of a result (rename one: "));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace havers
