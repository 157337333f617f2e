// The same specimen in other units, again, and from two threads.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

class Invariance : public testing::TestWithParam<double> {
 protected:
  Scene quasi_static = test::small_scene(GetParam()), dynamic = test::dynamic_scene(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Orientation, Invariance, testing::Values(0.0, 45.0, 90.0));

// Units of length, stress and time changed together: the same strains, and stresses in proportion.
struct Units {
  double length, stress, time;
};

Scene in_units(Scene scene, const Units& units) {
  scene.assembly.fibre_length *= units.length;
  scene.assembly.fibre_height *= units.length;
  scene.material.young *= units.stress;
  scene.material.density *= units.stress * units.time * units.time / (units.length * units.length);
  scene.joints.head_tail *= units.stress;
  scene.joints.flank *= units.stress;
  scene.loading.strain_rate /= units.time;
  if (scene.solver.step) *scene.solver.step *= units.time;
  return scene;
}

// Powers of two change no digit, other factors round every number. The last two make of this wall
// one of 1.3 kPa, and of 1 TPa, and of the same density.
TEST_P(Invariance, DoesNotDependOnUnits) {
  for (const Units& units :
       {Units{8.0, 2.0, 16.0}, Units{1e3, 7.3, 1e6 / 3.0}, Units{1.0 / 7.0, 1e-6, 0.11},
        Units{1.0, 1e-7, std::sqrt(1e7)}, Units{1.0, 77.0, std::sqrt(1.0 / 77.0)}})
    for (const Scene& scene : {quasi_static, dynamic}) {
      const Simulation one = simulate(scene), two = simulate(in_units(scene, units));
      EXPECT_EQ(one.status, two.status);
      EXPECT_NEAR(two.strength / units.stress / one.strength, 1.0, 1e-9);
      EXPECT_NEAR(two.failure_strain / one.failure_strain, 1.0, 1e-9);
      ASSERT_EQ(one.curve.size(), two.curve.size());
      for (std::size_t i = 0; i < one.curve.size(); ++i) {
        EXPECT_NEAR(two.curve[i].strain, one.curve[i].strain, 1e-9 * one.failure_strain);
        EXPECT_NEAR(two.curve[i].stress_right / units.stress, one.curve[i].stress_right,
                    1e-9 * one.strength);
        EXPECT_EQ(two.curve[i].broken_joints, one.curve[i].broken_joints);
      }
      EXPECT_GT(one.broken_joints, 0);
      for (std::size_t j = 0; j < one.joints.size(); ++j)
        EXPECT_EQ(one.joints[j].broken, two.joints[j].broken) << "joint " << j;
    }
}

// Stresses and thresholds in proportion: the same dimensionless sequence at proportional strains.
TEST_P(Invariance, ScalesWithTheThresholdsInTheQuasiStaticLimit) {
  Scene stronger = quasi_static;
  stronger.joints.head_tail *= 3.0;
  stronger.joints.flank *= 3.0;
  const Simulation one = simulate(quasi_static), three = simulate(stronger);
  ASSERT_EQ(one.curve.size(), three.curve.size());
  for (std::size_t i = 0; i < one.curve.size(); ++i) {
    EXPECT_NEAR(three.curve[i].strain, 3.0 * one.curve[i].strain, 1e-12);
    EXPECT_NEAR(three.curve[i].stress_right, 3.0 * one.curve[i].stress_right,
                1e-9 * three.strength);
  }
}

bool same(const Simulation& a, const Simulation& b) {
  bool equal = a.curve.size() == b.curve.size() && a.displacements == b.displacements;
  for (std::size_t i = 0; equal && i < a.curve.size(); ++i)
    equal = a.curve[i].stress_right == b.curve[i].stress_right &&
            a.curve[i].stress_left == b.curve[i].stress_left &&
            a.curve[i].elastic == b.curve[i].elastic &&
            a.curve[i].broken_joints == b.curve[i].broken_joints;
  return equal;
}

TEST_P(Invariance, GivesTheSameBitsAgainAndFromSeveralThreads) {
  for (const Scene& scene : {quasi_static, dynamic}) {
    const Simulation first = simulate(scene);
    EXPECT_TRUE(same(first, simulate(scene)));
    std::array<Simulation, 2> found;
    std::array<std::thread, 2> threads;
    for (std::size_t i = 0; i < found.size(); ++i)
      threads[i] = std::thread([&, i] { found[i] = simulate(scene); });
    for (std::thread& thread : threads) thread.join();
    for (const Simulation& simulation : found) EXPECT_TRUE(same(first, simulation));
  }
}

}  // namespace
}  // namespace havers::sim
