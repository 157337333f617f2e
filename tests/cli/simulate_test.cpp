#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_havers.hpp"
#include "tests/support/slow.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::run_havers;
using testing::HasSubstr;

// Turns the small scene into one that is stepped in time.
constexpr const char* impact =
    " --set loading.strain_rate_per_s=1000 --set solver.regime=dynamic --set solver.step_s=2e-8";

TEST(Simulate, LeavesTheFilesOfTheContract) {
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder, "simulate scene.toml -o out");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_TRUE(answer.err.find('\r') == std::string::npos) << "progress without a terminal";
  for (const char* file : {"curve.csv", "joints.csv", "result.json"})
    EXPECT_TRUE(fs::exists(folder / "out" / file));
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  for (const char* key :
       {"status", "trusted", "strength_Pa", "failure_strain", "modulus_Pa", "first_break_strain",
        "broken_joints", "end_fraction_used", "steps", "energy_defect", "worst_residual",
        "worst_penetration_m", "wall_s", "left_out", "scene", "provenance"})
    EXPECT_TRUE(result.contains(key)) << key;
  EXPECT_EQ(result["status"], "broken");
  EXPECT_NEAR(result["modulus_Pa"].get<double>() / 13e9, 1.0, 1e-9);
  EXPECT_EQ(test::contents(folder / "out/curve.csv").substr(0, 31),
            "time_s,strain,stress_right_Pa,s");
}

TEST(Simulate, SummaryPutsTheVerdictFirstAndThePathLast) {
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder, "simulate scene.toml -o out");
  EXPECT_TRUE(answer.out.starts_with("to be trusted: ")) << answer.out;
  std::string last = answer.out.substr(0, answer.out.size() - 1);
  last = last.substr(last.rfind('\n') + 1);
  EXPECT_TRUE(fs::is_regular_file(last)) << last;
}

// No time without the error of what it bought.
TEST(Simulate, PrintsTheStepsErrorBesideTheTime) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_scene();
  const auto time_of = [&](const std::string& settings) {
    const std::string out = run_havers(folder, "simulate scene.toml -o out --force" + settings).out;
    const std::size_t line = out.find("\ntime ");
    return out.substr(line, out.find(';', line) - line);
  };
  EXPECT_THAT(time_of(" --set loading.strain_rate_per_s=1000 --set solver.step_accuracy=0.1"),
              HasSubstr("longer ones, step error "));
  EXPECT_THAT(time_of(impact), HasSubstr("steps, whose error is not known"));
  EXPECT_THAT(time_of(""), HasSubstr(" events"));
}

TEST(Simulate, IsTrustedButForAStepThatWasGiven) {
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder, std::string("simulate scene.toml -o out") + impact);
  EXPECT_EQ(answer.exit_code, 0);
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  EXPECT_THAT(answer.out,
              testing::StartsWith(fmt::format(
                  "to be trusted but for the time step: 20 ns was given, and its error is not "
                  "known; steps took {:.0f} % of all energy; after a break",
                  100.0 * result["numerical_loss"].get<double>())));
}

TEST(Simulate, SaysDownToWhereBrokenJointsAreCounted) {
  const fs::path folder = test::folder_with_scene();
  const auto out = [&](const std::string& settings) {
    return run_havers(folder, "simulate scene.toml -o out --force" + settings).out;
  };
  const std::string early = out("");
  const auto result = nlohmann::json::parse(test::contents(folder / "out/result.json"));
  const double part = result["end_fraction_used"];
  EXPECT_GT(part, 0.3);
  EXPECT_THAT(early, HasSubstr(fmt::format("bear less than {:.3g} of the strength\n", part)));
  EXPECT_THAT(early, HasSubstr(fmt::format("; counted down to {:.3g} of the strength "
                                           "(solver.leave_out = false follows on, to 0.3)\n",
                                           part)));
  const std::string whole = out(" --set solver.leave_out=false");
  EXPECT_THAT(whole, HasSubstr("bear less than 0.3 of the strength\n"));
  EXPECT_THAT(whole, testing::Not(HasSubstr("counted down")));
}

TEST(Simulate, GivesABoundOfTheStrengthOfARunThatDidNotBreak) {
  const fs::path folder = test::folder_with_scene();
  const std::string out =
      run_havers(folder, "simulate scene.toml -o out --set loading.max_strain=1e-4").out;
  EXPECT_THAT(out, HasSubstr("\nstrength       at least 1.3 MPa\n"));
  EXPECT_THAT(out,
              HasSubstr("\nfailure strain -, not reached within the strain limit of 0.01 %\n"));
  EXPECT_THAT(out, HasSubstr("penetration 0 m\n"));
}

