#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/config/read_scene.hpp"
#include "io/results/result_files.hpp"
#include "tests/io/complaints.hpp"
#include "tests/support/results.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

sim::Scene small_scene() {
  sim::Scene scene;
  scene.assembly.layers = 4;
  scene.assembly.fibres = 3;
  return scene;
}

TEST(CurveFile, HoldsTheColumnsOfTheContractWithoutLoss) {
  const test::ScratchFolder folder;
  sim::Simulation simulation;
  simulation.curve = {{0.0, 0.0, 0.0, 0.0, 0, 0.0, 0.0, 0.0},
                      {2e-8, 0.1 + 0.2, 13e9 / 7.0, -1e-300, 3, 1.5, 1e22, 0.1}};
  write_curve(folder.path() / "curve.csv", simulation);
  EXPECT_THAT(
      lines(test::contents(folder.path() / "curve.csv")),
      ElementsAre("time_s,strain,stress_right_Pa,stress_left_Pa,broken_joints,kinetic_J_per_m,"
                  "elastic_J_per_m,dissipated_J_per_m",
                  "0,0,0,0,0,0,0,0",
                  "2e-08,0.30000000000000004,1857142857.142857,-1e-300,3,1.5,1e+22,0.1"));
}

TEST(CurveFile, HoldsNoNegativeZero) {
  const test::ScratchFolder folder;
  sim::Simulation simulation;
  simulation.curve = {{0.0, 0.0, 0.0, -0.0, 0, 0.0, 0.0, 0.0}};
  write_curve(folder.path() / "curve.csv", simulation);
  EXPECT_EQ(lines(test::contents(folder.path() / "curve.csv"))[1], "0,0,0,0,0,0,0,0");
}

TEST(JointsFile, HoldsTheColumnsOfTheContract) {
  const test::ScratchFolder folder;
  sim::Assembly assembly;
  assembly.joints.resize(2);
  assembly.joints[0].kind = sim::JointKind::head_tail;
  assembly.joints[0].position = {1e-4, 5e-6};
  assembly.joints[0].normal = {1.0, 0.0};
  assembly.joints[0].length = 1e-5;
  assembly.joints[1].position = {2e-4, 0.5};
  assembly.joints[1].normal = {0.0, -1.0};
  sim::Simulation simulation;
  simulation.joints = {{{500.0, 250.0}, true, 0.003, 1.0, -2.0, 1e-9},
                       {{400.0, 200.0}, false, test::nan, -3.0, 4.0, 0.0}};
  write_joints(folder.path() / "joints.csv", assembly, simulation);
  EXPECT_THAT(
      lines(test::contents(folder.path() / "joints.csv")),
      ElementsAre("joint,kind,x_m,y_m,normal_x,normal_y,length_m,f_N,f_T,status,broken_at_strain,"
                  "reaction_N_N_per_m,reaction_T_N_per_m,gap_m",
                  "0,head_tail,0.0001,5e-06,1,0,1e-05,500,250,broken,0.003,1,-2,1e-09",
                  "1,flank,0.0002,0.5,0,-1,0,400,200,bonded,,-3,4,0"));
}

TEST(JointsFile, IsReadBackAsTheThresholdsOfAScene) {
  const test::ScratchFolder folder;
  const sim::Scene scene = small_scene();
  const sim::Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  sim::Simulation simulation = test::simulation_sample(assembly);
  for (std::size_t i = 0; i < simulation.joints.size(); ++i)
    simulation.joints[i].threshold = {100.0 + 1.0 / (1.0 + static_cast<double>(i)), 7.0};
  write_joints(folder.path() / "joints.csv", assembly, simulation);

  const auto file = folder.write("scene.toml", scene_toml(scene));
  const sim::Scene again = read_scene(file, {"joints.thresholds_file=joints.csv"}).scene;
  ASSERT_EQ(again.joints.thresholds.size(), assembly.joints.size());
  for (std::size_t i = 0; i < simulation.joints.size(); ++i) {
    EXPECT_EQ(again.joints.thresholds[i].normal, simulation.joints[i].threshold.normal);
    EXPECT_EQ(again.joints.thresholds[i].tangent, 7.0);
  }
}

