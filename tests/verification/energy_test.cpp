// (M4): the discrete energy balance closes in every run, whatever breaks.
#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

class EnergyBalanceOfRuns : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Orientation, EnergyBalanceOfRuns, testing::Values(0.0, 45.0, 90.0));

TEST_P(EnergyBalanceOfRuns, ClosesUpToFailure) {
  for (const Scene& scene : {test::small_scene(GetParam()), test::dynamic_scene(GetParam())}) {
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.status, SimulationStatus::broken);
    EXPECT_LE(simulation.energy_defect, 1e-10);
    EXPECT_LE(simulation.worst_residual, 1e-6);
    EXPECT_LE(simulation.worst_penetration, 1e-12 * scene.assembly.fibre_length);
  }
}

TEST_P(EnergyBalanceOfRuns, ClosesWithViscosityAndShock) {
  Scene scene = test::dynamic_scene(GetParam());
  scene.material.viscosity = 5e-9;
  scene.loading.start = Start::rest;
  scene.loading.strain_rate = 1e4;
  const Simulation simulation = simulate(scene);
  EXPECT_EQ(simulation.status, SimulationStatus::broken);
  EXPECT_LE(simulation.energy_defect, 1e-10);
}

// What the joints and viscosity take never comes back.
TEST_P(EnergyBalanceOfRuns, OnlyEverDissipates) {
  for (const Scene& scene : {test::small_scene(GetParam()), test::dynamic_scene(GetParam())}) {
    const Simulation simulation = simulate(scene);
    const double size = simulation.curve.back().dissipated;
    EXPECT_GT(size, 0.0);
    for (std::size_t i = 1; i < simulation.curve.size(); ++i)
      EXPECT_GE(simulation.curve[i].dissipated, simulation.curve[i - 1].dissipated - 1e-9 * size);
  }
}

// A thousandth of the time that a wave takes along a fibre, and most joints break.
TEST(ChosenSteps, KeepTheLawHoweverShortTheyAre) {
  Scene scene = test::small_scene(0.0, 10, 7);
  scene.solver.regime = Regime::dynamic;
  const Simulation simulation = simulate(scene);
  EXPECT_TRUE(simulation.trusted()) << simulation.why_not_trusted();
  EXPECT_LT(simulation.step, 1e-10);
  EXPECT_GT(simulation.broken_joints, 100);
  EXPECT_LE(simulation.worst_residual, 1e-10);
}

}  // namespace
}  // namespace havers::sim
