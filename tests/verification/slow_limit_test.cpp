#include <gtest/gtest.h>

#include <cmath>

#include "sim/simulate.hpp"
#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

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

}  // namespace
}  // namespace havers::sim
