#include "io/config/read_study.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

class ReadStudy : public testing::Test {
 protected:
  StudyFile read(const std::string& text, const Overrides& overrides = {},
                 Files files = Files::will_be_written) {
    return read_study(folder.write("study.toml", text), overrides, files);
  }
  std::vector<std::string> complaints(const std::string& text,
                                      Files files = Files::will_be_written) {
    return test::complaints_of(folder, [&] { read(text, {}, files); });
  }
  test::ScratchFolder folder;
};

const std::string one_specimen = "[[specimen]]\nid = \"A1\"\ntest = \"A1.csv\"\n";

TEST_F(ReadStudy, TakesColumnsAndCorrections) {
  const StudyFile file = read(one_specimen + R"(
specimen_in_file = "South"
[specimen.columns]
force = "Channel 3"
force_unit = "500 N/V"
extension_unit = "in"
[specimen.gauge_columns]
strain = "2"
[reduction]
remove_toe = false
mend_slips = false
machine_compliance_mm_per_kN = 0.02
largest_noise = 0.1
)");
  const SpecimenFiles& specimen = file.specimens.at(0);
  EXPECT_EQ(specimen.columns.specimen, "South");
  EXPECT_EQ(specimen.columns.columns.at(Quantity::force).column, "Channel 3");
  EXPECT_EQ(specimen.columns.columns.at(Quantity::force).unit, "500 N/V");
  EXPECT_EQ(specimen.columns.units, (std::map<Quantity, std::string>{{Quantity::extension, "in"}}));
  EXPECT_FALSE(specimen.columns.logger);
  EXPECT_EQ(specimen.gauge_columns.columns.at(Quantity::strain).column, "2");
  EXPECT_TRUE(specimen.gauge_columns.logger);
  EXPECT_FALSE(file.reduction.remove_toe);
  EXPECT_FALSE(file.reduction.mend_slips);
  EXPECT_TRUE(file.reduction.remove_spikes);
  EXPECT_DOUBLE_EQ(file.reduction.machine_compliance, 20e-9);
  EXPECT_DOUBLE_EQ(file.reduction.largest_noise, 0.1);
  EXPECT_EQ(complaints(one_specimen + "[reduction]\nbreak_part = 1.5\n").size(), 1U);
}

