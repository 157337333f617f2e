#include "io/config/read_scene.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ReadScene : public testing::Test {
 protected:
  SceneFile read(const std::string& text, const Overrides& overrides = {}) {
    return read_scene(folder.write("scene.toml", text), overrides);
  }
  std::vector<std::string> complaints(const std::string& text, const Overrides& overrides = {}) {
    return test::complaints_of(folder, [&] { read(text, overrides); });
  }
  test::ScratchFolder folder;
};

TEST_F(ReadScene, TakesEveryKeyInItsUnit) {
  folder.write("joints.csv", "joint,f_N,f_T\n1,3,4\n0,1,2\n");
  const SceneFile file = read(R"(
[assembly]
layers = 1
fibres = 1
fibre_length_um = 200.0
fibre_height_um = 20
orientation_deg = 0.0
[material]
young_GPa = 15.5
poisson = 0.3
density_kg_m3 = 1900.0
plane = "strain"
viscosity_s = 1e-6
layer_contrast = 0.4
[joints]
head_tail_MPa = 40.0
flank_MPa = 8.0
head_tail_shear_MPa = 30.0
flank_tension_MPa = 20.0
scatter = 0.4
distribution = "weibull"
friction = 0.1
reinforced_boundary = false
seed = 42
[loading]
strain_rate_per_s = 10.0
lateral = "free"
start = "rest"
max_strain = 0.02
end_fraction = 0.1
[solver]
regime = "quasi-static"
step_s = 1e-7
contact = "gauss-seidel"
tolerance = 1e-9
max_iterations = 77
leave_out = false
[output]
snapshots = 5
)");
  const sim::Scene& scene = file.scene;
  EXPECT_EQ(scene.assembly.layers, 1);
  EXPECT_EQ(scene.assembly.fibres, 1);
  EXPECT_EQ(scene.assembly.fibre_length, 200e-6);
  EXPECT_EQ(scene.assembly.fibre_height, 20e-6);
  EXPECT_EQ(scene.assembly.orientation, 0.0);
  EXPECT_EQ(scene.material.young, 15.5e9);
  EXPECT_EQ(scene.material.poisson, 0.3);
  EXPECT_EQ(scene.material.density, 1900.0);
  EXPECT_EQ(scene.material.layer_contrast, 0.4);
  EXPECT_EQ(scene.material.plane, sim::Plane::strain);
  EXPECT_EQ(scene.material.viscosity, 1e-6);
  EXPECT_EQ(scene.joints.head_tail, 40e6);
  EXPECT_EQ(scene.joints.flank, 8e6);
  EXPECT_EQ(scene.joints.head_tail_shear, 30e6);
  EXPECT_EQ(scene.joints.flank_tension, 20e6);
  EXPECT_EQ(scene.joints.scatter, 0.4);
  EXPECT_EQ(scene.joints.distribution, sim::Distribution::weibull);
  EXPECT_EQ(scene.joints.friction, 0.1);
  EXPECT_EQ(scene.joints.reinforced_boundary, false);
  EXPECT_EQ(scene.joints.seed, 42U);
  EXPECT_EQ(scene.loading.strain_rate, 10.0);
  EXPECT_EQ(scene.loading.lateral, sim::Lateral::free);
  EXPECT_EQ(scene.loading.start, sim::Start::rest);
  EXPECT_EQ(scene.loading.max_strain, 0.02);
  EXPECT_EQ(scene.loading.end_fraction, 0.1);
  EXPECT_EQ(scene.solver.regime, sim::Regime::quasi_static);
  EXPECT_EQ(scene.solver.step, 1e-7);
  EXPECT_EQ(scene.solver.contact, sim::ContactMethod::gauss_seidel);
  EXPECT_EQ(scene.solver.tolerance, 1e-9);
  EXPECT_EQ(scene.solver.max_iterations, 77);
  EXPECT_FALSE(scene.solver.leave_out);
  EXPECT_EQ(file.snapshots, 5);
}

