// Quasi-static runs of specimens that nothing holds together, from the start or at last: what is
// left of their forces is rounding.
#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

// Severed by missing joints: the reactions are rounding, of which slivers make much.
TEST(SeveredSpecimen, BreaksNothingMore) {
  Scene scene = test::small_scene(89.99, 5, 3);
  scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, 50.0);
  scene.joints.scatter = 1.5;
  scene.joints.missing = 0.6;
  scene.joints.seed = 930;
  const Simulation simulation = simulate(scene);
  EXPECT_EQ(simulation.status, SimulationStatus::severed);
  EXPECT_EQ(simulation.broken_joints, 0);
  EXPECT_EQ(simulation.strength, 0.0);
}

// With little effort the contact of what is left does not settle.
TEST(SeveredSpecimen, IsFoundBeforeARunInTime) {
  Scene scene = test::dynamic_scene(-2.002441438734928, 2.178649237472767e-08);
  scene.assembly.layers = 3;
  scene.assembly.fibres = 10;
  scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, 0.9854691119191695);
  scene.joints.missing = 0.35;
  scene.joints.friction = 0.6;
  scene.joints.seed = 126;
  scene.loading.lateral = Lateral::free;
  scene.loading.max_strain = 0.02;
  scene.loading.strain_rate = 2945.25;
  for (const bool leave_out : {true, false}) {
    scene.solver.leave_out = leave_out;
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.status, SimulationStatus::severed) << leave_out;
    EXPECT_EQ(simulation.strength, 0.0) << leave_out;
  }
}

// Columns of fibres that nothing holds lie anywhere, but not far away.
TEST(SeveredSpecimen, LiesWhereItWasWhereAllBreakTogether) {
  HAVERS_SLOW;
  for (const int layers : {6, 9, 14})
    for (const double degrees : {90.0, 89.99}) {
      SCOPED_TRACE(testing::Message() << layers << " layers at " << degrees);
      Scene scene = test::small_scene(degrees, layers, layers - 1);
      scene.joints.scatter = 0.0;
      const Simulation simulation = simulate(scene);
      EXPECT_EQ(simulation.steps, 1);
      EXPECT_LE(simulation.worst_residual, 1e-8);
      EXPECT_LE(simulation.energy_defect, 1e-8);
      EXPECT_LE(simulation.displacements.lpNorm<Eigen::Infinity>(), scene.assembly.width());
    }
}

// Nearly incompressible and of unlike layers: rounding is not small there.
TEST(SeveredSpecimen, BearsNothingAtAll) {
  for (const double length : {40e-6, 55e-6, 70e-6, 85e-6, 100e-6}) {
    Scene scene = test::small_scene(90.0, 1, 2);
    scene.assembly.fibre_length = length;
    scene.loading.lateral = Lateral::free;
    scene.loading.end_fraction = 0.0;
    scene.material.plane = Plane::strain;
    scene.material.poisson = 0.4999;
    scene.material.layer_contrast = 0.02;
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.why_not_trusted(), "");
    EXPECT_EQ(simulation.status, SimulationStatus::broken);
    EXPECT_EQ(simulation.curve.back().stress_right, 0.0);
  }
}

// A row of fibres whose pieces still touch. What rounding leaves of the force would do work that
// nothing stores, and more of it the further the ends are pulled.
TEST(SeveredSpecimen, BearsNothingWhereItsPiecesTouch) {
  for (const double degrees : {10.0, 36.0}) {
    Scene scene = test::small_scene(degrees, 1, 8);
    scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, 3.0);
    scene.joints.scatter = 1.2;
    scene.loading.lateral = Lateral::free;
    scene.loading.end_fraction = 0.0;
    for (scene.joints.seed = 1; scene.joints.seed <= 40; ++scene.joints.seed) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, seed " << scene.joints.seed);
      const Simulation simulation = simulate(scene);
      EXPECT_EQ(simulation.why_not_trusted(), "");
      EXPECT_EQ(simulation.status, SimulationStatus::broken);
      EXPECT_EQ(simulation.curve.back().stress_right, 0.0);
    }
  }
}

}  // namespace
}  // namespace havers::sim
