// The sample study, as a newcomer runs it: the truth is beside it.
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
using test::own_folder;
using test::run_havers;
using testing::HasSubstr;

const fs::path bars = HAVERS_SOURCE_DIR "/data_samples/bone_bars";

TEST(SampleStudy, FindsTheTruthAgainAndIsTrusted) {
  HAVERS_SLOW;
  const fs::path folder = own_folder();
  const auto answer =
      run_havers(folder, "fit '" + (bars / "study.toml").string() + "' -o out --json");
  ASSERT_EQ(answer.exit_code, 0) << answer.out << answer.err;
  const auto result = nlohmann::json::parse(answer.out);
  const auto truth = nlohmann::json::parse(test::contents(bars / "truth.json"));
  const std::map<std::string, double> tolerance{
      {"young_GPa", 0.01}, {"head_tail_MPa", 0.03}, {"ratio", 0.5}};
  ASSERT_EQ(result["parameters"].size(), tolerance.size());
  for (const auto& parameter : result["parameters"]) {
    const auto name = parameter["name"].get<std::string>();
    SCOPED_TRACE(name);
    ASSERT_TRUE(parameter["identifiable"].get<bool>()) << parameter["left_out_because"];
    const double expected = truth["parameters"][name];
    EXPECT_NEAR(parameter["value"].get<double>() / expected, 1.0, tolerance.at(name));
    const double low = parameter["interval_95"][0], high = parameter["interval_95"][1];
    EXPECT_LE(low, expected);
    EXPECT_GE(high, expected);
    EXPECT_LT(high / low, 2.0) << "bounds are a factor of 10 apart, or more";
  }
  EXPECT_EQ(result["specimens"].size(), 6U);
  const std::string cost = fmt::format("cost {:.3g}.", result["cost"].get<double>());
  EXPECT_TRUE(std::ranges::any_of(
      result["verdict"],
      [&](const auto& check) { return check["text"].template get<std::string>().ends_with(cost); }))
      << "one cost under one name: " << cost;

  // The page again, and the calibrated model as a scene of its own.
  const std::string page = test::contents(folder / "out/report.html");
  fs::remove(folder / "out/report.html");
  EXPECT_EQ(run_havers(folder, "report out").exit_code, 0);
  EXPECT_NEAR(static_cast<double>(test::contents(folder / "out/report.html").size()) /
                  static_cast<double>(page.size()),
              1.0, 0.01);
  EXPECT_EQ(run_havers(folder, "report out out/result.json -o both").exit_code, 0);
  const std::string both = test::contents(folder / "both/report.html");
  for (const char* name : {"out (six bone bars)", "out_2 (six bone bars)"})
    EXPECT_THAT(both, HasSubstr(name)) << "fits of one study are told apart";
  fs::create_directories(folder / "second");
  fs::copy(folder / "out", folder / "second/out", fs::copy_options::recursive);
  EXPECT_EQ(run_havers(folder, "report out second/out -o three").exit_code, 0);
  EXPECT_THAT(test::contents(folder / "three/report.html"),
              HasSubstr("second&#x2F;out (six bone bars)"));
  fs::copy_file(folder / "out/result.json", folder / "out/A.json");
  fs::copy_file(folder / "out/result.json", folder / "alone.json");
  EXPECT_EQ(run_havers(folder, "report out/A.json -o copy").exit_code, 0);
  const auto alone = run_havers(folder, "report alone.json -o none");
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_EQ(alone.err,
            "havers: alone.json: has no curves beside it (leave it in the fit's folder, or copy "
            "curves with it)\n");
  const auto refused = run_havers(folder, "report out --set study.name=other");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--set study.name=other: sets nothing"));
  EXPECT_THAT(test::contents(folder / "out/scene.toml"),
              testing::StartsWith("# The fitted model as specimen \"A1\" has it, the first of"));
  EXPECT_EQ(run_havers(folder, "simulate out/scene.toml -o again").exit_code, 0);
}

// The command of its README makes what is there.
TEST(SampleStudy, IsWhatItsCommandMakes) {
  const fs::path folder = own_folder();
  const auto answer = run_havers(
      folder, "synthesize '" + (bars / "study.toml").string() +
                  "' -o made --seed 7 --set model.joints.head_tail_MPa=85 "
                  "--set model.joints.ratio=1.2 --set model.material.young_GPa=16.5 --json");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const auto made = nlohmann::json::parse(answer.out)["specimens"];
  const auto there = nlohmann::json::parse(test::contents(bars / "truth.json"))["specimens"];
  ASSERT_EQ(made.size(), there.size());
  const auto rows = [](const fs::path& file) {
    return std::ranges::count(test::contents(file), '\n');
  };
  for (std::size_t i = 0; i < made.size(); ++i) {
    const auto id = made[i]["id"].get<std::string>();
    SCOPED_TRACE(id);
    for (const char* key : {"scatter", "strength_Pa", "failure_strain", "porosity", "window_sd"})
      EXPECT_NEAR(made[i][key].get<double>() / there[i][key].get<double>(), 1.0, 1e-6) << key;
    EXPECT_EQ(rows(folder / "made" / (id + ".csv")), rows(bars / (id + ".csv")));
    // The file itself has that strength, but for its noise of 0.5 N.
    const calib::RawTest raw = io::read_test(bars / (id + ".csv")).test;
    const double area = raw.width.value() * raw.thickness.value();
    EXPECT_NEAR(std::ranges::max(raw.force), area * there[i]["strength_Pa"].get<double>(), 2.0);
  }
}