TEST_F(ReadScene, TakesWholeNumbersOfAnySizeForNumbers) {
  const SceneFile file = read("[material]\ndensity_kg_m3 = 9223372036854775807\n");
  EXPECT_EQ(file.scene.material.density, 0x1p63);
}

TEST_F(ReadScene, WithoutAKeyInItsTableIsTheDefaultScene) {
  const SceneFile file = read("[assembly]\n");
  EXPECT_EQ(file.scene.assembly.layers, 30);
  EXPECT_EQ(file.scene.joints.flank, 10e6);
  EXPECT_FALSE(file.scene.joints.reinforced_boundary.has_value());
  EXPECT_FALSE(file.scene.solver.step.has_value());
  EXPECT_EQ(file.snapshots, 0);
}

// (M9) with N = 10, L/l = 8: Σ = σ₁ + 4.4 σ₂ and r = σ₁ / (4 σ₂); σ₁ = 40, σ₂ = 10 give Σ = 84, r
// = 1.
TEST_F(ReadScene, TakesTheStrengthsFromAnyTwoThatDetermineThem) {
  const std::string assembly =
      "[assembly]\nlayers = 10\nfibre_length_um = 80\nfibre_height_um = 10\n[joints]\n";
  for (const char* pair :
       {"head_tail_MPa = 40\nflank_MPa = 10", "resultant_MPa = 84\nratio = 1",
        "head_tail_MPa = 40\nratio = 1", "flank_MPa = 10\nratio = 1",
        "head_tail_MPa = 40\nresultant_MPa = 84", "flank_MPa = 10\nresultant_MPa = 84"}) {
    const sim::JointOptions joints = read(assembly + pair).scene.joints;
    EXPECT_NEAR(joints.head_tail, 40e6, 1e-6) << pair;
    EXPECT_NEAR(joints.flank, 10e6, 1e-6) << pair;
  }
}

TEST_F(ReadScene, KeepsTheOtherStrengthWhenOneIsGiven) {
  EXPECT_EQ(read("[joints]\nhead_tail_MPa = 70").scene.joints.flank, 10e6);
  EXPECT_EQ(read("[joints]\nflank_MPa = 7").scene.joints.head_tail, 50e6);
  const sim::Scene scene = read("[joints]\nratio = 3").scene;
  EXPECT_EQ(scene.joints.head_tail, 50e6);
  EXPECT_DOUBLE_EQ(sim::ratio(scene.assembly, scene.joints), 3.0);
}

TEST_F(ReadScene, RefusesStrengthsThatAreTooManyOrTooFewOrContradictThemselves) {
  EXPECT_THAT(complaints("[joints]\nratio = 1\nflank_MPa = 10\nresultant_MPa = 100"),
              ElementsAre("scene.toml:1: joints: gives 3 strengths, two determine all (give two of "
                          "head_tail_MPa, flank_MPa, resultant_MPa and ratio)"));
  EXPECT_THAT(
      complaints("[joints]\nresultant_MPa = 100"),
      ElementsAre("scene.toml:2: joints.resultant_MPa: does not determine the strengths alone "
                  "(give two of head_tail_MPa, flank_MPa, resultant_MPa and ratio)"));
  EXPECT_THAT(
      complaints("[joints]\nresultant_MPa = 40\nhead_tail_MPa = 50"),
      ElementsAre(
          "scene.toml:2: joints.resultant_MPa: is 40, less than the given stress contributes "
          "alone (resultant = head_tail + (1 + 1/layers)/2 fibre_length/fibre_height flank)"));
  EXPECT_THAT(complaints("[joints]\nratio = -1"),
              ElementsAre("scene.toml:2: joints.ratio: is -1, must be above 0"));
}

TEST_F(ReadScene, NamesTheNearestKeyOfAnUnknownOne) {
  EXPECT_THAT(
      complaints("[joints]\nscater = 0.3\n[lodaing]\nx = 1\n"),
      ElementsAre("scene.toml:3: lodaing: is not a known key (did you mean loading?)",
                  "scene.toml:2: joints.scater: is not a known key (did you mean scatter?)"));
  // Two letters changed their places; a height is as many letters off.
  EXPECT_THAT(
      complaints("[assembly]\nfibre_lenght_um = 3\n"),
      ElementsAre("scene.toml:2: assembly.fibre_lenght_um: is not a known key (did you mean "
                  "fibre_length_um?)"));
}

