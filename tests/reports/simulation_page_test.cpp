#include <gtest/gtest.h>

#include "reports/pages.hpp"
#include "tests/reports/sound_page.hpp"

namespace havers::reports {
namespace {

using test::contains;
using test::expect_sound;

class SimulationPage : public testing::Test {
 protected:
  [[nodiscard]] std::string page(const calib::Provenance& provenance = {}) const {
    return simulation_page({scene, assembly, simulation, provenance});
  }

  sim::Scene scene;
  sim::Assembly assembly = sim::build_assembly({.layers = 6, .fibres = 4}, sim::Lateral::periodic);
  sim::Simulation simulation = test::simulation_sample(assembly);
};

TEST_F(SimulationPage, PutsTheErrorBesideTheTime) {
  const std::string shown = page({.havers = "0.1.0", .wall_seconds = 12.34});
  expect_sound(shown);
  EXPECT_TRUE(
      contains(shown, "The specimen broke: strength 38.90\u00a0MPa at 0.300\u00a0% strain."));
  EXPECT_TRUE(contains(shown,
                       "12.3\u00a0s wall time, for a relative energy defect of "
                       "3.20\u00a0×\u00a010⁻¹⁴, a residual of at most "
                       "6.10\u00a0×\u00a010⁻¹⁰"));
  EXPECT_LT(shown.find("To be trusted"), shown.find("<table"));
  EXPECT_TRUE(contains(shown, "time steps up to a strain of 3.978\u00a0×\u00a010⁻⁶"));
}

TEST_F(SimulationPage, CountsOneLayerAndOneFibre) {
  scene.assembly.layers = scene.assembly.fibres = 1;
  EXPECT_TRUE(contains(page(), "1 layer of 1 fibre,"));
}

TEST_F(SimulationPage, SaysWhatHalvingTheStepChangedOrThatItIsNotKnown) {
  simulation.regime = sim::Regime::dynamic;
  simulation.step_error = {.failure_strain = 6.5e-4, .strength = 0.022, .over_a_wave = 4.1e-4};
  EXPECT_TRUE(contains(page(),
                       "changed the failure strain by up to 0.065\u00a0%, the strength by up to "
                       "2.2\u00a0% and its mean over the longest wave by up to 0.041\u00a0%."));
  simulation.numerical_loss = 0.48;
  EXPECT_TRUE(contains(page(), "Implicit Euler took 48\u00a0% of all energy."));
  simulation.step_error.reset();
  EXPECT_TRUE(contains(page(), "The error of the time step is not known."));
  simulation.regime = sim::Regime::quasi_static;
  EXPECT_FALSE(contains(page(), "time step is"));
}

TEST_F(SimulationPage, IsNotGreenWhereTheStepLeavesAnErrorOrOneThatIsNotKnown) {
  simulation.step_error = {.failure_strain = 6.5e-4, .strength = 9e-4};
  EXPECT_TRUE(contains(page(), "verdict good"));
  simulation.step_error = {.failure_strain = 6.5e-4, .strength = 0.022};
  const std::string coarse = page();
  EXPECT_TRUE(contains(coarse, "verdict mixed"));
  EXPECT_TRUE(contains(coarse,
                       "strength 38.90\u00a0MPa (±\u00a02.2\u00a0% of it by the step) at "
                       "0.300\u00a0% strain. To be trusted."));
  EXPECT_TRUE(contains(coarse, "<td>38.90\u00a0MPa (±\u00a02.2\u00a0% of it by the step)</td>"));
  simulation.step_error.reset();
  const std::string unknown = page();
  EXPECT_TRUE(contains(unknown, "verdict mixed"));
  EXPECT_TRUE(contains(
      unknown,
      "To be trusted but for the time step: 20\u00a0ns was given, and its error is not known."));
}

TEST_F(SimulationPage, NamesTheScenesFile) {
  const std::string shown = simulation_page({scene, assembly, simulation, {}, "bar & wall.toml"});
  EXPECT_TRUE(contains(shown, "<title>havers simulate: bar &amp; wall.toml</title>"));
  EXPECT_TRUE(contains(shown, "<h1>havers simulate: bar &amp; wall.toml</h1>"));
}

TEST_F(SimulationPage, SaysDownToWhereItWasFollowed) {
  const std::string to_the_end = page();
  EXPECT_TRUE(contains(to_the_end, "both sides first bear less than 0.3 of the strength, where"));
  EXPECT_FALSE(contains(to_the_end, "solver.leave_out"));
  simulation.end_fraction_used = 0.85;
  const std::string shorter = page();
  for (const char* words :
       {"followed to 0.85 of the strength (0.3 where nothing is left out)",
        "after a break both sides bear less than 0.85 of the strength",
        "neither shown nor counted (solver.leave_out = false follows it on, to 0.3)",
        ", counted down to 0.85 of the strength"})
    EXPECT_TRUE(contains(shorter, words)) << words;
}

TEST_F(SimulationPage, CountsTheJointsThatWereMissing) {
  EXPECT_FALSE(contains(page(), "missing from the start"));
  simulation.joints.back().threshold = {};
  EXPECT_TRUE(contains(page(), "; 1 missing from the start"));
}

TEST_F(SimulationPage, CountsStepsFromTheFirstBreakOnWhereTheRunLeapsToIt) {
  simulation.step = 3.06e-11;
  EXPECT_TRUE(contains(page(), ">400 of 30.6\u00a0ps<"));
  simulation.leapt_strain = 1e-3;
  EXPECT_TRUE(contains(page(), ">400, of 30.6\u00a0ps from the first break on<"));
}

TEST_F(SimulationPage, GivesABoundOfTheStrengthOfARunThatDidNotBreak) {
  EXPECT_FALSE(contains(page(), "at least"));
  simulation.status = sim::SimulationStatus::strain_limit;
  const std::string bound = page();
  EXPECT_TRUE(contains(bound, "<th>Strength, at least</th>"));
  EXPECT_TRUE(contains(bound, "not reached within the strain limit of 5\u00a0%"));
  simulation.status = sim::SimulationStatus::step_limit;
  EXPECT_TRUE(contains(page(), "<td>not reached</td>"));
}

TEST_F(SimulationPage, SaysWhichSidesStressIsTheStrength) {
  EXPECT_TRUE(contains(page(), "The strength is the largest stress of the right side."));
  simulation.regime = sim::Regime::quasi_static;  // both sides bear the same
  EXPECT_FALSE(contains(page(), "right side"));
}

TEST_F(SimulationPage, ShowsWhatTheSceneSets) {
  scene.material.viscosity = 1e-8;
  scene.material.layer_contrast = 0.5;
  scene.joints.friction = 0.7;
  scene.joints.flank_tension = 3e6;
  const std::string shown = page();
  for (const char* words : {"τ = 10.0\u00a0ns, every second layer 0.5 E", "friction 0.7",
                            "flank tension 3\u00a0MPa", "8 triangles a fibre"})
    EXPECT_TRUE(contains(shown, words)) << words;
}

TEST_F(SimulationPage, DoesNotTrustARunWhoseEnergyDoesNotClose) {
  simulation.energy_defect = 1e-3;
  EXPECT_TRUE(contains(page(), "Not to be trusted: the energy balance does not close."));
}

TEST_F(SimulationPage, GivesASeveredSpecimenNoBoundOfStrength) {
  simulation.status = sim::SimulationStatus::severed;
  EXPECT_TRUE(contains(
      page(), "Missing joints leave nothing that bears a load from end to end. To be trusted."));
}

TEST_F(SimulationPage, SurvivesARunWithoutRows) {
  assembly = {};
  simulation = {};
  expect_sound(page());
}

}  // namespace
}  // namespace havers::reports
