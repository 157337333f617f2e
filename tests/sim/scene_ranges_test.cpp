// What a scene's settings may be: the ends of their ranges, and what goes with what.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/scene.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

using Setter = std::function<void(Scene&, double)>;

// Where a setting's range ends: the last values that are accepted and the first that are refused.
struct Range {
  const char* key;
  Setter set;
  std::vector<double> accepted, refused;
};

std::vector<Range> ranges() {
  constexpr double next = 1e-9;
  constexpr double half_turn = std::numbers::pi;
  return {{"assembly.refinement",
           [](Scene& s, double to) { s.assembly.refinement = static_cast<int>(to); },
           {1, 2, 4},
           {0, 3, 5, 8, -1}},
          {"assembly.orientation_deg",
           [](Scene& s, double to) { s.assembly.orientation = to; },
           {-0.5 * half_turn + next, 0.0, 0.5 * half_turn},
           {-0.5 * half_turn, 0.5 * half_turn + next, NAN}},
          {"material.layer_contrast",
           [](Scene& s, double to) { s.material.layer_contrast = to; },
           {1e-3, 1.0},
           {0.0, -0.5, 1.0 + next, NAN}},
          {"joints.scatter",
           [](Scene& s, double to) { s.joints.scatter = to; },
           {0.0, 2.0 - next},
           {-next, 2.0, NAN}},
          {"joints.missing",
           [](Scene& s, double to) { s.joints.missing = to; },
           {0.0, 1.0 - next},
           {-next, 1.0, NAN}},
          {"loading.max_strain",
           [](Scene& s, double to) { s.loading.max_strain = to; },
           {1e-6, 1.0},
           {0.0, -0.05, 1.0 + next, NAN}},
          {"loading.end_fraction",
           [](Scene& s, double to) { s.loading.end_fraction = to; },
           {0.0, 1.0 - next},
           {-next, 1.0, NAN}},
          {"solver.step_accuracy",
           [](Scene& s, double to) { s.solver.step_accuracy = to; },
           {next, 1.0 - next},
           {0.0, -1e-3, 1.0, NAN}},
          {"solver.tolerance",
           [](Scene& s, double to) { s.solver.tolerance = to; },
           {1e-20, 1.0 - next},
           {0.0, -1e-8, 1.0, NAN}},
          {"solver.max_iterations",
           [](Scene& s, double to) { s.solver.max_iterations = static_cast<int>(to); },
           {1.0},
           {0.0, -1.0}}};
}

// Numbers whose products are numbers, in the unit of their key.
std::vector<Range> positive_numbers() {
  const auto range = [](const char* key, double unit, bool or_zero, Setter set) {
    std::vector<double> accepted{1.1e-30 * unit, 0.9e30 * unit},
        refused{0.9e-30 * unit, 1.1e30 * unit, -unit, INFINITY, NAN};
    (or_zero ? accepted : refused).push_back(0.0);
    return Range{key, std::move(set), accepted, refused};
  };
  return {
      range("material.young_GPa", 1e9, false, [](Scene& s, double to) { s.material.young = to; }),
      range("material.density_kg_m3", 1.0, false,
            [](Scene& s, double to) { s.material.density = to; }),
      range("material.viscosity_s", 1.0, true,
            [](Scene& s, double to) { s.material.viscosity = to; }),
      range("joints.head_tail_MPa", 1e6, false,
            [](Scene& s, double to) { s.joints.head_tail = to; }),
      range("joints.flank_MPa", 1e6, false, [](Scene& s, double to) { s.joints.flank = to; }),
      range("joints.head_tail_shear_MPa", 1e6, true,
            [](Scene& s, double to) { s.joints.head_tail_shear = to; }),
      range("joints.flank_tension_MPa", 1e6, false,
            [](Scene& s, double to) { s.joints.flank_tension = to; }),
      range("joints.friction", 1.0, true, [](Scene& s, double to) { s.joints.friction = to; }),
      range("loading.strain_rate_per_s", 1.0, false,
            [](Scene& s, double to) { s.loading.strain_rate = to; }),
      range("solver.step_s", 1.0, false, [](Scene& s, double to) { s.solver.step = to; })};
}

