// (M4): the discrete energy balance closes in every run, whatever breaks.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

class EnergyBalanceOfRuns : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Orientation, EnergyBalanceOfRuns, testing::Values(0.0, 45.0, 90.0));

// In time, by the curve alone: what is there in each row is what was there at the start and the
// work of the machine, whose force is the stress of the step's end. Not from rest, where held nodes
// take an impulse that is no stress.
void expect_that_energy_is_kept(const Scene& scene, const Simulation& run) {
  const auto energy = [](const CurvePoint& row) {
    return row.kinetic + row.elastic + row.dissipated + row.numerical;
  };
  const double area = scene.assembly.width() * scene.assembly.height();
  double expected = energy(run.curve.front()), largest = expected;
  for (std::size_t i = 1; i < run.curve.size(); ++i) {
    const CurvePoint& row = run.curve[i];
    expected += row.stress_right * area * (row.strain - run.curve[i - 1].strain);
    largest = std::max(largest, energy(row));
    ASSERT_NEAR(energy(row), expected, 1e-10 * largest) << "row " << i;
  }
  EXPECT_GT(run.curve.back().numerical, 1e-3 * largest) << "no part of it is next to nothing";
  EXPECT_GT(run.curve.back().dissipated, 1e-3 * largest);
  EXPECT_GT(run.energy_defect, 0.0) << "sums of so many rows are not exact";
  EXPECT_LE(run.energy_defect, 1e-10);
}

TEST_P(EnergyBalanceOfRuns, ClosesUpToFailure) {
  for (const Scene& scene : {test::small_scene(GetParam()), test::dynamic_scene(GetParam())}) {
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.status, SimulationStatus::broken);
    EXPECT_LE(simulation.energy_defect, 1e-10);
    EXPECT_LE(simulation.worst_residual, 1e-6);
    EXPECT_LE(simulation.worst_penetration, 1e-12 * scene.assembly.fibre_length);
    if (simulation.regime == Regime::dynamic) expect_that_energy_is_kept(scene, simulation);
  }
}

TEST_P(EnergyBalanceOfRuns, ClosesWithViscosityAndWithoutOmissions) {
  Scene scene = test::dynamic_scene(GetParam());
  scene.material.viscosity = 5e-9;
  scene.solver.leave_out = false;
  expect_that_energy_is_kept(scene, simulate(scene));
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

// Sweeps end at the tolerance and leave joints that are pressed overlapping.
TEST(Sweeps, TellTheLargestOverlapThatIsSeen) {
  Scene scene = test::dynamic_scene(0.0, 2e-9);
  scene.loading.strain_rate = 1e5;
  scene.solver.contact = ContactMethod::gauss_seidel;
  scene.solver.tolerance = 1e-4;
  double seen = 0.0;
  const Simulation run = simulate(scene, [&](const Progress& progress) {
    for (const JointOutcome& joint : progress.joints()) seen = std::max(seen, -joint.gap);
  });
  EXPECT_GT(run.broken_joints, 0);
  EXPECT_GT(seen, 0.0);
  EXPECT_EQ(run.worst_penetration, seen);
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
