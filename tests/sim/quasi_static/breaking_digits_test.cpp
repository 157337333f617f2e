// What leaves a breaking sequence few digits.
#include <gtest/gtest.h>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// Where a tie nearly does what a body's other ports do, a joint of 50 MPa bore 10 GPa.
TEST(BreakingDigits, LosesNoDigitsWhereATieSaysNearlyWhatOthersSay) {
  Scene scene = test::small_scene(-2.7, 2, 2);
  scene.assembly.fibre_length = 118.7e-6;
  scene.loading.lateral = Lateral::periodic;
  scene.assembly.refinement = 4;
  const Simulation finer = simulate(scene);
  scene.assembly.refinement = 2;
  const Simulation run = simulate(scene);
  EXPECT_TRUE(run.trusted()) << run.why_not_trusted();
  EXPECT_NEAR(run.strength / finer.strength, 1.0, 0.2) << "0.89: the meshes differ";
}

// Stiff in one way by 5000 times what it is in others: what an avalanche's pieces do has few
// digits, its strength has all of them.
TEST(BreakingDigits, IsTrustedWhereTheMaterialHardlyChangesItsVolume) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scene scene = test::small_scene(0.0, 5, 4);
    scene.material.plane = Plane::strain;
    scene.material.poisson = 0.4999;
    scene.joints.scatter = 1.0;
    scene.joints.friction = 0.6;
    scene.joints.seed = seed;
    const Simulation run = simulate(scene);
    EXPECT_TRUE(run.trusted()) << seed << ' ' << run.why_not_trusted();
    EXPECT_LE(run.rounding_error, 1e-8);
  }
}

}  // namespace
}  // namespace havers::sim