// One image is all that there is, however often it is named.
TEST(SampleStudy, SectionsThatAreListedTwiceAreDoubted) {
  HAVERS_SLOW;
  const std::string section = "'" + (bars / "A1_section.png").string() + "'";
  const auto answer =
      run_havers(own_folder(), "porosity " + section + " " + section + " --pixel-size-um 2 --json");
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json["sections"][0]["window_area_um2"], 1000.0);  // as in a fit, to the last bit
  EXPECT_TRUE(json["sections"][0]["warnings"].empty());
  EXPECT_EQ(json["sections"][1]["warnings"][0], "is listed again: it counts twice");

  const fs::path folder = own_folder();
  fs::copy(bars, folder / "bars");
  std::string study = test::contents(bars / "study.toml");
  study.insert(study.find("\"A1_section.png\""), "\"./A1_section.png\", ");
  test::write_text(folder / "bars/twice.toml", study);
  const auto checked = run_havers(folder, "check bars/twice.toml");
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_THAT(checked.out,
              HasSubstr("specimen A1 lists section bars/A1_section.png again: it counts twice"))
      << checked.out;
}

TEST(SampleStudy, DoubtsPixelsThatMakePoresLargerThanFibres) {
  HAVERS_SLOW;
  const fs::path folder = own_folder();
  fs::copy(bars, folder / "bars");
  test::write_text(folder / "bars/large.toml",
                   test::replaced_once(test::contents(bars / "study.toml"), "pixel_size_um = 2.0\n",
                                       "pixel_size_um = 6.0\n"));
  const std::string words = "pores are larger than a fibre and take joints away of A1 (2.4 %): sim";
  EXPECT_THAT(run_havers(folder, "check bars/large.toml").out, HasSubstr(words));
  EXPECT_THAT(run_havers(folder, "check bars/study.toml").out, testing::Not(HasSubstr(words)));
}

TEST(SampleStudy, SaysWhichScatterIsTakenWithoutAPixelSizeAndWhoHasTheSameSection) {
  const fs::path folder = own_folder();
  fs::copy(bars, folder / "bars");
  std::string study = test::contents(bars / "study.toml");
  for (const auto& [what, by] : {std::pair("pixel_size_um = 2.0\n", ""),
                                 {"\"A2_section.png\"", "\"A1_section.png\""},
                                 {"porosity = 0.031", "porosity = 0.6"},
                                 {"sections = [\"B2_section.png\"]\n", ""}})
    study = test::replaced_once(study, what, by);
  test::write_text(folder / "bars/doubtful.toml", study);
  const auto checked =
      run_havers(folder, "check bars/doubtful.toml --set model.joints.scatter=0.3");
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  for (const char* words :
       {"the sections of specimen A1 do not tell the scatter of its joints: 0.3 "
        "(model.joints.scatter) is taken; give its pixel_size_um",
        "nothing tells the scatter of B2, as sections do of others: 0.3 (model.joints.scatter) is "
        "taken",
        "specimens A1 and A2 have the same section, bars/A1_section.png",
        "specimen C1: its sections have a porosity of 0.0", "which counts, and 0.6 is given"})
    EXPECT_NE(checked.out.find(words), std::string::npos) << words << " in\n" << checked.out;
}

TEST(SampleStudy, SectionsHaveThePorosityThatWasDrawn) {
  HAVERS_SLOW;
  const auto truth = nlohmann::json::parse(test::contents(bars / "truth.json"));
  for (const auto& specimen : truth["specimens"]) {
    const auto id = specimen["id"].get<std::string>();
    const auto answer =
        run_havers(own_folder(), "porosity '" + (bars / (id + "_section.png")).string() +
                                     "' --pixel-size-um 2 --json");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    const auto section = nlohmann::json::parse(answer.out);
    EXPECT_EQ(section["sections"][0]["porosity"], section["porosity"]);
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
  HAVERS_SLOW;
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
    const std::string curve = test::contents(folder / "out/curve.csv");
    if (first.empty()) first = curve;
    EXPECT_EQ(curve, first) << "on " << threads;
  }
}

}  // namespace
}  // namespace havers
