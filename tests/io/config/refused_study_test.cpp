#include <fmt/core.h>
#include <gmock/gmock.h>

#include "io/config/read_study.hpp"
#include "sim/assembly/assembly.hpp"
#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;

class RefusedStudy : public testing::Test {
 protected:
  std::vector<std::string> complaints(const std::string& text,
                                      Files files = Files::will_be_written) {
    return test::complaints_of(
        folder, [&] { read_study(folder.write("study.toml", text), Overrides{}, files); });
  }
  test::ScratchFolder folder;
  const std::string one_specimen = "[[specimen]]\nid = \"A1\"\ntest = \"A1.csv\"\n";
};

TEST_F(RefusedStudy, ReportsAllProblemsAtOnce) {
  folder.write("A1.csv", "");
  EXPECT_THAT(complaints(R"([study]
nmae = "x"
[[specimen]]
id = "A1"
test = "A1.csv"
gauge = "g.csv"
[[specimen]]
id = "A1"
test = "B.csv"
sections = ["s.png"]
mask = "m.png"
use = "both"
[model.material]
young_GPa = -1
)",
                         Files::must_exist),
              ElementsAre("study.toml:6: specimen.gauge: names g.csv, which is not there (paths "
                          "are relative to the folder "
                          "of this file)",
                          "study.toml:12: specimen.use: is \"both\", must be one of: fit, validate",
                          "study.toml:8: specimen.id: is \"A1\", as that of an earlier specimen",
                          "study.toml:9: specimen.test: names B.csv, which is not there (paths are "
                          "relative to the folder of "
                          "this file)",
                          "study.toml:11: specimen.mask: names m.png, which is not there (paths "
                          "are relative to the folder of this file)",
                          "study.toml:10: specimen.sections: names s.png, which is not there "
                          "(paths are relative to the "
                          "folder of this file)",
                          "study.toml:14: model.material.young_GPa: is -1, must be above 0",
                          "study.toml:2: study.nmae: is not a known key (did you mean name?)"));
}

// Each by one sentence, however many keys it stands in the way of.
TEST_F(RefusedStudy, TakesNothingElseForATable) {
  for (const std::string table : {"study", "model", "porosity", "calibrate", "reduction",
                                  "sections", "synthesize", "model.joints", "calibrate.bounds"})
    for (const auto& [value, kind] : {std::pair{"3", "a number"}, {"[1, 2]", "a list"}})
      EXPECT_THAT(complaints(table + " = " + value + "\n" + one_specimen),
                  ElementsAre("study.toml:1: " + table + ": is " + kind + ", must be a table"));
}

TEST_F(RefusedStudy, NamesFoldersAndNamesThatNoFileHas) {
  folder.write("tests/a.csv", "");
  for (const char* name : {"tests", "tests/", "."})
    EXPECT_THAT(complaints("[[specimen]]\nid = \"A\"\ntest = \"" + std::string(name) + "\"\n",
                           Files::must_exist),
                ElementsAre(testing::HasSubstr("which is a folder (name a file in it)")));
  EXPECT_THAT(complaints("[[specimen]]\nid = \"A\"\ntest = \"" + std::string(300, 'a') + "\"\n",
                         Files::must_exist),
              ElementsAre(testing::HasSubstr("study.toml:3: specimen.test: names aaa")));
  for (const char* id : {"a\\\"b", "a\\tb"})
    EXPECT_THAT(complaints("[[specimen]]\nid = \"" + std::string(id) + "\"\ntest = \"t.csv\"\n"),
                ElementsAre(testing::HasSubstr("must be usable as a file's name")));
}

TEST_F(RefusedStudy, NamesTheTwoWaysToSayWhich) {
  for (const char* key : {"specimen_in_file", "columns.force"})
    EXPECT_THAT(complaints(one_specimen + key + " = true\n"),
                ElementsAre(testing::EndsWith("is true or false, must be a text, its name, or a "
                                              "whole number, which it is")));
}

TEST_F(RefusedStudy, ReportsFaultyLawsAmongTheOthers) {
  folder.write("laws.json", "{}");
  EXPECT_THAT(complaints(one_specimen + "width_mm = 0\n[calibrate]\nlaws = \"laws.json\"\n"),
              ElementsAre("study.toml:4: specimen.width_mm: is 0, must be above 0",
                          "laws.json: is no file of laws (name the laws.json of a sweep)"));
}

TEST_F(RefusedStudy, IsNoSceneAndNoSweep) {
  EXPECT_THAT(
      complaints("[assembly]\nlayers = 8\n"),
      ElementsAre("study.toml: is a scene, a study is expected (havers simulate takes it)"));
  EXPECT_THAT(complaints("[sweep.keys]\n[joints]\nratio = 1.0\n"),
              ElementsAre("study.toml: is a sweep, a study is expected (havers sweep takes it)"));
}