TEST(Scene, AcceptsAndRefusesUpToTheEndsOfEachRange) {
  std::vector<Range> all = ranges();
  for (Range& range : positive_numbers()) all.push_back(std::move(range));
  for (const Range& range : all) {
    SCOPED_TRACE(range.key);
    for (const double value : range.accepted) {
      Scene scene = test::small_scene();
      range.set(scene, value);
      EXPECT_TRUE(scene.problems().empty()) << value;
    }
    for (const double value : range.refused) {
      Scene scene = test::small_scene();
      range.set(scene, value);
      const std::vector<Scene::Problem> problems = scene.problems();
      ASSERT_EQ(problems.size(), 1U) << value;
      EXPECT_EQ(problems.front().key, range.key) << value;
      EXPECT_THAT(problems.front().what, testing::HasSubstr(", must be ")) << value;
    }
  }
}

// At 1/2 plane strain is incompressible.
TEST(Scene, AcceptsAnIncompressibleMaterialInPlaneStressOnly) {
  for (const auto& [plane, poisson, sound] : {std::tuple{Plane::stress, 0.5, true},
                                              {Plane::stress, 0.5 + 1e-9, false},
                                              {Plane::strain, 0.5 - 1e-9, true},
                                              {Plane::strain, 0.5, false},
                                              {Plane::stress, -1.0, false},
                                              {Plane::stress, -1.0 + 1e-9, true}}) {
    Scene scene = test::small_scene();
    scene.material.plane = plane;
    scene.material.poisson = poisson;
    EXPECT_EQ(scene.problems().empty(), sound) << poisson;
  }
}

// Each fibre is held at an end: joints of the outer layers push, those between pull, at no cost.
TEST(Scene, RefusesThreeLayersOfOneFibreAlongTheLoad) {
  EXPECT_TRUE(test::small_scene(0.0, 2, 1).problems().empty());
  EXPECT_TRUE(test::small_scene(0.0, 3, 2).problems().empty());
  EXPECT_TRUE(test::small_scene(1.0, 3, 1).problems().empty());
  const auto problems = test::small_scene(0.0, 3, 1).problems();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems.front().key, "assembly.fibres");
  EXPECT_EQ(problems.front().what,
            "is 1 in each of 3 layers along the load, which leaves the forces of their joints "
            "undetermined");
  EXPECT_EQ(problems.front().hint, "take 2 fibres or more, or at most 2 layers");
}

// A number, but one of few digits.
TEST(Scene, RefusesARateThatIsNextToNothing) {
  Scene scene;
  scene.loading.strain_rate = 1e-320;
  ASSERT_EQ(scene.problems().size(), 1U);
  EXPECT_EQ(scene.problems().front().key, "loading.strain_rate_per_s");
  EXPECT_THAT(scene.problems().front().what, testing::HasSubstr(", must be from 1e-30 to 1e+30"));
}

TEST(Scene, RefusesFibresAMillionTimesAsLongAsHigh) {
  Scene scene;
  scene.assembly.layers = scene.assembly.fibres = 1;
  scene.assembly.fibre_length = 2e6 * scene.assembly.fibre_height;
  ASSERT_EQ(scene.problems().size(), 1U);
  EXPECT_EQ(scene.problems().front().key, "assembly.fibre_length_um");
}

// A modulus of 1e-300 Pa once was "trusted" and not a number, and such an area is 0.
TEST(Scene, RefusesSizesWhoseProductsAreNoNumbers) {
  Scene scene;
  scene.assembly.fibre_height = 1e-160;
  scene.material.young = 1e-300;
  scene.joints.friction = 1e300;
  const auto problems = scene.problems();
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0].key, "assembly.fibre_height_um");
  EXPECT_EQ(problems[1].key, "material.young_GPa");
  EXPECT_EQ(problems[1].what, "is 1e-309, must be from 1e-30 to 1e+30");
  EXPECT_EQ(problems[2].key, "joints.friction");
}

// A box around a long row that is turned holds the square of its fibres.
TEST(Scene, RefusesAGridThatIsMuchLargerThanTheSpecimen) {
  Scene scene;
  scene.assembly.layers = 1;
  scene.assembly.fibres = 100'000;
  EXPECT_TRUE(scene.problems().empty());
  scene.assembly.orientation = 0.25 * std::numbers::pi;
  ASSERT_EQ(scene.problems().size(), 1U);
  EXPECT_EQ(scene.problems().front().key, "assembly.orientation_deg");
}

}  // namespace
}  // namespace havers::sim
