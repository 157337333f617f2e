// Which number stands in which column of the tables of fits, tests and sections.
#include <gmock/gmock.h>

#include <numbers>

#include "reports/pages.hpp"
#include "tests/reports/sound_page.hpp"
#include "tests/reports/without_gnuplot.hpp"

namespace havers::reports {
namespace {

using test::table_rows;
using testing::Contains;
using testing::HasSubstr;

class Tables : public testing::Test {
 private:
  const test::WithoutGnuplot tables_alone_;
};

// No two of its numbers are alike.
calib::SpecimenResult specimen_of_unlike_numbers() {
  calib::SpecimenResult s;
  s.id = "A9";
  s.orientation = std::numbers::pi / 6.0;
  s.porosity = 0.05;
  s.scatter = 0.25;
  s.measured.modulus = 12e9;
  s.measured.modulus_standard_error = 0.3e9;
  s.measured.strength = 40e6;
  s.measured.strength_standard_error = 2e6;
  s.measured.failure_strain = 0.0031;
  s.modulus = {13e9, 0.5e9};
  s.strength = {45e6, 3e6};
  s.failure_strain = {0.0037, 0.0004};
  s.residual = {1.5, -2.5, 0.72};
  s.terms = {{.term = "modulus",
              .measured = 23.2,
              .simulated = 23.3,
              .sd = 0.067,
              .residual = 1.4,
              .share = 0.31}};
  s.influence = {{"young_GPa", 0.41}, {"head_tail_MPa", -0.83}};
  return s;
}

TEST_F(Tables, CompareMeasuredWithSimulatedOfASpecimen) {
  calib::CalibrationResult result;
  result.specimens = {specimen_of_unlike_numbers()};
  const auto rows = table_rows(fit_page({calib::Study{}, result, {}, {}}));
  EXPECT_THAT(rows, Contains("A9|fit|30°|5.00 %|0.250|12.00|13.00|40.00|45.00|0.3100|0.3700"));
  EXPECT_THAT(rows, Contains("Modulus|12.00 ± 0.30|13.00 ± 0.50|GPa|1.5"));
  EXPECT_THAT(rows, Contains("Strength|40.0 ± 2.0|45.0 ± 3.0|MPa|−2.5"));
  EXPECT_THAT(rows, Contains("Failure strain|0.3100 (error not estimated)|0.370 ± 0.040|%|0.72"));
  EXPECT_THAT(rows, Contains("ln modulus (Pa)|23.20|23.30|0.067|1.4|31"));
}

TEST_F(Tables, SayOfATestThatWasStoppedThatItBoreMore) {
  calib::CalibrationResult result;
  result.specimens = {specimen_of_unlike_numbers()};
  result.specimens.front().measured.broke = false;
  const auto rows = table_rows(fit_page({calib::Study{}, result, {}, {}}));
  EXPECT_THAT(rows, Contains("A9|fit|30°|5.00 %|0.250|12.00|13.00|≥ 40.00|45.00|≥ 0.3100|0.3700"));
  EXPECT_THAT(rows, Contains("Modulus|12.00 ± 0.30|13.00 ± 0.50|GPa|1.5"));
  EXPECT_THAT(rows, Contains("Strength|≥ 40.0 ± 2.0|45.0 ± 3.0|MPa|−2.5"));
}

// A parameter whose four intervals differ, and another.
calib::CalibrationResult fit_of_unlike_numbers() {
  calib::CalibrationResult result;
  result.specimens = {specimen_of_unlike_numbers()};
  result.parameters = {{.name = "young_GPa",
                        .unit = "GPa",
                        .value = 13.0,
                        .standard_error = 0.2,
                        .interval_95 = {12.5, 13.6},
                        .bounds = {5.0, 30.0},
                        .slopes_95 = {12.3, 13.7},
                        .profile_95 = {12.4, 13.8},
                        .bootstrap_95 = {12.6, 13.9},
                        .at_bound = true,
                        .identifiable = true},
                       {.name = "head_tail_MPa", .unit = "MPa", .value = 52.0, .bounds = {5, 200}}};
  result.fitted = {"young_GPa", "head_tail_MPa"};
  result.correlation = {{1.0, 0.25}, {0.25, 1.0}};
  result.next_tests = {{"one more at 45 deg", {0.9, 0.7}}};
  result.stages = {{"BOBYQA", 1204.5, 8.31, 214, "done", 21.4}};
  return result;
}

TEST_F(Tables, TellWhatAFitFound) {
  const auto rows = table_rows(fit_page({calib::Study{}, fit_of_unlike_numbers(), {}, {}}));
  EXPECT_THAT(rows, Contains("E|young_GPa|13.00 ± 0.20|12.5 to 13.6|GPa|5 to 30 at its bound"));
  EXPECT_THAT(rows, Contains("E (GPa)|12.3 to 13.7|12.4 to 13.8|12.6 to 13.9"));
  EXPECT_THAT(rows, Contains("E|1.0|0.25"));
  EXPECT_THAT(rows, Contains("σ₁|0.25|1.0"));
  EXPECT_THAT(rows, Contains("one more at 45°|0.90|0.70"));
  EXPECT_THAT(rows, Contains("A9|0.41|−0.83"));
  EXPECT_THAT(rows, Contains("BOBYQA|1204|8.310|214|21.4 s|done"));
}

TEST_F(Tables, PutFitsSideBySide) {
  const auto fit = test::fit_sample();
  const auto rows =
      table_rows(comparison_page({{fit.study, fit.result, {}, {.wall_seconds = 38.2}}}));
  EXPECT_THAT(rows, Contains("bovine femur A|The fit can be trusted, with 1 reservation.|–|7.942|6|"
                             "4128|38.2 s"));
  EXPECT_THAT(rows, Contains("E (GPa) young_GPa|bovine femur A|13.123 ± 0.087|12.95 to 13.30"));
  EXPECT_THAT(rows, Contains("r ratio|bovine femur A|1.000|held"));
}

TEST_F(Tables, TellWhatATestWasReducedTo) {
  calib::RawTest raw;
  raw.specimen_id = "A1";
  raw.width = 4e-3;
  raw.thickness = 2e-3;
  raw.gauge_length = 25e-3;
  raw.time = {0.0, 0.1, 0.2};
  raw.force = {0.0, 1.0, 2.0};
  calib::MeasuredTest test;
  test.area = 8e-6;
  test.modulus = 12e9;
  test.modulus_standard_error = 0.3e9;
  test.window_low = 0.0011;
  test.window_high = 0.0024;
  test.max_force = 320.0;
  test.strength = 40e6;
  test.strength_standard_error = 2e6;
  test.failure_strain = 0.0031;
  test.energy_to_failure = 62e3;
  test.strain_rate = 3.3e-4;
  test.linearity = 0.97;
  test.strain = {0.0, 0.0031};
  test.stress = {0.0, 40e6};
  test.warnings = {"one", "two"};
  const auto rows = table_rows(import_page({{"a/A1.csv", raw, test}}, {}));
  EXPECT_THAT(rows, Contains("A1.csv|A1|3|12.00 ± 0.30|40.0 ± 2.0|0.3100|2"));
  for (const char* fact :
       {"Width, thickness|4 mm, 2 mm", "Area|8 mm², width × thickness", "Gauge length|25 mm",
        "Modulus|12.00 ± 0.30 GPa, in the window 0.11 to 0.24 %", "Strength|40.0 ± 2.0 MPa",
        "Largest force|320.0 N", "Failure strain|0.3100 %", "Energy to failure|0.06200 MJ&#x2F;m³",
        "Strain rate|0.000330 1&#x2F;s", "Strength &#x2F; (modulus · failure strain)|0.970"})
    EXPECT_THAT(rows, Contains(fact));
}

calib::SectionPorosity section_of_unlike_numbers() {
  calib::SectionPorosity s;
  s.file = "in/A1_s1.png";
  s.pixel_size = 5e-6;
  s.method = "half maximum";
  s.threshold = 0.49;
  s.porosity = 0.048;
  s.porosity_standard_error = 0.0021;
  s.porosity_by_grey = 0.0471;
  s.pore_count = 213;
  s.pore_density = 32.8e6;
  s.pore_area = 0.31e-6;
  s.bone_area = 6.5e-6;
  s.total_area = 9.2e-6;
  s.marrow_area = 2.7e-6;
  s.mean_pore_area = 1450e-12;
  s.pore_area_sd = 870e-12;
  s.mean_pore_diameter = 43e-6;
  s.pore_diameter_sd = 17e-6;
  s.window_sd = 0.11;
  s.crack_count = 3;
  s.crack_area = 0.014e-6;
  s.density = 1900.0;
  s.density_residual = 14.0;
  s.zones = {{"outer third", 0.031, 2e-6}};
  s.classes = {{"canals", 71, 0.22e-6}};
  return s;
}

TEST_F(Tables, TellWhatASectionHolds) {
  const auto section = section_of_unlike_numbers();
  const auto rows = table_rows(porosity_page({.sections = {section},
                                              .overlays = {{}},
                                              .scatter = {0.41},
                                              .histograms = {{}},
                                              .mean = calib::pool_sections({section})}));
  EXPECT_THAT(rows, Contains(HasSubstr("A1_s1.png|4.80 ± 0.21|213|32.8|43.0 (SD 17)|6.50|2.70|"
                                       "11.0|0.41")));
  for (const char* fact :
       {"Threshold|at a depth of 0.490, 0 bone, 1 pore (half maximum)",
        "Porosity by grey levels|4.710 %", "Pixel|5.00 µm", "Area of a pore|1450 (SD 870) µm²",
        "Cracks|3, 0.0140 mm², no part of the porosity",
        "Density of solid bone|1900 kg&#x2F;m³ (references 14 kg&#x2F;m³ about their line)",
        "outer third|3.10|2.00", "canals|71|0.220"})
    EXPECT_THAT(rows, Contains(fact));
}

TEST_F(Tables, HaveTheNumbersOfASectionBelowItsOverlay) {
  auto fit = test::fit_sample();
  fit.study.specimens.front().sections = {section_of_unlike_numbers()};
  EXPECT_THAT(fit_page({fit.study, fit.result, {{"A1", {test::tiny_png()}}}, {}}),
              HasSubstr("A1_s1.png: porosity 4.80\u00a0±\u00a00.21\u00a0%, 213 pores on "
                        "6.50\u00a0mm² of bone, standard deviation 11.0\u00a0% in windows of one "
                        "fibre; half maximum, threshold at a depth of 0.490 (0 bone, 1 pore), "
                        "pixel 5.00\u00a0µm"));
}

}  // namespace
}  // namespace havers::reports