TEST_F(RefusedStudy, AsksForSpecimens) {
  EXPECT_THAT(complaints(""), ElementsAre("study.toml: is empty (a study, scene or sweep is "
                                          "expected there)"));
  EXPECT_THAT(complaints("[study]\n"),
              ElementsAre("study.toml: specimen: is missing (write one [[specimen]] for each "
                          "test)"));
  EXPECT_THAT(
      complaints("[specimen]\nid = \"A\"\n"),
      ElementsAre("study.toml:1: specimen: is a table, must be tables (write [[specimen]])"));
  EXPECT_THAT(
      complaints("specimen = []\n"),
      ElementsAre("study.toml:1: specimen: is a list, must be tables (write [[specimen]])"));
}

TEST_F(RefusedStudy, NeedsASpecimenToFit) {
  EXPECT_THAT(
      complaints(one_specimen + "use = \"validate\"\n"),
      ElementsAre("study.toml:1: specimen: none has use = \"fit\" (a fit needs at least one "
                  "that it may use)"));
}

TEST_F(RefusedStudy, FitsNoScatterThatPorosityGives) {
  const std::string fits_scatter = "[calibrate]\nparameters = [\"ratio\", \"scatter\"]\n";
  const auto sentence = [](const std::string& measured) {
    return "calibrate.parameters: names \"scatter\", which specimen A1 has from its " + measured +
           " (set porosity.to_scatter = \"none\" to fit it, or leave it out of the parameters)";
  };
  const std::string porosity = one_specimen + "porosity = 0.05\n";
  const std::string sections = one_specimen + "sections = [\"s.png\"]\n";
  EXPECT_THAT(complaints(porosity + fits_scatter), ElementsAre()) << "windows are of sections";
  EXPECT_THAT(complaints(sections + fits_scatter),
              ElementsAre("study.toml:6: " + sentence("sections")));
  for (const auto& [measured, name] : {std::pair{porosity, "porosity"}, {sections, "sections"}}) {
    EXPECT_THAT(complaints(measured + "[porosity]\nto_scatter = \"linear\"\n" + fits_scatter),
                ElementsAre("study.toml:8: " + sentence(name)));
    EXPECT_THAT(complaints(measured + "[porosity]\nto_scatter = \"none\"\n" + fits_scatter),
                ElementsAre());
  }
  EXPECT_THAT(complaints(one_specimen + fits_scatter), ElementsAre());
}

// Joints are as many as a specimen's orientation makes them, and a scene that a fit leaves would
// name a file beside it that is not there.
TEST_F(RefusedStudy, DrawsItsThresholds) {
  std::string joints = "joint,f_N,f_T\n";
  const sim::AssemblyOptions small{.layers = 2, .fibres = 3};
  const std::size_t count = sim::build_assembly(small, sim::Lateral::periodic).joints.size();
  for (std::size_t joint = 0; joint < count; ++joint) joints += fmt::format("{},3,4\n", joint);
  folder.write("joints.csv", joints);
  EXPECT_THAT(
      complaints(one_specimen + "[model.assembly]\nlayers = 2\nfibres = 3\n[model.joints]\n"
                                "thresholds_file = \"joints.csv\"\n"),
      ElementsAre("study.toml:8: model.joints.thresholds_file: is of one assembly; a study draws "
                  "thresholds for each specimen (leave it out; a scene for havers simulate may "
                  "name it)"));
}

struct ImpossibleStudy {
  std::string text, sentence;
};

