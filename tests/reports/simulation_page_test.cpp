#include <gtest/gtest.h>

#include "reports/pages.hpp"
#include "tests/reports/sound_page.hpp"

namespace havers::reports {
namespace {

using test::contains;
using test::expect_sound;

sim::Assembly small_assembly() {
  return sim::build_assembly({.layers = 6, .fibres = 4}, sim::Lateral::periodic);
}

TEST(SimulationPage, PutsTheErrorBesideTheTime) {
  const auto assembly = small_assembly();
  const auto simulation = test::simulation_sample(assembly);
  const sim::Scene scene;
  const std::string page =
      simulation_page({scene, assembly, simulation, {{"havers", "0.1.0"}}, 12.34});
  expect_sound(page);
  EXPECT_TRUE(
      contains(page, "The specimen broke: strength 38.90\u00a0MPa at 0.300\u00a0% strain."));
  EXPECT_TRUE(contains(
      page,
      "12.3\u00a0s wall time, for a relative energy defect of 3.20 × 10⁻¹⁴, a residual of at most "
      "6.10 × 10⁻¹⁰"));
  EXPECT_LT(page.find("To be trusted"), page.find("<table"));
  EXPECT_TRUE(contains(page, "time steps up to a strain of 3.978 × 10⁻⁶"));
}

TEST(SimulationPage, SaysWhatHalvingTheStepChangedOrThatItIsNotKnown) {
  const auto assembly = small_assembly();
  auto simulation = test::simulation_sample(assembly);
  simulation.regime = sim::Regime::dynamic;
  simulation.step_error = {.failure_strain = 6.5e-4, .strength = 0.022};
  const auto page = [&] { return simulation_page({sim::Scene{}, assembly, simulation, {}}); };
  EXPECT_TRUE(contains(page(),
                       "changed the failure strain by 0.065\u00a0% and the strength by "
                       "2.2\u00a0%."));
  simulation.step_error.reset();
  EXPECT_TRUE(contains(page(), "The error of the time step is not known."));
  simulation.regime = sim::Regime::quasi_static;
  EXPECT_FALSE(contains(page(), "time step is"));
}

TEST(SimulationPage, ShowsWhatTheSceneSets) {
  const auto assembly = small_assembly();
  sim::Scene scene;
  scene.material.viscosity = 1e-8;
  scene.material.layer_contrast = 0.5;
  scene.joints.friction = 0.7;
  scene.joints.flank_tension = 3e6;
  const std::string page =
      simulation_page({scene, assembly, test::simulation_sample(assembly), {}});
  for (const char* words : {"τ = 10.0\u00a0ns, every second layer 0.5 E", "friction 0.7",
                            "flank tension 3\u00a0MPa", "8 triangles a fibre"})
    EXPECT_TRUE(contains(page, words)) << words;
}

TEST(SimulationPage, DoesNotTrustARunWhoseEnergyDoesNotClose) {
  const auto assembly = small_assembly();
  auto simulation = test::simulation_sample(assembly);
  simulation.energy_defect = 1e-3;
  EXPECT_TRUE(contains(simulation_page({sim::Scene{}, assembly, simulation, {}}),
                       "Not to be trusted: the energy balance does not close."));
}

TEST(SimulationPage, GivesASeveredSpecimenNoBoundOfStrength) {
  const auto assembly = small_assembly();
  auto simulation = test::simulation_sample(assembly);
  simulation.status = sim::SimulationStatus::severed;
  EXPECT_TRUE(contains(simulation_page({sim::Scene{}, assembly, simulation, {}}),
                       "Missing joints sever the specimen: it bears nothing. To be trusted."));
}

TEST(SimulationPage, SurvivesARunWithoutRows) {
  const sim::Assembly assembly;
  const sim::Simulation simulation;
  const sim::Scene scene;
  expect_sound(simulation_page({scene, assembly, simulation, {}}));
}

}  // namespace
}  // namespace havers::reports