TEST_F(ReadStudy, TakesEveryKeyInItsUnit) {
  for (const char* name : {"a/A1.csv", "A1_gauge.csv", "s1.png", "s2.png"}) folder.write(name, "");
  const StudyFile file = read(R"(
[study]
name = "bovine femur A"
[[specimen]]
id = "A1"
test = "a/A1.csv"
gauge = "A1_gauge.csv"
width_mm = 4.0
thickness_mm = 2
gauge_length_mm = 25.0
orientation_deg = 45
sections = ["s1.png", "s2.png"]
pixel_size_um = 5.0
porosity = 0.05
use = "validate"
[[specimen]]
id = "A2"
test = "a/A1.csv"
[model.assembly]
layers = 12
[model.joints]
resultant_MPa = 100.0
ratio = 2.0
[model.output]
snapshots = 0
[porosity]
to_scatter = "linear"
to_modulus = "power"
strength_exponent = 1.5
linear_offset = 0.1
linear_slope = 2.0
modulus_exponent = 3.0
[calibrate]
parameters = ["young_GPa", "friction"]
[calibrate.bounds]
young_GPa = [5.0, 30]
[calibrate.level]
young_GPa = "orientation"
[calibrate.options]
replicates = 4
budget = 100
seed = 9
[synthesize]
force_noise_N = 0.25
strain_noise = 1e-6
preload_N = 5.0
toe_strain = 2e-4
sampling_s = 0.05
crosshead_mm_per_min = 6.0
pore_radius_um = 10.0
modulus_cv = 0.02
section_pixels = 256
)",
                              {}, Files::must_exist);
  EXPECT_EQ(file.study.name, "bovine femur A");
  ASSERT_EQ(file.specimens.size(), 2U);
  const SpecimenFiles& specimen = file.specimens[0];
  EXPECT_EQ(specimen.id, "A1");
  EXPECT_EQ(specimen.test, folder.path() / "a/A1.csv");
  EXPECT_EQ(specimen.gauge, folder.path() / "A1_gauge.csv");
  EXPECT_EQ(specimen.width, 4e-3);
  EXPECT_EQ(specimen.thickness, 2e-3);
  EXPECT_EQ(specimen.gauge_length, 25e-3);
  EXPECT_EQ(specimen.orientation, std::numbers::pi / 4.0);
  EXPECT_THAT(specimen.sections, ElementsAre(folder.path() / "s1.png", folder.path() / "s2.png"));
  EXPECT_EQ(specimen.pixel_size, 5e-6);
  EXPECT_EQ(specimen.porosity, 0.05);
  EXPECT_EQ(specimen.use, calib::Use::validate);
  EXPECT_EQ(file.specimens[1].use, calib::Use::fit);
  EXPECT_FALSE(file.specimens[1].width || file.specimens[1].gauge || file.specimens[1].porosity);

  ASSERT_EQ(file.study.specimens.size(), 2U);
  EXPECT_EQ(file.study.specimens[0].id, "A1");
  EXPECT_EQ(file.study.specimens[0].use, calib::Use::validate);
  EXPECT_EQ(file.study.specimens[0].orientation, std::numbers::pi / 4.0);
  EXPECT_EQ(file.study.specimens[0].porosity, 0.05);

  const sim::Scene& model = file.study.model;
  EXPECT_EQ(model.assembly.layers, 12);
  EXPECT_DOUBLE_EQ(sim::resultant(model.assembly, model.joints), 100e6);
  EXPECT_DOUBLE_EQ(sim::ratio(model.assembly, model.joints), 2.0);

  EXPECT_EQ(file.study.porosity.to_scatter, calib::ToScatter::linear);
  EXPECT_EQ(file.study.porosity.to_modulus, calib::ToModulus::power);
  EXPECT_EQ(file.study.porosity.strength_exponent, 1.5);
  EXPECT_EQ(file.study.porosity.linear_offset, 0.1);
  EXPECT_EQ(file.study.porosity.linear_slope, 2.0);
  EXPECT_EQ(file.study.porosity.modulus_exponent, 3.0);

  const calib::CalibrateOptions& calibrate = file.study.calibrate;
  EXPECT_THAT(calibrate.parameters, ElementsAre("young_GPa", "friction"));
  EXPECT_FALSE(calibrate.automatic);
  EXPECT_THAT(calibrate.bounds, ElementsAre(Pair("young_GPa", Pair(5.0, 30.0))));
  EXPECT_THAT(calibrate.level, ElementsAre(Pair("young_GPa", calib::Level::orientation)));
  EXPECT_EQ(calibrate.replicates, 4);
  EXPECT_EQ(calibrate.budget, 100);
  EXPECT_EQ(calibrate.seed, 9U);

  EXPECT_EQ(file.synthesize.laboratory.force_noise, 0.25);
  EXPECT_EQ(file.synthesize.laboratory.strain_noise, 1e-6);
  EXPECT_EQ(file.synthesize.laboratory.preload, 5.0);
  EXPECT_EQ(file.synthesize.laboratory.toe_strain, 2e-4);
  EXPECT_EQ(file.synthesize.laboratory.sampling, 0.05);
  EXPECT_DOUBLE_EQ(file.synthesize.laboratory.crosshead_rate, 1e-4);
  EXPECT_EQ(file.synthesize.pore_radius, 10e-6);
  EXPECT_EQ(file.synthesize.modulus_cv, 0.02);
  EXPECT_EQ(file.synthesize.section_pixels, 256);
}

TEST_F(ReadStudy, TakesAutoAsTheChoiceOfParameters) {
  EXPECT_TRUE(
      read(one_specimen + "[calibrate]\nparameters = \"auto\"\n").study.calibrate.automatic);
  EXPECT_THAT(
      complaints(one_specimen + "[calibrate]\nparameters = \"all\"\n"),
      ElementsAre(
          "study.toml:5: calibrate.parameters: is \"all\", must be a list of names (or \"auto\": "
          "what the specimens inform)"));
}

TEST_F(ReadStudy, WarnsOfKeysThatChangeNothing) {
  const std::string study = one_specimen + R"([model.assembly]
orientation_deg = 45
[model.output]
snapshots = 3
[calibrate]
parameters = ["young_GPa"]
[calibrate.bounds]
young_GPa = [5, 30]
ratio = [1, 2]
[calibrate.level]
friction = "specimen"
)";
  EXPECT_THAT(read(study).warnings,
              ElementsAre("calibrate.bounds.ratio changes nothing: ratio is not fitted",
                          "calibrate.level.friction changes nothing: friction is not fitted",
                          "model.assembly.orientation_deg changes nothing: every specimen has its "
                          "own",
                          "model.output.snapshots changes nothing: a fit writes none"));
  EXPECT_THAT(read(study, {"calibrate.parameters=auto"}).warnings, testing::SizeIs(3));
  EXPECT_THAT(read(one_specimen + "[model.output]\nsnapshots = 0\n").warnings, IsEmpty());
}