TEST(Simulate, JsonIsTheResultFile) {
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder, "simulate scene.toml -o out --json");
  EXPECT_EQ(nlohmann::json::parse(answer.out),
            nlohmann::json::parse(test::contents(folder / "out/result.json")));
}

TEST(Simulate, KeepsTheDigestOfItsThresholds) {
  const fs::path folder = test::folder_with_scene();
  ASSERT_EQ(run_havers(folder, "simulate scene.toml -o out").exit_code, 0);
  const auto answer = run_havers(folder,
                                 "simulate scene.toml -o again --json --seed 3 --set "
                                 "joints.thresholds_file=out/joints.csv");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.err, HasSubstr("note: --seed changes nothing: thresholds_file gives those"));
  const auto inputs = nlohmann::json::parse(answer.out)["provenance"]["inputs"];
  EXPECT_EQ(inputs.size(), 2U) << inputs.dump();

  const auto other = run_havers(folder,
                                "simulate scene.toml -o other --set assembly.fibre_length_um=77 "
                                "--set joints.thresholds_file=out/joints.csv");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("µm: it is of another wall (write a matching file"));
}

TEST(Simulate, SetAndSeedReplaceTheScenesValues) {
  const fs::path folder = test::folder_with_scene();
  const auto answer = run_havers(folder,
                                 "simulate scene.toml -o out --json --seed 42 --set "
                                 "material.young_GPa=20 --set loading.lateral=free");
  const auto result = nlohmann::json::parse(answer.out);
  EXPECT_NEAR(result["modulus_Pa"].get<double>() / 20e9, 1.0, 1e-9);
  EXPECT_EQ(result["scene"]["joints"]["seed"], 42);
  EXPECT_EQ(result["scene"]["loading"]["lateral"], "free");

  const auto wrong = run_havers(folder, "simulate scene.toml -o wrong --set material.yung_GPa=20");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("young_GPa"));
}

TEST(Simulate, GivesTheSameBytesAgainAndForAnyNumberOfThreads) {
  HAVERS_SLOW;
  const fs::path folder = test::folder_with_scene();
  for (const std::string regime : {"", impact}) {
    for (const std::string threads : {"1", "1", "2", "4"}) {
      SCOPED_TRACE(regime + " on " + threads);
      ASSERT_EQ(
          run_havers(folder, "simulate scene.toml -o out --force --threads " + threads + regime)
              .exit_code,
          0);
      if (!fs::exists(folder / "first")) fs::copy(folder / "out", folder / "first");
      for (const char* file : {"curve.csv", "joints.csv"})
        EXPECT_EQ(test::contents(folder / "first" / file), test::contents(folder / "out" / file));
    }
    fs::remove_all(folder / "first");
  }
  EXPECT_GT(std::ranges::count(test::contents(folder / "out/curve.csv"), '\n'), 100);
}

TEST(Simulate, ExitsOneWhenTheRunIsNotToBeTrusted) {
  const fs::path folder = test::folder_with_scene();
  const auto answer =
      run_havers(folder, std::string("simulate scene.toml -o out --set solver.contact=gauss-seidel "
                                     "--set solver.max_iterations=1") +
                             impact);
  EXPECT_EQ(answer.exit_code, 1) << answer.out << answer.err;
  EXPECT_TRUE(answer.out.starts_with("NOT to be trusted: ")) << answer.out;
  EXPECT_THAT(answer.out, testing::HasSubstr("\nstrength       -\nbroken joints  0 of "))
      << answer.out;
}

TEST(Simulate, AndCheckNameTheLineOfSnapshotsThatCannotBeWritten) {
  const auto folder = test::folder_with_scene();
  if (run_havers(folder, "--version").out.find("VTK snapshots OFF") == std::string::npos)
    GTEST_SKIP() << "this build writes snapshots";
  test::write_text(folder / "film.toml", "[output]\nsnapshots = 3\n" + test::small_scene());
  for (const char* command : {"simulate film.toml -o out", "check film.toml"})
    EXPECT_THAT(run_havers(folder, command).err,
                testing::StartsWith("havers: film.toml:2: output.snapshots: this build writes no"));
}

}  // namespace
}  // namespace havers
