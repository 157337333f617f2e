#include "io/config/read_study.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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

// With its sign it would be another group of calibrate.level = "orientation".
TEST_F(ReadStudy, TakesMinusZeroDegreesAsZero) {
  const StudyFile file = read(one_specimen + "orientation_deg = -0.0\n");
  EXPECT_FALSE(std::signbit(file.specimens.at(0).orientation.value()));
  EXPECT_FALSE(std::signbit(file.study.specimens.at(0).orientation));
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
