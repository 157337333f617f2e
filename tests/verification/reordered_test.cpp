// A whole run in time does not depend on how joints are numbered, nor on the side it is looked at
// from.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "sim/joint/thresholds.hpp"
#include "tests/support/reordered_run.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

class Reordered : public testing::TestWithParam<std::tuple<double, double>> {
 protected:
  static constexpr double step = 2e-8;
  Reordered() { scene.joints.scatter = std::get<1>(GetParam()); }

  // Until the specimen is broken.
  [[nodiscard]] int steps() const { return static_cast<int>(simulate(scene).curve.size()) - 1; }

  void expect_same(const test::SteppedRun& one, const test::SteppedRun& other,
                   const std::vector<std::size_t>& order) const {
    const double strength = *std::max_element(one.right.begin(), one.right.end());
    ASSERT_EQ(one.right.size(), other.right.size());
    for (std::size_t i = 0; i < one.right.size(); ++i) {
      EXPECT_NEAR(one.right[i], other.right[i], 1e-9 * strength) << "step " << i;
      EXPECT_NEAR(one.left[i], other.left[i], 1e-9 * strength) << "step " << i;
    }
    for (std::size_t j = 0; j < order.size(); ++j)
      EXPECT_EQ(one.broken_in[order[j]], other.broken_in[j]) << "joint " << j;
  }

  Scene scene = test::dynamic_scene(std::get<0>(GetParam()), step);
  Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
};
INSTANTIATE_TEST_SUITE_P(OrientationAndScatter, Reordered,
                         testing::Combine(testing::Values(0.0, 45.0), testing::Values(0.0, 0.2)));

std::vector<std::size_t> as_it_is(const Assembly& assembly) {
  std::vector<std::size_t> order(assembly.joints.size());
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

// The loop of (M3) and (M6) written out is what simulate() computes.
TEST_P(Reordered, StepsAreThoseOfTheSimulation) {
  const Simulation run = simulate(scene);
  const test::SteppedRun steps_of_it =
      test::run_steps(scene, assembly, draw_thresholds(scene, assembly), steps());
  ASSERT_EQ(run.curve.size(), steps_of_it.right.size() + 1);
  for (std::size_t i = 0; i + 1 < run.curve.size(); ++i)
    EXPECT_NEAR(run.curve[i + 1].stress_right, steps_of_it.right[i], 1e-9 * run.strength);
  for (std::size_t j = 0; j < run.joints.size(); ++j)
    EXPECT_EQ(run.joints[j].broken, steps_of_it.broken_in[j] >= 0);
}

TEST_P(Reordered, JointsBreakAlikeInAnyOrder) {
  const std::vector<Threshold> thresholds = draw_thresholds(scene, assembly);
  const test::SteppedRun one = test::run_steps(scene, assembly, thresholds, steps());
  for (const unsigned seed : {1U, 2U}) {
    std::vector<std::size_t> order = as_it_is(assembly);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    Assembly shuffled = assembly;
    std::vector<Threshold> drawn = thresholds;
    for (std::size_t j = 0; j < order.size(); ++j) {
      shuffled.joints[j] = assembly.joints[order[j]];
      drawn[j] = thresholds[order[j]];
    }
    expect_same(one, test::run_steps(scene, shuffled, drawn, steps()), order);
  }
}

TEST_P(Reordered, BreaksInTheMirrorAsBeforeIt) {
  const std::vector<Threshold> thresholds = draw_thresholds(scene, assembly);
  const test::SteppedRun one = test::run_steps(scene, assembly, thresholds, steps());
  for (const bool upside_down : {true, false}) {
    test::SteppedRun image =
        test::run_steps(scene, test::mirrored(assembly, upside_down), thresholds, steps());
    if (!upside_down) std::swap(image.left, image.right);  // a wave comes to the other side
    expect_same(one, image, as_it_is(assembly));
  }
}

// Thresholds that are their own mirror image about the middle, where the left side is held.
TEST(SymmetricSpecimen, BreaksSymmetricallyInTime) {
  Scene scene = test::dynamic_scene();
  scene.assembly.layers = 5;
  scene.assembly.refinement = 2;  // has nodes at half the height
  Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  for (const int node : assembly.left)
    if (std::abs(assembly.nodes[static_cast<std::size_t>(node)].y() - 0.5 * assembly.height) <
        1e-12)
      assembly.corner = node;
  ASSERT_GT(assembly.nodes[static_cast<std::size_t>(assembly.corner)].y(), 0.0);
  std::vector<Threshold> thresholds = draw_thresholds(scene, assembly);
  std::vector<std::size_t> mirror(assembly.joints.size());
  for (std::size_t i = 0; i < mirror.size(); ++i) {
    const Eigen::Vector2d image(assembly.joints[i].position.x(),
                                assembly.height - assembly.joints[i].position.y());
    while ((assembly.joints[mirror[i]].position - image).norm() > 1e-12) ++mirror[i];
    thresholds[std::max(i, mirror[i])] = thresholds[std::min(i, mirror[i])];
  }
  const test::SteppedRun run = test::run_steps(scene, assembly, thresholds, 300);
  EXPECT_EQ(run.right.size(), 300U);
  EXPECT_GT(std::count_if(run.broken_in.begin(), run.broken_in.end(), [](int i) { return i >= 0; }),
            4);
  for (std::size_t i = 0; i < mirror.size(); ++i)
    EXPECT_EQ(run.broken_in[i], run.broken_in[mirror[i]]) << "joint " << i;
}

}  // namespace
}  // namespace havers::sim