TEST_F(ReadStudy, SaysWhichKeysChangeNothing) {
  const auto warnings = [&](const std::string& tables) {
    return read(one_specimen + tables).warnings;
  };
  EXPECT_THAT(warnings("[model.joints]\nseed = 2\n"),
              ElementsAre("model.joints.seed changes nothing: calibrate.options.seed draws the "
                          "thresholds"));
  EXPECT_THAT(warnings("[sections]\nrim_um = 3\n[porosity]\nto_scatter = \"linear\"\n"),
              ElementsAre("sections changes nothing: no specimen has any",
                          "porosity changes nothing: no specimen has sections or a porosity"));
  const std::string no_window =
      "porosity of specimen A1 changes nothing for the scatter: \"window\" needs sections";
  EXPECT_THAT(
      warnings("porosity = 0.1\npixel_size_um = 2\ngauge_columns.force = 2\n"),
      ElementsAre("gauge_columns of specimen A1 changes nothing: it has no gauge",
                  "pixel_size_um of specimen A1 changes nothing: it has no sections", no_window));
  EXPECT_THAT(warnings("porosity = 0.1\n[porosity]\nlinear_slope = 2\n[calibrate]\n"
                       "parameters = [\"modulus_exponent\"]\n"),
              ElementsAre("porosity.linear_slope changes nothing: to_scatter is not \"linear\"",
                          "modulus_exponent in calibrate.parameters changes nothing: to_modulus is "
                          "not \"power\"",
                          no_window));
  EXPECT_THAT(warnings("porosity = 0.1\n[porosity]\nto_scatter = \"linear\"\n"
                       "[model.joints]\nscatter = 0.3\n"),
              ElementsAre("model.joints.scatter changes nothing: every specimen has one from its "
                          "porosity"));
  EXPECT_THAT(warnings("[reduction]\nquality_control = false\nlargest_noise = 0.1\n"),
              ElementsAre("reduction.largest_noise changes nothing: quality_control is false"));
}

TEST_F(ReadStudy, SaysWhichStartIsMovedAndWhatRunsInTime) {
  EXPECT_THAT(
      read(one_specimen, {"calibrate.parameters=['ratio']", "model.joints.ratio=30"}).warnings,
      ElementsAre("ratio starts at 20, the nearest of its bounds, for the study's 30 lies "
                  "outside; it stays there where the tests tell nothing of it"));
  EXPECT_THAT(read(one_specimen, {"calibrate.parameters=['viscosity_s']"}).warnings,
              ElementsAre(testing::StartsWith("viscosity_s starts at 1e-09, the nearest"),
                          testing::StartsWith("viscosity_s is fitted: every simulation runs")));
}

TEST_F(ReadStudy, LetsTheCommandLineOverrideTheFile) {
  const StudyFile file =
      read(one_specimen, {"calibrate.options.budget=50", "model.joints.scatter=0.7",
                          "calibrate.parameters=[\"ratio\"]"});
  EXPECT_EQ(file.study.calibrate.budget, 50);
  EXPECT_EQ(file.study.model.joints.scatter, 0.7);
  EXPECT_THAT(file.study.calibrate.parameters, ElementsAre("ratio"));
}

// The sentences are those of the options themselves; the reader adds the line.
TEST_F(ReadStudy, AsksTheOptionsOfTheCalibration) {
  calib::CalibrateOptions one_seed;
  one_seed.replicates = 1;
  ASSERT_EQ(one_seed.problems().size(), 1U);
  EXPECT_THAT(
      complaints(one_specimen + "[calibrate.options]\nreplicates = 1\n"),
      ElementsAre("study.toml:5: calibrate.options.replicates: " + one_seed.problems()[0].what));

  calib::CalibrateOptions falling;
  falling.bounds["ratio"] = {3.0, 1.0};
  ASSERT_EQ(falling.problems().size(), 1U);
  EXPECT_THAT(complaints(one_specimen + "[calibrate.bounds]\nratio = [3, 1]\n"),
              ElementsAre("study.toml:5: calibrate.bounds.ratio: " + falling.problems()[0].what));
}

TEST_F(ReadStudy, NamesEveryFileThatAResultComesFrom) {
  for (const char* name : {"A1.csv", "g.csv", "m.png", "s.png"}) folder.write(name, "");
  folder.write("laws.json", R"({"laws": [{"response": "strength", "status": "fitted",
    "terms": ["joints.scatter"], "coefficients": [1.0, 2.0]}]})");
  const StudyFile file = read(one_specimen + R"(gauge = "g.csv"
mask = "m.png"
sections = ["s.png"]
[calibrate]
laws = "laws.json"
)",
                              {}, Files::must_exist);
  std::vector<std::string> names;
  for (const auto& input : file.inputs) names.push_back(input.filename());
  EXPECT_THAT(names, testing::UnorderedElementsAre("study.toml", "A1.csv", "g.csv", "m.png",
                                                   "s.png", "laws.json"));
}

TEST_F(ReadStudy, DoesNotAskForFilesThatWillBeWritten) {
  EXPECT_THAT(complaints(one_specimen, Files::will_be_written), IsEmpty());
  EXPECT_EQ(complaints(one_specimen, Files::must_exist).size(), 1U);
}

}  // namespace
}  // namespace havers::io
