#include <gtest/gtest.h>

#include <cmath>

#include "sim/simulate.hpp"
#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

// Long steps let the waves of a break fade, as a damped material does: what is left of dynamics is
// inertia and the length of the step, both in proportion to the rate.
class SlowLimit : public testing::TestWithParam<double> {
 protected:
  // Strength in time over that without time, less one.
  static double excess(double inertia_number, unsigned seed) {
    Scene scene = test::small_scene(GetParam(), 8, 5);
    scene.joints.seed = seed;
    scene.loading.max_strain = 0.1;
    scene.solver.regime = Regime::quasi_static;
    const double without_time = simulate(scene).strength;

    scene.solver.regime = Regime::dynamic;
    scene.loading.strain_rate *= inertia_number / choose_regime(scene).inertia_number;
    const double wave_speed = std::sqrt(scene.material.young / scene.material.density);
    scene.solver.step = 0.4 * scene.assembly.fibres * scene.assembly.fibre_length / wave_speed;
    const Simulation in_time = simulate(scene);
    EXPECT_TRUE(in_time.trusted());
    return in_time.strength / without_time - 1.0;
  }
};
INSTANTIATE_TEST_SUITE_P(Orientation, SlowLimit, testing::Values(0.0, 45.0, 90.0));

TEST_P(SlowLimit, HasTheQuasiStaticStrengthWhereTheRegimeSwitchesAndNotWellAbove) {
  double slow = 0.0, fast = 0.0;
  for (const unsigned seed : {1U, 2U, 3U}) {
    const double left = std::abs(excess(quasi_static_below, seed));
    EXPECT_LT(left, 1e-3) << "seed " << seed;
    slow += left;
    fast += std::abs(excess(50.0 * quasi_static_below, seed));
  }
  EXPECT_LT(slow, 0.2 * fast);
}

struct ObliqueWall {
  double orientation_deg;
  int layers, fibres;
  double flank, friction, scatter;  // [Pa], [-], [-]
  unsigned seed;
};

// Oblique walls as they are, in steps chosen for their own error: waves of the breaks ring on, by
// 1 to 3 % of the strength, and without them nothing is left but the limit.
TEST(SlowMotion, HasTheQuasiStaticStrengthButForWavesThatRing) {
  HAVERS_SLOW;
  for (const ObliqueWall& wall : {ObliqueWall{30.0, 5, 4, 25e6, 0.6, 0.6, 29},
                                  {45.0, 6, 5, 50e6, 0.6, 0.6, 341},
                                  {75.0, 6, 5, 10e6, 0.6, 0.3, 211},
                                  {90.0, 8, 6, 25e6, 0.3, 1.0, 751}}) {
    Scene scene = test::small_scene(wall.orientation_deg, wall.layers, wall.fibres);
    scene.joints.flank = wall.flank;
    scene.joints.friction = wall.friction;
    scene.joints.scatter = wall.scatter;
    scene.joints.seed = wall.seed;
    const double limit = simulate(scene).strength;
    scene.solver.regime = Regime::dynamic;
    scene.loading.strain_rate *= quasi_static_below / choose_regime(scene).inertia_number;
    const Simulation in_time = simulate(scene);
    EXPECT_TRUE(in_time.trusted()) << in_time.why_not_trusted();
    EXPECT_GT(in_time.strength / limit, 1.009) << wall.orientation_deg;
    EXPECT_NEAR(in_time.strength_without_ringing() / limit, 1.0, 1e-3) << wall.orientation_deg;
  }
}

}  // namespace
}  // namespace havers::sim
