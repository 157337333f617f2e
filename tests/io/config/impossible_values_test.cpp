// Every value that a scene cannot have, once: sim::Scene::problems() by way of the file that holds
// it.
#include <gmock/gmock.h>

#include <limits>

#include "io/config/read_scene.hpp"
#include "sim/assembly/assembly.hpp"
#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

struct Impossible {
  const char *table, *key_and_value, *sentence;
};

class ImpossibleValue : public testing::TestWithParam<Impossible> {};

TEST_P(ImpossibleValue, IsNamedWithItsLineAndRule) {
  const auto& [table, key_and_value, sentence] = GetParam();
  const test::ScratchFolder folder;
  const std::string text = std::string(table) + "\n" + key_and_value + "\n";
  EXPECT_THAT(test::complaints_of(folder, [&] { read_scene(folder.write("s.toml", text)); }),
              testing::ElementsAre(std::string("s.toml:2: ") + sentence));
}

INSTANTIATE_TEST_SUITE_P(
    OfAScene, ImpossibleValue,
    testing::Values(
        Impossible{"[assembly]", "layers = 0", "assembly.layers: is 0, must be at least 1"},
        Impossible{"[assembly]", "fibres = -2", "assembly.fibres: is -2, must be at least 1"},
        Impossible{"[assembly]", "layers = 2000000",
                   "assembly.layers: times fibres is 4.2e+07 fibres, must be at most 1e+06 (check "
                   "layers and "
                   "fibres)"},
        Impossible{"[assembly]", "fibre_length_um = 0.0",
                   "assembly.fibre_length_um: is 0, must be above 0"},
        Impossible{"[assembly]", "fibre_height_um = -1.0",
                   "assembly.fibre_height_um: is -1, must be above 0"},
        Impossible{"[assembly]", "fibre_length_um = 5.0",
                   "assembly.fibre_length_um: is 5, must be at least fibre_height_um (a fibre is "
                   "longer than "
                   "it is high)"},
        Impossible{
            "[assembly]", "orientation_deg = -90",
            "assembly.orientation_deg: is -90, must be above -90 and at most 90 (the angle between "
            "fibre axis and loading axis)"},
        Impossible{"[material]", "young_GPa = 0", "material.young_GPa: is 0, must be above 0"},
        Impossible{"[material]", "poisson = 0.6",
                   "material.poisson: is 0.6, must be above -1 and at most 0.5"},
        Impossible{"[material]", "poisson = 0.5\nplane = \"strain\"",
                   "material.poisson: is 0.5, must be above -1 and below 0.5 in plane strain"},
        Impossible{"[material]", "density_kg_m3 = 0",
                   "material.density_kg_m3: is 0, must be above 0"},
        Impossible{"[material]", "viscosity_s = -1e-6",
                   "material.viscosity_s: is -1e-06, must be 0 or more"},
        Impossible{"[material]", "layer_contrast = 1.5",
                   "material.layer_contrast: is 1.5, must be above 0 and at most 1"},
        Impossible{"[joints]", "head_tail_MPa = 0", "joints.head_tail_MPa: is 0, must be above 0"},
        Impossible{"[joints]", "flank_MPa = -10", "joints.flank_MPa: is -10, must be above 0"},
        Impossible{"[joints]", "head_tail_shear_MPa = -1",
                   "joints.head_tail_shear_MPa: is -1, must be 0 or more"},
        Impossible{"[joints]", "flank_tension_MPa = 0",
                   "joints.flank_tension_MPa: is 0, must be above 0"},
        Impossible{
            "[joints]", "scatter = 2.0",
            "joints.scatter: is 2, must be at least 0 and below 2 (the length of the interval of "
            "threshold factors)"},
        Impossible{"[joints]", "friction = -0.1", "joints.friction: is -0.1, must be 0 or more"},
        Impossible{"[loading]", "strain_rate_per_s = 0",
                   "loading.strain_rate_per_s: is 0, must be above 0"},
        Impossible{
            "[loading]", "max_strain = 5",
            "loading.max_strain: is 5, must be above 0 and at most 1 (a fraction, not per cent)"},
        Impossible{
            "[loading]", "end_fraction = 1",
            "loading.end_fraction: is 1, must be at least 0 and below 1 (a part of the strength)"},
        Impossible{"[solver]", "step_s = 0", "solver.step_s: is 0, must be above 0"},
        Impossible{"[solver]", "tolerance = 1",
                   "solver.tolerance: is 1, must be above 0 and below 1"},
        Impossible{"[solver]", "max_iterations = 0",
                   "solver.max_iterations: is 0, must be at least 1"},
        Impossible{"[output]", "snapshots = -1", "output.snapshots: is -1, must be 0 or more"}));

std::vector<std::string> problems_of(const sim::Scene& scene) {
  std::vector<std::string> sentences;
  for (const auto& problem : scene.problems())
    sentences.push_back(problem.key + " " + problem.what);
  return sentences;
}

// Stresses in files are judged where they are read; a scene that is made in memory judges them
// itself.
TEST(Scene, ComplainsOfStrengthsThatAreNotPositive) {
  sim::Scene scene;
  scene.joints.head_tail = 0.0;
  scene.joints.flank = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(problems_of(scene), testing::ElementsAre("joints.head_tail_MPa is 0, must be above 0",
                                                       "joints.flank_MPa is nan, must be above 0"));
}

TEST(Scene, ComplainsOfGivenThresholdsThatDoNotFitItsJoints) {
  sim::Scene scene;
  scene.assembly.layers = 2;
  scene.assembly.fibres = 2;
  const std::size_t joints = build_assembly(scene.assembly, scene.loading.lateral).joints.size();
  scene.joints.thresholds.assign(joints, {.normal = 1.0, .tangent = 0.0});
  EXPECT_THAT(problems_of(scene), testing::IsEmpty());
  scene.joints.thresholds[1].normal = 0.0;  // both 0: the joint is missing
  EXPECT_THAT(problems_of(scene), testing::IsEmpty());
  scene.joints.thresholds[1].tangent = 1.0;
  EXPECT_THAT(problems_of(scene),
              testing::ElementsAre(
                  "joints.thresholds_file gives joint 1 f_N = 0 and f_T = 1 N/m, must be f_N "
                  "above 0 and f_T 0 or more, or both 0 for a joint that is missing"));
  scene.joints.thresholds.resize(1);
  scene.joints.scatter = 3.0;  // its joints can be counted all the same
  EXPECT_THAT(problems_of(scene), testing::SizeIs(2));
}

}  // namespace
}  // namespace havers::io