TEST_F(RefusedStudy, NamesImpossibleValuesWithLineAndRule) {
  const std::vector<ImpossibleStudy> cases{
      {"[[specimen]]\ntest = \"t\"\n", "study.toml:1: specimen.id: is missing (name the specimen)"},
      {"[[specimen]]\nid = \"\"\ntest = \"t\"\n",
       "study.toml:2: specimen.id: is empty (name the specimen)"},
      {"[[specimen]]\nid = \"a/b\"\ntest = \"t\"\n",
       "study.toml:2: specimen.id: is \"a/b\", must be usable as a file's name"},
      {"[[specimen]]\nid = \"" + std::string(201, 'a') + "\"\ntest = \"t\"\n",
       "study.toml:2: specimen.id: is \"" + std::string(201, 'a') +
           "\", must be usable as a file's name"},
      {"[[specimen]]\nid = \"A1\"\n",
       "study.toml:1: specimen.test: is missing (the testing machine's file)"},
      {one_specimen + "width_mm = 0", "study.toml:4: specimen.width_mm: is 0, must be above 0"},
      {one_specimen + "thickness_mm = -2",
       "study.toml:4: specimen.thickness_mm: is -2, must be above 0"},
      {one_specimen + "gauge_length_mm = 0",
       "study.toml:4: specimen.gauge_length_mm: is 0, must be above 0"},
      {one_specimen + "pixel_size_um = 0",
       "study.toml:4: specimen.pixel_size_um: is 0, must be above 0"},
      {one_specimen + "orientation_deg = 91",
       "study.toml:4: specimen.orientation_deg: is 91, must be above -90 and at most 90"},
      {one_specimen + "porosity = 1",
       "study.toml:4: specimen.porosity: is 1, must be at least 0 and below 1"},
      {one_specimen + "sections = \"s.png\"",
       "study.toml:4: specimen.sections: is a text, must be a list of texts"},
      {one_specimen + "[porosity]\nstrength_exponent = -1",
       "study.toml:5: porosity.strength_exponent: is -1, must be 0 or more"},
      {one_specimen + "[porosity]\nmodulus_exponent = -1",
       "study.toml:5: porosity.modulus_exponent: is -1, must be 0 or more"},
      {one_specimen + "[porosity]\nlinear_offset = 2",
       "study.toml:5: porosity.linear_offset: is 2, must be at least 0 and below 2"},
      {one_specimen + "[porosity]\nlinear_slope = -1",
       "study.toml:5: porosity.linear_slope: is -1, must be 0 or more"},
      {one_specimen + "[calibrate]\nparameters = [\"yuong_GPa\"]",
       "study.toml:5: calibrate.parameters: names \"yuong_GPa\", which cannot be calibrated (did "
       "you mean "
       "young_GPa?)"},
      {one_specimen + "[calibrate]\nparameters = [\"aspect_ratio\", \"flank_MPa\"]",
       "study.toml:5: calibrate.parameters: names aspect_ratio and flank_MPa, of which one undoes "
       "the other; keep one"},
      {one_specimen + "[calibrate.options]\nreplicates = -1",
       "study.toml:5: calibrate.options.replicates: is -1, must be 0 (as many as needed), or 2 or "
       "more: their spread weighs the residuals"},
      {one_specimen + "[calibrate.options]\nsmooth = true\nbudget = 0",
       "study.toml:6: calibrate.options.budget: is 0, must be 1 or more"},
      {one_specimen + "width = 4",
       "study.toml:4: specimen.width: is not a known key (did you mean width_mm?)"},
      {one_specimen + "[study]\ntitle = 4",
       "study.toml:5: study.title: is not a known key (known are name)"},
      {one_specimen + "[calibrate.bounds]\nyung_GPa = [1, 2]",
       "study.toml:5: calibrate.bounds.yung_GPa: is not a known key (did you mean young_GPa?)"},
      {one_specimen + "[calibrate.bounds]\nyoung_GPa = [1]",
       "study.toml:5: calibrate.bounds.young_GPa: must be a list of two numbers (as in [5.0, "
       "30.0])"},
      {one_specimen + "[calibrate.bounds]\nmodulus_exponent = [1.0, inf]",
       "study.toml:5: calibrate.bounds.modulus_exponent: is inf, must be finite"},
      {one_specimen + "[calibrate.bounds]\nyoung_GPa = [9223372036854775807, 5]",
       "study.toml:5: calibrate.bounds.young_GPa: is [9.223372036854776e+18, 5], must rise"},
      {one_specimen + "[calibrate.level]\nratio = \"bone\"",
       "study.toml:5: calibrate.level.ratio: is \"bone\", must be one of: shared, orientation, "
       "specimen"},
      {one_specimen + "[reduction]\nwindow_high = 0",
       "study.toml:5: reduction.window_high: is 0, must be above window_low and at most 1"},
      {one_specimen + "[reduction]\nwindow_low = 0.5",
       "study.toml:5: reduction.window_low: is 0.5, must be 0 or more and below window_high"},
      {one_specimen + "[synthesize]\nforce_noise_N = -1",
       "study.toml:5: synthesize.force_noise_N: is -1, must be 0 or more"},
      {one_specimen + "[synthesize]\nsampling_s = 0",
       "study.toml:5: synthesize.sampling_s: is 0, must be above 0"},
      {one_specimen + "[synthesize]\nsection_pixels = 3",
       "study.toml:5: synthesize.section_pixels: is 3, must be from 16 to 4096"},
      {one_specimen + "[synthesize]\nsection_pixels = 100000",
       "study.toml:5: synthesize.section_pixels: is 100000, must be from 16 to 4096"},
      {one_specimen + "[sections]\nrim_um = -1",
       "study.toml:5: sections.rim_um: is -1, must be 0 or more"},
  };
  for (const ImpossibleStudy& wrong : cases)
    EXPECT_THAT(complaints(wrong.text), ElementsAre(wrong.sentence)) << wrong.text;
}

TEST_F(RefusedStudy, GivesEachSpecimenFilesOfItsOwn) {
  const std::string measured = "[[specimen]]\nid = \"A1_measured\"\ntest = \"B.csv\"\n";
  const std::string clocks = "[[specimen]]\nid = \"A1_clocks\"\ntest = \"C.csv\"\n";
  EXPECT_THAT(complaints(measured + one_specimen + clocks),
              ElementsAre("study.toml:2: specimen.id: is \"A1_measured\", which names files of "
                          "\"A1\" (give one of them another id)",
                          "study.toml:8: specimen.id: is \"A1_clocks\", which names files of "
                          "\"A1\" (give one of them another id)"));
  EXPECT_THAT(complaints(measured + clocks), ElementsAre());
}

}  // namespace
}  // namespace havers::io
