// Every key of a study's own tables, in its unit and in its place.
#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "io/config/read_study.hpp"
#include "io/config/study_keys.hpp"
#include "tests/io/complaints.hpp"

namespace havers::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

const std::string every_key = R"(
[study]
name = "bovine femur A"
[[specimen]]
id = "A1"
test = "a/A1.csv"
specimen_in_file = "South"
gauge = "A1_gauge.csv"
width_mm = 4.0
thickness_mm = 2
gauge_length_mm = 25.0
orientation_deg = 45
sections = ["s1.png", "s2.png"]
pixel_size_um = 5.0
mask = "m.png"
porosity = 0.05
use = "validate"
broke = false
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
[sections]
threshold = "otsu"
pores = "bright"
rim_um = 30.0
crack_slenderness = 8.0
any_pixel_size = true
fills_image = true
[calibrate]
parameters = ["young_GPa", "friction"]
[calibrate.bounds]
young_GPa = [5.0, 30]
[calibrate.level]
young_GPa = "orientation"
[calibrate.options]
terms = ["strength", "energy"]
replicates = 4
global = "direct"
local = "cobyla"
smooth = false
profiles = false
common_seeds = false
confirm = 3
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
[reduction]
window_low = 0.15
window_high = 0.45
straightness = 0.02
remove_toe = false
cut_after_break = false
break_part = 0.6
remove_spikes = false
spread_repeated_times = false
mend_slips = false
machine_compliance_mm_per_kN = 0.25
quality_control = false
largest_modulus_error = 0.35
largest_noise = 0.08
)";

class StudyTables : public testing::Test {
 protected:
  StudyFile read(const std::string& text) {
    for (const char* name : {"a/A1.csv", "A1_gauge.csv", "s1.png", "s2.png", "m.png"})
      folder.write(name, "");
    return read_study(folder.write("study.toml", text));
  }
  test::ScratchFolder folder;
};

TEST_F(StudyTables, GiveSpecimens) {
  const StudyFile file = read(every_key);
  EXPECT_EQ(file.study.name, "bovine femur A");
  ASSERT_EQ(file.specimens.size(), 2U);
  const SpecimenFiles& specimen = file.specimens[0];
  EXPECT_EQ(specimen.id, "A1");
  EXPECT_EQ(specimen.test, folder.path() / "a/A1.csv");
  EXPECT_EQ(specimen.columns.specimen, "South");
  EXPECT_EQ(specimen.gauge, folder.path() / "A1_gauge.csv");
  EXPECT_EQ(specimen.width, 4e-3);
  EXPECT_EQ(specimen.thickness, 2e-3);
  EXPECT_EQ(specimen.gauge_length, 25e-3);
  EXPECT_EQ(specimen.orientation, std::numbers::pi / 4.0);
  EXPECT_THAT(specimen.sections, ElementsAre(folder.path() / "s1.png", folder.path() / "s2.png"));
  EXPECT_EQ(specimen.pixel_size, 5e-6);
  EXPECT_EQ(specimen.mask, folder.path() / "m.png");
  EXPECT_EQ(specimen.porosity, 0.05);
  EXPECT_EQ(specimen.use, calib::Use::validate);
  EXPECT_EQ(specimen.broke, false);
  EXPECT_EQ(file.specimens[1].use, calib::Use::fit);
  EXPECT_FALSE(file.specimens[1].width || file.specimens[1].gauge || file.specimens[1].porosity ||
               file.specimens[1].mask || file.specimens[1].broke);

  ASSERT_EQ(file.study.specimens.size(), 2U);
  EXPECT_EQ(file.study.specimens[0].id, "A1");
  EXPECT_EQ(file.study.specimens[0].use, calib::Use::validate);
  EXPECT_FALSE(file.study.specimens[0].broke);
  EXPECT_TRUE(file.study.specimens[1].broke);
  EXPECT_EQ(file.study.specimens[0].orientation, std::numbers::pi / 4.0);
  EXPECT_EQ(file.study.specimens[0].porosity, 0.05);
}

TEST_F(StudyTables, GiveModelPorosityAndSections) {
  const StudyFile file = read(every_key);
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

  EXPECT_EQ(file.sections.threshold, Threshold::otsu);
  EXPECT_EQ(file.sections.pores, Pores::bright);
  EXPECT_DOUBLE_EQ(file.sections.rim, 30e-6);
  EXPECT_EQ(file.sections.crack_slenderness, 8.0);
}

TEST_F(StudyTables, GiveOptionsOfTheCalibration) {
  const calib::CalibrateOptions calibrate = read(every_key).study.calibrate;
  EXPECT_THAT(calibrate.parameters, ElementsAre("young_GPa", "friction"));
  EXPECT_FALSE(calibrate.automatic);
  EXPECT_THAT(calibrate.bounds, ElementsAre(Pair("young_GPa", Pair(5.0, 30.0))));
  EXPECT_THAT(calibrate.level, ElementsAre(Pair("young_GPa", calib::Level::orientation)));
  EXPECT_THAT(calibrate.terms, ElementsAre("strength", "energy"));
  EXPECT_EQ(calibrate.replicates, 4);
  EXPECT_EQ(calibrate.global, calib::GlobalSearch::direct);
  EXPECT_EQ(calibrate.local, calib::LocalSearch::cobyla);
  EXPECT_EQ(calibrate.confirm, 3);
  EXPECT_EQ(calibrate.budget, 100);
  EXPECT_EQ(calibrate.seed, 9U);
}

