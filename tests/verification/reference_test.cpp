// Against the results of an independent program, where its folder is at hand: the environment
// variable HAVERS_REFERENCE names it. Its joints are listed in another order and matched by place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// The number columns of a CSV file by their headings; words count as 0.
using Table = std::map<std::string, std::vector<double>>;

Table read_table(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file.good()) << path;
  std::string line, cell;
  const auto next_line = [&] {
    const bool read = static_cast<bool>(std::getline(file, line));
    if (read && line.ends_with('\r')) line.pop_back();
    return read;
  };
  next_line();
  std::vector<std::string> headings;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) headings.push_back(cell);
  Table table;
  while (next_line()) {
    std::istringstream cells(line);
    for (const std::string& heading : headings) {
      std::getline(cells, cell, ',');
      table[heading].push_back(std::strtod(cell.c_str(), nullptr));
    }
  }
  return table;
}

struct Specimen {
  int degrees, layers, fibres;
};

class Reference : public testing::TestWithParam<Specimen> {
 protected:
  void SetUp() override {
    const char* named = std::getenv("HAVERS_REFERENCE");
    if (named == nullptr) GTEST_SKIP() << "HAVERS_REFERENCE does not name the reference's folder";
    folder = named;
    const auto [degrees, layers, fibres] = GetParam();
    scene = test::small_scene(degrees, layers, fibres);
    scene.joints.reinforced_boundary = false;
    take_thresholds();
  }

  [[nodiscard]] std::string path(const char* kind, const char* what) const {
    return fmt::format("{}/{}-{}deg-{}.csv", folder, kind, GetParam().degrees, what);
  }

  void take_thresholds() {
    const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
    Table joints = read_table(path("quasi-static", "joints"));
    ASSERT_EQ(joints["row"].size(), assembly.joints.size());
    for (const Joint& joint : assembly.joints) {
      std::size_t row = 0;
      while (row < joints["row"].size() &&
             std::hypot(joints["x_m"][row] - joint.position.x(),
                        joints["y_m"][row] - joint.position.y()) > 1e-12)
        ++row;
      ASSERT_LT(row, joints["row"].size()) << "no joint at that place";
      EXPECT_NEAR(joints["length_m"][row], joint.length, 1e-15);
      scene.joints.thresholds.push_back({joints["f_N"][row], joints["f_T"][row]});
      row_of.push_back(static_cast<int>(row));
    }
  }

  std::string folder;
  Scene scene;
  std::vector<int> row_of;  // of each joint
};

class QuasiStaticReference : public Reference {};
INSTANTIATE_TEST_SUITE_P(, QuasiStaticReference,
                         testing::Values(Specimen{0, 6, 4}, Specimen{17, 6, 5}, Specimen{45, 8, 5},
                                         Specimen{90, 6, 4}),
                         [](const auto& test) { return fmt::format("At{}", test.param.degrees); });

// There broken joints carry nothing, here they may be pressed together: the first two events
// cannot differ.
TEST_P(QuasiStaticReference, BreaksTheSameTwoJointsFirst) {
  Table events = read_table(path("quasi-static", "events"));
  std::vector<int> breaks;  // rows of the reference, in the order of breaking
  std::vector<char> broken(row_of.size(), 0);
  const Simulation simulation = simulate(scene, [&](const Progress& progress) {
    const std::vector<JointOutcome> joints = progress.joints();
    for (std::size_t j = 0; j < broken.size(); ++j)
      if (joints[j].broken && broken[j] == 0) {
        broken[j] = 1;
        breaks.push_back(row_of[j]);
      }
  });
  std::size_t same = 0;
  while (same < std::min(breaks.size(), events["row"].size()) &&
         breaks[same] == static_cast<int>(events["row"][same]))
    ++same;
  RecordProperty("equal_events", static_cast<int>(same));
  ASSERT_GE(same, 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const CurvePoint& before = simulation.curve[1 + 2 * i];
    const double strain = events["strain"][i], stress = events["stress_before_Pa"][i];
    EXPECT_NEAR(before.stress_right / before.strain / (stress / strain), 1.0, 1e-6);
    const double reached =
        std::max(strain, events["strain"][0]);  // a later break at less strain is sudden
    EXPECT_NEAR(before.strain / reached, 1.0, 1e-6);
  }
}

class DynamicReference : public Reference {};
INSTANTIATE_TEST_SUITE_P(, DynamicReference, testing::Values(Specimen{0, 6, 4}, Specimen{45, 8, 5}),
                         [](const auto& test) { return fmt::format("At{}", test.param.degrees); });

TEST_P(DynamicReference, FollowsTheSameCurveWellBeyondTheFirstBreaks) {
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = GetParam().degrees == 0 ? 20e-9 : 10e-9;
  Table curve = read_table(path("dynamic", "curve"));
  const Simulation simulation = simulate(scene);
  std::size_t row = 0, first_break = 0;
  const auto agrees = [&](std::size_t i, double accuracy) {
    const CurvePoint& point = simulation.curve[i + 1];  // ours begins at rest, theirs after a step
    return std::abs(point.stress_right - curve["stress_right_Pa"][i]) <
               accuracy * simulation.strength &&
           std::abs(point.stress_left - curve["stress_left_Pa"][i]) <
               accuracy * simulation.strength &&
           point.broken_joints == static_cast<int>(curve["broken_joints"][i]);
  };
  const std::size_t rows = std::min(simulation.curve.size() - 1, curve["step"].size());
  while (first_break < rows && curve["broken_joints"][first_break] == 0.0) ++first_break;
  while (row < rows && agrees(row, 1e-6)) ++row;
  RecordProperty("first_break", static_cast<int>(first_break));
  RecordProperty("parts_at", static_cast<int>(row));
  RecordProperty("rows",
                 fmt::format("{} and {}", simulation.curve.size() - 1, curve["step"].size()));
  EXPECT_GE(row, std::min(rows, first_break + 20));
}

}  // namespace
}  // namespace havers::sim
