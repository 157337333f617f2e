// The same specimen seen otherwise: in other units, in the mirror, again, and from two threads.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include "sim/joint/thresholds.hpp"
#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

class Invariance : public testing::TestWithParam<double> {
 protected:
  Scene quasi_static = test::small_scene(GetParam()), dynamic = test::dynamic_scene(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Orientation, Invariance, testing::Values(0.0, 45.0, 90.0));

// Lengths 8 times, stresses 2 times, times 16 times as large: the curve has the same strains, and
// stresses twice as large.
TEST_P(Invariance, DoesNotDependOnUnits) {
  for (const Scene& scene : {quasi_static, dynamic}) {
    const double length = 8.0, stress = 2.0, time = 16.0;
    Scene other = scene;
    other.assembly.fibre_length *= length;
    other.assembly.fibre_height *= length;
    other.material.young *= stress;
    other.material.density *= stress * time * time / (length * length);
    other.joints.head_tail *= stress;
    other.joints.flank *= stress;
    other.loading.strain_rate /= time;
    if (other.solver.step) *other.solver.step *= time;
    const Simulation one = simulate(scene), two = simulate(other);
    EXPECT_EQ(one.status, two.status);
    ASSERT_EQ(one.curve.size(), two.curve.size());
    for (std::size_t i = 0; i < one.curve.size(); ++i) {
      EXPECT_NEAR(two.curve[i].strain, one.curve[i].strain, 1e-12 * one.failure_strain);
      EXPECT_NEAR(two.curve[i].stress_right / stress, one.curve[i].stress_right,
                  1e-9 * one.strength);
      EXPECT_EQ(two.curve[i].broken_joints, one.curve[i].broken_joints);
    }
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

// At 0° the pattern is its own mirror image: mirrored thresholds break in mirrored places.
TEST(Mirror, BreaksInMirroredPlaces) {
  Scene scene = test::small_scene(0.0);
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  Scene image = scene;
  image.joints.thresholds = scene.joints.thresholds = draw_thresholds(scene, assembly);
  std::vector<std::size_t> mirror(assembly.joints.size());
  for (std::size_t i = 0; i < mirror.size(); ++i) {
    const Eigen::Vector2d place(assembly.width - assembly.joints[i].position.x(),
                                assembly.joints[i].position.y());
    while ((assembly.joints[mirror[i]].position - place).norm() > 1e-12) ++mirror[i];
    image.joints.thresholds[mirror[i]] = scene.joints.thresholds[i];
  }
  const Simulation one = simulate(scene), other = simulate(image);
  EXPECT_GT(one.broken_joints, 1);
  ASSERT_EQ(one.curve.size(), other.curve.size());
  for (std::size_t i = 0; i < one.curve.size(); ++i)
    EXPECT_NEAR(one.curve[i].stress_right, other.curve[i].stress_right, 1e-8 * one.strength);
  for (std::size_t i = 0; i < mirror.size(); ++i)
    EXPECT_EQ(one.joints[i].broken, other.joints[mirror[i]].broken);
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

// Both regimes tell the same story where the loading is slow.
TEST_P(Invariance, HasTheQuasiStaticLimitForItsSlowMotion) {
  Scene slow = dynamic;
  slow.loading.strain_rate = 10.0;
  slow.solver.step = 1e-7;
  slow.loading.lateral = quasi_static.loading.lateral;
  const Simulation limit = simulate(quasi_static), motion = simulate(slow);
  EXPECT_NEAR(motion.first_break_strain / limit.first_break_strain, 1.0, 2e-3);
  EXPECT_NEAR(motion.modulus / limit.modulus, 1.0, 1e-8);
  EXPECT_NEAR(motion.curve[1].stress_right, limit.modulus * motion.curve[1].strain, 1.0);
}

}  // namespace
}  // namespace havers::sim