TEST_F(StudyTables, GiveTheLaboratoryAndItsCorrections) {
  const StudyFile file = read(every_key);
  EXPECT_EQ(file.synthesize.laboratory.force_noise, 0.25);
  EXPECT_EQ(file.synthesize.laboratory.strain_noise, 1e-6);
  EXPECT_EQ(file.synthesize.laboratory.preload, 5.0);
  EXPECT_EQ(file.synthesize.laboratory.toe_strain, 2e-4);
  EXPECT_EQ(file.synthesize.laboratory.sampling, 0.05);
  EXPECT_DOUBLE_EQ(file.synthesize.laboratory.crosshead_rate, 1e-4);
  EXPECT_EQ(file.synthesize.pore_radius, 10e-6);
  EXPECT_EQ(file.synthesize.modulus_cv, 0.02);
  EXPECT_EQ(file.synthesize.section_pixels, 256);

  EXPECT_EQ(file.reduction.window_low, 0.15);
  EXPECT_EQ(file.reduction.window_high, 0.45);
  EXPECT_EQ(file.reduction.straightness, 0.02);
  EXPECT_EQ(file.reduction.break_part, 0.6);
  EXPECT_DOUBLE_EQ(file.reduction.machine_compliance, 250e-9);
  EXPECT_EQ(file.reduction.largest_modulus_error, 0.35);
  EXPECT_EQ(file.reduction.largest_noise, 0.08);
}

struct Switch {
  std::string table, key;
  bool usual;
};
const std::vector<Switch> all_switches{
    {"sections", "any_pixel_size", false},        {"sections", "fills_image", false},
    {"calibrate.options", "smooth", true},        {"calibrate.options", "profiles", true},
    {"calibrate.options", "common_seeds", true},  {"reduction", "remove_toe", true},
    {"reduction", "cut_after_break", true},       {"reduction", "remove_spikes", true},
    {"reduction", "spread_repeated_times", true}, {"reduction", "mend_slips", true},
    {"reduction", "quality_control", true}};

// In the order of the list.
std::vector<bool> switches_in(const StudyFile& file) {
  const calib::CalibrateOptions& calibrate = file.study.calibrate;
  const calib::ReductionOptions& reduction = file.reduction;
  return {file.sections.any_pixel_size, file.sections.fills_image, calibrate.smooth,
          calibrate.profiles,           calibrate.common_seeds,    reduction.remove_toe,
          reduction.cut_after_break,    reduction.remove_spikes,   reduction.spread_repeated_times,
          reduction.mend_slips,         reduction.quality_control};
}

// One by one, as two that are exchanged look alike where both are turned.
TEST_F(StudyTables, TurnEachSwitchAlone) {
  std::vector<bool> usual;
  for (const Switch& one : all_switches) usual.push_back(one.usual);
  const std::string specimen = "[[specimen]]\nid = \"A1\"\ntest = \"a/A1.csv\"\n";
  EXPECT_EQ(switches_in(read(specimen)), usual);
  for (std::size_t i = 0; i < all_switches.size(); ++i) {
    const Switch& one = all_switches[i];
    std::vector<bool> turned = usual;
    turned[i] = !one.usual;
    const std::string value = one.usual ? " = false\n" : " = true\n";
    EXPECT_EQ(switches_in(read(specimen + "[" + one.table + "]\n" + one.key + value)), turned)
        << one.key;
  }
}

// A `Table` for keys() that keeps their names.
struct KeyNames {
  std::vector<std::string> names{};

  template <class T, class... Units>
  bool key(const std::string& name, T&, Units...) {
    names.push_back(name);
    return false;
  }
  static bool is_text(const std::string&) { return true; }
  static bool is_name_or_number(const std::string&) { return true; }
};

template <class Options>
std::vector<std::string> names_of_keys() {
  KeyNames table;
  Options options;
  keys(table, options);
  return table.names;
}

// The tests above look at what the text has: a new key must be in it.
TEST_F(StudyTables, OfTheTestsAboveHaveEveryKey) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> tables{
      {"\n[[specimen]]\n", names_of_keys<SpecimenFiles>()},
      {"\n[porosity]\n", names_of_keys<calib::PorosityOptions>()},
      {"\n[sections]\n", names_of_keys<SectionOptions>()},
      {"\n[calibrate.options]\n", names_of_keys<calib::CalibrateOptions>()},
      {"\n[synthesize]\n", names_of_keys<SynthesizeOptions>()},
      {"\n[reduction]\n", names_of_keys<calib::ReductionOptions>()}};
  for (const auto& [header, names] : tables) {
    const std::size_t begin = every_key.find(header) + header.size() - 1;
    const std::string table = every_key.substr(begin, every_key.find("\n[", begin) - begin);
    EXPECT_GT(names.size(), 5U);
    for (const std::string& name : names) EXPECT_THAT(table, HasSubstr("\n" + name + " = "));
  }
}

}  // namespace
}  // namespace havers::io