TEST_F(ReadScene, NamesWrongTypes) {
  EXPECT_THAT(
      complaints(
          "material = 3\n[assembly]\nlayers = 3.5\nfibres = \"many\"\nfibre_length_um = true\n"
          "[joints]\nreinforced_boundary = 1\ndistribution = [1]\nscatter = nan\nfriction = {}\n"
          "seed = -1\n[solver]\nregime = \"quasistatic\"\nstep_s = 2020-01-01\n"
          "max_iterations = 99999999999\n"),
      ElementsAre("scene.toml:3: assembly.layers: is 3.5, must be a whole number",
                  "scene.toml:4: assembly.fibres: is a text, must be a whole number",
                  "scene.toml:5: assembly.fibre_length_um: is true or false, must be a number",
                  "scene.toml:1: material: is a number, must be a table",
                  "scene.toml:9: joints.scatter: is nan, must be finite",
                  "scene.toml:8: joints.distribution: is a list, must be a text",
                  "scene.toml:10: joints.friction: is a table, must be a number",
                  "scene.toml:7: joints.reinforced_boundary: is a number, must be true or false",
                  "scene.toml:11: joints.seed: is -1, must be 0 or more",
                  "scene.toml:13: solver.regime: is \"quasistatic\", must be one of: auto, "
                  "dynamic, quasi-static "
                  "(did you mean quasi-static?)",
                  "scene.toml:14: solver.step_s: is a date or time, must be a number",
                  "scene.toml:15: solver.max_iterations: is 99999999999, must be at most "
                  "1000000000 in size"));
}

// Their squares and quotients would leave the numbers that can be computed with.
TEST_F(ReadScene, RefusesNumbersThatNothingMeasuredCanBe) {
  EXPECT_THAT(
      complaints("[material]\nyoung_GPa = 1e300\n[joints]\nhead_tail_MPa = 1e-300\nflank_MPa = "
                 "-1e31\n[loading]\nstrain_rate_per_s = 1e-30\n"),
      ElementsAre("scene.toml:2: material.young_GPa: is 1e+300, must be at most 1e+30 in size",
                  "scene.toml:4: joints.head_tail_MPa: is 1e-300, must be 0 or at least 1e-30 in "
                  "size",
                  "scene.toml:5: joints.flank_MPa: is -1e+31, must be at most 1e+30 in size"));
}

TEST_F(ReadScene, NamesTheTableThatAKeyIsOf) {
  EXPECT_THAT(complaints("young_GPa = 13\n[assembly]\nscatter = 0.3\n"),
              ElementsAre("scene.toml:1: young_GPa: is not a known key (it is a key of [material])",
                          "scene.toml:3: assembly.scatter: is not a known key (it is a key of "
                          "[joints])"));
}

TEST_F(ReadScene, NamesTheKnownKeysWhereNoneIsNear) {
  EXPECT_THAT(complaints("[output]\nfilm = 3\n[zzz]\na = 1\n"),
              ElementsAre("scene.toml:3: zzz: is not a known key (known are assembly, joints, "
                          "loading, material, output, solver)",
                          "scene.toml:2: output.film: is not a known key (known are snapshots)"));
}

TEST_F(ReadScene, LetsTheCommandLineOverrideTheFile) {
  const SceneFile file =
      read("[joints]\nscatter = 0.3\nfriction = 0.2\n",
           {"joints.scatter=0.5", "assembly.orientation_deg = 45", "solver.regime=dynamic",
            "joints.scatter=0.6", "loading.start=\"rest\""});
  EXPECT_EQ(file.scene.joints.scatter, 0.6);
  EXPECT_EQ(file.scene.joints.friction, 0.2);
  EXPECT_EQ(file.scene.assembly.orientation, std::numbers::pi / 4.0);
  EXPECT_EQ(file.scene.solver.regime, sim::Regime::dynamic);
  EXPECT_EQ(file.scene.loading.start, sim::Start::rest);
}

