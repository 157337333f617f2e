// Which joint is next is found in single precision first; nothing of that may be seen in an answer.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "sim/joint/thresholds.hpp"
#include "sim/quasi_static/breaking_sequence.hpp"
#include "tests/support/broken_joints.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// The fourth joint to break, and the strain at which it does.
std::pair<std::size_t, double> fourth_break(const Scene& scene) {
  int broken = 0;
  const Simulation simulation = simulate_quasi_static(
      scene, [&](const Progress& now) { broken = now.point.broken_joints; },
      [&] { return broken >= 4; });
  std::pair<std::size_t, double> last{0, 0.0};
  for (const std::size_t j : test::broken_joints(simulation.joints))
    if (const double at = simulation.joints[j].broken_at_strain; at > last.second) last = {j, at};
  return last;
}

// Two joints that would break at the same strain but for a ten-millionth part.
TEST(BreakingSearch, TellsJointsApartThatSinglePrecisionCannot) {
  Scene scene = test::small_scene(0.0, 12, 8);
  scene.joints.scatter = 1.0;
  scene.joints.thresholds =
      draw_thresholds(scene, build_assembly(scene.assembly, scene.loading.lateral));
  const auto [joint, strain] = fourth_break(scene);
  const Threshold drawn = scene.joints.thresholds[joint];
  const auto make_stronger = [&, joint = joint](double times) {
    scene.joints.thresholds[joint] = {drawn.normal * times, drawn.tangent * times};
  };
  make_stronger(1.5);
  const auto [other, later] = fourth_break(scene);
  ASSERT_NE(other, joint);
  ASSERT_GT(later, strain);
  make_stronger(later / strain * (1.0 - 1e-7));
  EXPECT_EQ(fourth_break(scene).first, joint);
  make_stronger(later / strain * (1.0 + 1e-7));
  EXPECT_EQ(fourth_break(scene).first, other);
}

// First by passes through the factor, later by columns that are remembered.
TEST(BreakingSearch, SaysTheSameWhateverHasRunBefore) {
  Scene scene = test::small_scene(0.0, 14, 10);
  scene.material.poisson = 0.2345;  // of no other test
  const auto run = [&](std::uint64_t seed) {
    scene.joints.seed = seed;
    return simulate_quasi_static(scene, {});
  };
  const Simulation first = run(1);
  EXPECT_GT(first.steps, 10);
  for (const std::uint64_t seed : {2U, 1U, 3U, 1U, 1U}) {
    const Simulation again = run(seed);
    if (seed != 1) continue;
    EXPECT_EQ(again.strength, first.strength);
    EXPECT_EQ(again.worst_residual, first.worst_residual);
    EXPECT_EQ(test::broken_joints(again.joints), test::broken_joints(first.joints));
    ASSERT_EQ(again.curve.size(), first.curve.size());
    for (std::size_t i = 0; i < first.curve.size(); ++i) {
      EXPECT_EQ(again.curve[i].strain, first.curve[i].strain);
      EXPECT_EQ(again.curve[i].stress_right, first.curve[i].stress_right);
    }
  }
}

}  // namespace
}  // namespace havers::sim
