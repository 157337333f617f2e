// What is known of a specimen after its first break, and of joint forces when joints slide or are
// open, whatever the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/contact/active_set.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/simulation.hpp"
#include "tests/sim/structure/dense_structure.hpp"
#include "tests/support/bonded_wall.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A row of fibres is as strong as its weakest joint, however long it is, and only that one breaks.
TEST(AfterTheBreak, AChainOfThousandIsAsStrongAsItsWeakestJoint) {
  Scene scene = test::small_scene(0.0, 1, 1000);
  scene.joints.scatter = 0.8;
  scene.joints.reinforced_boundary = false;
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  const std::vector<Threshold> thresholds = draw_thresholds(scene, assembly);
  const auto weakest =
      std::min_element(thresholds.begin(), thresholds.end(),
                       [](const auto& a, const auto& b) { return a.normal < b.normal; });
  const double strength = weakest->normal / scene.assembly.fibre_height;
  const auto at = static_cast<std::size_t>(weakest - thresholds.begin());
  const Simulation limit = simulate(scene);
  EXPECT_NEAR(limit.strength / strength, 1.0, 1e-9);
  EXPECT_EQ(limit.broken_joints, 1);
  EXPECT_TRUE(limit.joints[at].broken);

  // In time too, where a wave takes 1e-4 of the time to failure. The strain is a multiple of a
  // step's.
  scene.solver.regime = Regime::dynamic;
  scene.loading.strain_rate = 0.01;
  scene.solver.step = 0.01 * limit.failure_strain / scene.loading.strain_rate;
  const Simulation stepped = simulate(scene);
  EXPECT_NEAR(stepped.strength / strength, 1.0, 0.011);
  EXPECT_EQ(stepped.broken_joints, 1);
  EXPECT_TRUE(stepped.joints[at].broken);
}

class AnyStep : public testing::TestWithParam<std::tuple<double, double>> {};
INSTANTIATE_TEST_SUITE_P(OrientationAndLength, AnyStep,
                         testing::Combine(testing::Values(0.0, 30.0),
                                          testing::Values(1e-3, 1e-1, 1.0, 30.0, 1e3, 1e6)));

// With the states that were found, the full equations of motion give the same reactions: joints
// that slide and that are open among those that hold.
TEST_P(AnyStep, JointForcesAreThoseOfTheFullEquations) {
  const auto [degrees, length] = GetParam();
  Scene scene = test::wall(3, 2);
  scene.assembly.orientation = degrees * test::degree;
  const double h = test::step_of(scene, length);
  test::WallStep wall(scene, 0.003, h);
  JointStep& step = wall.step;
  for (std::size_t j = 0; j < step.laws.size(); j += 5) {
    step.broken[j] = 1;
    step.laws[j] = broken_law(0.3);
  }
  for (std::size_t j = 0; j < step.laws.size(); j += 10)  // sliding, together or apart
    step.predicted.segment<2>(static_cast<Index>(2 * j)) << (j % 20 == 0 ? -1e-8 : 1e-8), 2e-8;
  const JointStepResult result = ActiveSetSolver(wall.bodies).solve(step);
  ASSERT_TRUE(result.converged);
  const auto count = [&](auto state) {
    return std::count_if(result.states.begin(), result.states.end(), state);
  };
  EXPECT_GT(count([](JointState s) { return s == JointState::open; }), 0);
  EXPECT_GT(count([](JointState s) { return slip_sign(s) != 0.0; }), 0);
  EXPECT_GT(count([](JointState s) { return s == JointState::stick; }), 0);

  const auto rows = static_cast<Index>(2 * step.laws.size());
  StructureLoads loads{step.forces, step.prescribed, -step.predicted};
  loads.given = VectorXd::Zero(rows);
  loads.friction = VectorXd::Zero(rows / 2);
  std::vector<Held> held;
  for (std::size_t j = 0; j < step.laws.size(); ++j) {
    const JointState state = result.states[j];
    const JointLaw& law = step.laws[j];
    const double slope = -slip_sign(state) * law.friction;
    const auto row = static_cast<Index>(2 * j);
    held.push_back(state == JointState::stick  ? Held::fully
                   : state == JointState::open ? Held::not_at_all
                                               : Held::normal);
    if (state == JointState::open) loads.given(row) = -law.cohesion;
    if (slope != 0.0) loads.given(row + 1) = slope * law.cohesion;
    loads.friction(row / 2) = slope;
  }
  const test::DenseStructure dense(wall.assembly, scene.material, {1.0 / (h * h), 1.0});
  const VectorXd truth = dense.solve(loads, held).reactions;
  EXPECT_LT((result.reactions - truth).norm(), 1e-9 * truth.norm());
}

}  // namespace
}  // namespace havers::sim