TEST(SimulationJson, HoldsTheKeysOfTheContract) {
  const sim::Scene scene = small_scene();
  sim::Simulation simulation =
      test::simulation_sample(build_assembly(scene.assembly, scene.loading.lateral));
  simulation.first_break_strain = test::nan;
  simulation.joints.front() = {.threshold = {0.0, 0.0}, .broken = true};
  simulation.worst_penetration = std::numeric_limits<double>::infinity();
  simulation.step_error =
      sim::StepError{.failure_strain = 1e-4, .strength = 2e-4, .over_a_wave = 3e-4};
  simulation.strength_over_a_wave = 37e6;
  simulation.ringing = 0.25;
  simulation.rounding_error = 4e-12;
  simulation.numerical_loss = 5e-3;
  simulation.energy_gain = 6e-3;
  calib::Provenance provenance;
  provenance.havers = "0.1.0";
  provenance.compiler = "GNU 12.2.0";
  provenance.command = "havers simulate s.toml -o r";
  provenance.inputs = {{"s.toml", "abcd"}};
  provenance.wall_seconds = 1.5;
  provenance.cpu_seconds = 2.5;

  const nlohmann::json json = nlohmann::json::parse(
      simulation_json({.scene = scene, .snapshots = 2}, simulation, provenance).dump());
  EXPECT_EQ(json["status"], "broken");
  EXPECT_EQ(json["trusted"], true);
  EXPECT_EQ(json["strength_Pa"], 38.9e6);
  EXPECT_EQ(json["failure_strain"], 0.003);
  EXPECT_EQ(json["modulus_Pa"], 13e9);
  EXPECT_TRUE(json["first_break_strain"].is_null());
  EXPECT_EQ(json["broken_joints"], simulation.broken_joints);
  EXPECT_EQ(json["missing_joints"], 1);
  EXPECT_EQ(json["end_fraction_used"], 0.3);
  EXPECT_EQ(json["steps"], 400);
  EXPECT_EQ(json["energy_defect"], 3.2e-14);
  EXPECT_EQ(json["worst_residual"], 6.1e-10);
  EXPECT_EQ(json["residual_to_strength"], 5.9e-10);
  EXPECT_TRUE(json["worst_penetration_m"].is_null());
  EXPECT_EQ(json["wall_s"], 1.5);
  EXPECT_EQ(json["regime"], "dynamic");
  EXPECT_EQ(json["step_s"], 2e-8);
  EXPECT_EQ(json["step_error"], 1e-4);
  EXPECT_EQ(json["step_error_of_strength"], 2e-4);
  EXPECT_EQ(json["step_error_over_a_wave"], 3e-4);
  EXPECT_EQ(json["strength_over_a_wave_Pa"], 37e6);
  EXPECT_EQ(json["strength_without_ringing_Pa"], 38.9e6 / 1.25);
  EXPECT_EQ(json["rounding_error"], 4e-12);
  EXPECT_EQ(json["numerical_loss"], 5e-3);
  EXPECT_EQ(json["energy_gain"], 6e-3);
  EXPECT_EQ(json["iterations"], 5127);
  EXPECT_EQ(json["left_out"][0]["what"], "snapshots");
  EXPECT_EQ(json["left_out"][0]["why"], "none were asked for");
  EXPECT_EQ(json["scene"]["assembly"]["layers"], 4);
  EXPECT_EQ(json["scene"]["joints"]["reinforced_boundary"], true);  // the default at 0°, filled in
  EXPECT_EQ(json["scene"]["output"]["snapshots"], 2);
  EXPECT_EQ(json["provenance"]["havers"], "0.1.0");
  EXPECT_EQ(json["provenance"]["compiler"], "GNU 12.2.0");
  EXPECT_EQ(json["provenance"]["command"], "havers simulate s.toml -o r");
  EXPECT_EQ(json["provenance"]["inputs"]["s.toml"], "abcd");
  EXPECT_EQ(json["provenance"]["cpu_s"], 2.5);
}