TEST_F(ReadScene, BlamesTheCommandLineForWhatItOverrides) {
  EXPECT_THAT(
      complaints("[joints]\nscatter = 0.3\n",
                 {"joints.scatter=3", "joints.frction=1", "solver.regime=fast"}),
      ElementsAre("--set solver.regime: is \"fast\", must be one of: auto, dynamic, quasi-static",
                  "--set joints.scatter: is 3, must be at least 0 and below 2 (the length of the "
                  "interval of threshold factors)",
                  "--set joints.frction: is not a known key (did you mean friction?)"));
  EXPECT_THAT(complaints("[joints]\n", {"joints.seed=18446744073709551615"}),
              ElementsAre("--set joints.seed: is 18446744073709551615, must be at most 2^63 - "
                          "1"));
  EXPECT_THAT(complaints("[joints]\n", {"joints.seed=9223372036854775807"}), ElementsAre());
  EXPECT_THAT(complaints("[joints]\n", {"joints.scatter", "joints.seed= ", "=3"}),
              ElementsAre("--set joints.scatter: has no value (write --set joints.scatter=0.3)",
                          "--set joints.seed: has no value (write --set joints.scatter=0.3)",
                          HasSubstr("--set : is not TOML")));
}

TEST_F(ReadScene, NeedsANameOfAFile) {
  EXPECT_THAT(complaints("[joints]\nthresholds_file = \"\"\n"),
              ElementsAre("scene.toml:2: joints.thresholds_file: is empty, must name a file"));
}

TEST_F(ReadScene, SaysWhatChangesNothingBesideThresholds) {
  folder.write("joints.csv", "joint,f_N,f_T\n0,1,1\n1,1,1\n2,1,1\n");
  const std::string text =
      "[assembly]\nlayers = 2\nfibres = 1\n[joints]\nscatter = 0.3\nseed = 4\n";
  EXPECT_THAT(read(text).warnings, testing::IsEmpty());
  EXPECT_THAT(read(text + "thresholds_file = \"joints.csv\"\n", {"joints.missing=0.1"}).warnings,
              ElementsAre(HasSubstr("joints.seed changes nothing"),
                          HasSubstr("joints.scatter changes nothing"),
                          HasSubstr("joints.missing changes nothing")));
}

TEST_F(ReadScene, ReadsThresholdsBesideIt) {
  folder.write("sub/joints.csv", "f_T,joint,f_N\n4,1,3\n2,0,1\n");
  const std::string text = "[assembly]\nlayers = 1\nfibres = 1\n[joints]\nthresholds_file = \"sub/";
  // The assembly has no joint at all, and says so.
  EXPECT_THAT(
      complaints(text + "joints.csv\"\n"),
      ElementsAre(
          "scene.toml:5: joints.thresholds_file: names 2 joints, the assembly has 0 (write a "
          "matching file with havers simulate: joints.csv)"));
  EXPECT_THAT(
      complaints(text + "none.csv\"\n"),
      ElementsAre("scene.toml:5: joints.thresholds_file: names sub/none.csv, which is not there "
                  "(paths are relative to the folder of this file)"));
  EXPECT_THAT(complaints(text + "joints.csv\"\n", {"joints.thresholds_file=none.csv"}),
              ElementsAre("--set joints.thresholds_file: names none.csv, which is not there (paths "
                          "are relative to the folder of scene.toml)"));
  folder.write("sub/empty.csv", "joint,f_N,f_T\n");
  EXPECT_THAT(complaints(text + "empty.csv\"\n"), ElementsAre(HasSubstr("holds no joint")));
  folder.write("sub/bad.csv", "joint,f_N,f_T\n0,one,2\n");
  EXPECT_THAT(complaints(text + "bad.csv\"\n"),
              ElementsAre("sub/bad.csv:2: column f_N holds \"one\", must be a number"));
}

}  // namespace
}  // namespace havers::io
