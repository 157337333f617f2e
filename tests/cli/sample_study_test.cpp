// The sample study, as a newcomer runs it: the truth is beside it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_havers.hpp"

namespace havers {
namespace {

namespace fs = std::filesystem;
using test::own_folder;
using test::run_havers;

const fs::path bars = HAVERS_SOURCE_DIR "/data_samples/bone_bars";

TEST(SampleStudy, FindsTheTruthAgainAndIsTrusted) {
  const fs::path folder = own_folder();
  const auto answer =
      run_havers(folder, "fit '" + (bars / "study.toml").string() + "' -o out --json");
  ASSERT_EQ(answer.exit_code, 0) << answer.out << answer.err;
  const auto result = nlohmann::json::parse(answer.out);
  const auto truth = nlohmann::json::parse(test::read_text(bars / "truth.json"));
  const std::map<std::string, double> tolerance{
      {"young_GPa", 0.01}, {"head_tail_MPa", 0.03}, {"ratio", 0.5}};
  for (const auto& parameter : result["parameters"]) {
    const auto name = parameter["name"].get<std::string>();
    SCOPED_TRACE(name);
    if (!parameter["identifiable"].get<bool>()) {
      EXPECT_EQ(name, "ratio");
      EXPECT_FALSE(parameter["left_out_because"].get<std::string>().empty());
      continue;
    }
    const double expected = truth["parameters"][name];
    EXPECT_NEAR(parameter["value"].get<double>() / expected, 1.0, tolerance.at(name));
    EXPECT_LE(parameter["interval_95"][0], expected);
    EXPECT_GE(parameter["interval_95"][1], expected);
  }
  EXPECT_EQ(result["specimens"].size(), 6U);

  // The page again, and the calibrated model as a scene of its own.
  const std::string page = test::read_text(folder / "out/report.html");
  fs::remove(folder / "out/report.html");
  EXPECT_EQ(run_havers(folder, "report out").exit_code, 0);
  EXPECT_NEAR(static_cast<double>(test::read_text(folder / "out/report.html").size()) /
                  static_cast<double>(page.size()),
              1.0, 0.01);
  EXPECT_EQ(run_havers(folder, "report out out/result.json -o both").exit_code, 0);
  EXPECT_GT(fs::file_size(folder / "both/report.html"), 10000U);
  EXPECT_EQ(run_havers(folder, "simulate out/scene.toml -o again").exit_code, 0);
}

TEST(SampleStudy, SectionsHaveThePorosityThatWasDrawn) {
  const auto truth = nlohmann::json::parse(test::read_text(bars / "truth.json"));
  for (const auto& specimen : truth["specimens"]) {
    const auto id = specimen["id"].get<std::string>();
    const auto answer =
        run_havers(own_folder(), "porosity '" + (bars / (id + "_section.png")).string() +
                                     "' --pixel-size-um 2 --json");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    const auto section = nlohmann::json::parse(answer.out);
    EXPECT_NEAR(section["porosity"].get<double>(), specimen["porosity"].get<double>(), 0.003) << id;
    EXPECT_NEAR(section["scatter"].get<double>() / specimen["scatter"].get<double>(), 1.0, 0.05)
        << id;
  }
}

TEST(SampleScenes, HaveNoProblemsAndRunToTheBreak) {
  const fs::path scenes = HAVERS_SOURCE_DIR "/data_samples/scenes";
  for (const char* scene : {"machine.toml", "oblique.toml"}) {
    const auto answer =
        run_havers(own_folder(), "simulate '" + (scenes / scene).string() + "' -o out --json");
    EXPECT_EQ(answer.exit_code, 0) << scene << answer.err;
    EXPECT_EQ(nlohmann::json::parse(answer.out)["status"], "broken");
  }
  EXPECT_EQ(run_havers(own_folder(), "check '" + (scenes / "impact.toml").string() + "'").exit_code,
            0);
}

// Complete failure in some 200 steps, the same bytes each time.
TEST(SampleScenes, ImpactBreaksTheSameWayAgainAndForAnyNumberOfThreads) {
  const fs::path folder = own_folder();
  const std::string scene = HAVERS_SOURCE_DIR "/data_samples/scenes/impact.toml";
  std::string first;
  for (const std::string threads : {"1", "1", "2", "4"}) {
    const auto answer =
        run_havers(folder, "simulate '" + scene + "' -o out --force --json --threads " + threads);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    const auto result = nlohmann::json::parse(answer.out);
    EXPECT_EQ(result["status"], "broken");
    EXPECT_LE(result["energy_defect"].get<double>(), 1e-10);
    const std::string curve = test::read_text(folder / "out/curve.csv");
    if (first.empty()) first = curve;
    EXPECT_EQ(curve, first) << "on " << threads;
  }
}

}  // namespace
}  // namespace havers