TEST(SimulationJson, HasNoNumberForWhatIsNotKnown) {
  const sim::Scene scene = small_scene();
  sim::Simulation simulation =
      test::simulation_sample(build_assembly(scene.assembly, scene.loading.lateral));
  simulation.step_error.reset();  // a step was given
  simulation.status = sim::SimulationStatus::strain_limit;
  const nlohmann::json json = simulation_json({.scene = scene}, simulation, {});
  for (const char* key : {"step_error", "step_error_of_strength", "step_error_over_a_wave",
                          "strength_over_a_wave_Pa", "failure_strain"})
    EXPECT_TRUE(json.at(key).is_null()) << key;
}

TEST(Thresholds, MustNameEveryJointOnce) {
  const test::ScratchFolder folder;
  const auto refused = [&](const std::string& text) {
    return test::refusal_of([&] { read_thresholds(folder.write("t.csv", text)); });
  };
  EXPECT_THAT(refused("joint,f_N,f_T\n0,1,2\n0,3,4\n"),
              HasSubstr("t.csv:3: names joint 0 again, after line 2"));
  EXPECT_THAT(
      refused("joint,f_N,f_T\n1,1,2\n"),
      HasSubstr("t.csv:2: joint is 1, must be a whole number from 0 to 0, as many as rows"));
  EXPECT_THAT(refused("joint,f_N,f_T\n0,1,2\n0.5,1,2\n"), HasSubstr("t.csv:3: joint is 0.5"));
  EXPECT_THAT(refused("joint,f_N\n0,1\n"),
              HasSubstr("t.csv:1: has no column f_T (the columns needed are joint,f_N,f_T)"));
  EXPECT_THAT(refused("joint,f_N,f_T\n0,1,x\n"),
              HasSubstr("t.csv:2: column f_T holds \"x\", must be a number"));
  EXPECT_THAT(refused("joint,f_N,f_T\n0,nan,1\n"),
              HasSubstr("t.csv:2: column f_N holds \"nan\", must be a number"));
  EXPECT_THAT(refused("joint,f_N,f_T\n0,1,2\n1,,2\n"),
              HasSubstr("t.csv:3: column f_N is empty, must be a number"));
  EXPECT_THAT(refused("joint,f_N,f_T\n,1,2\n"),
              HasSubstr("t.csv:2: column joint is empty, must be a number"));
  EXPECT_THAT(refused("joint,f_N,f_T\n0,1\n"),
              HasSubstr("t.csv:2: column f_T is empty, must be a number"));
  EXPECT_THAT(refused("joint,f_N,f_T\n0,505,58,7,9\n"),
              HasSubstr("t.csv:2: has 5 cells, the header has 3 (is the decimal mark also"));
  EXPECT_THAT(refused("joint;f_N;f_T\n0;1,5;2\n"),
              testing::EndsWith("t.csv:1: has one column, \"joint;f_N;f_T\" (separate cells by "
                                "commas, and write decimals with a point)"));
  EXPECT_EQ(read_thresholds(folder.write("t.csv", "\xEF\xBB\xBFjoint,f_N,f_T\n0,1,2\n"))
                .thresholds.size(),
            1U);
  EXPECT_THAT(refused(""), HasSubstr("t.csv: is empty (the columns needed are joint,f_N,f_T)"));
  EXPECT_THAT(test::refusal_of([&] { read_thresholds(folder.path() / "none.csv"); }),
              HasSubstr("none.csv: is not there (a CSV file"));
}

TEST(WriteFile, ReplacesAFileWhole) {
  const test::ScratchFolder folder;
  const auto file = folder.write("a.txt", "an older and longer text");
  write_file(file, "new");
  EXPECT_EQ(test::contents(file), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(WriteFile, LeavesNothingWhereItCannotWrite) {
  const test::ScratchFolder folder;
  folder.write("taken/inside", "");
  EXPECT_THAT(test::refusal_of([&] { write_file(folder.path() / "taken", "text"); }),
              HasSubstr("taken: cannot be written: "));
  EXPECT_THAT(test::refusal_of([&] { write_file(folder.path() / "no" / "a.txt", "text"); }),
              HasSubstr("a.txt: cannot be written: No such file or directory"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace havers::io
