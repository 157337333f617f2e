// One suite of laws that every joint solver must keep: a new solver joins by one line below.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <random>

#include "sim/contact/active_set.hpp"
#include "sim/contact/gauss_seidel.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/structure/structure.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct Kind {
  const char* name;
  std::function<std::unique_ptr<JointSolver>(const Bodies&)> make;
};

const Kind active_set{
    "ActiveSet", [](const Bodies& bodies) { return std::make_unique<ActiveSetSolver>(bodies); }};
const Kind active_set_whole{"ActiveSetWithoutDetaching", [](const Bodies& bodies) {
                              return std::make_unique<ActiveSetSolver>(bodies, false);
                            }};
const Kind gauss_seidel{"GaussSeidel", [](const Bodies& bodies) {
                          return std::make_unique<GaussSeidelSolver>(bodies, 1e-11, 200000);
                        }};

class EveryJointSolver : public testing::TestWithParam<std::tuple<Kind, double>> {
 protected:
  static constexpr double h = 5e-9;  // [s], h c/L = 0.13
  Scene scene = test::small_scene(std::get<1>(GetParam()), 3, 2);
  Assembly assembly = build_assembly(scene.assembly, Lateral::periodic);
  Bodies bodies{assembly, scene.material, {1.0 / (h * h), 1.0}};
  std::unique_ptr<JointSolver> solver = std::get<0>(GetParam()).make(bodies);

  // A step that stretches the specimen by ε, all joints intact: body forces that would give the
  // uniform field, and the sides moved along with it.
  [[nodiscard]] JointStep stretch(double strain) const {
    JointStep step;
    const auto rows = static_cast<Index>(2 * assembly.joints.size());
    step.forces = step.prescribed = VectorXd::Zero(bodies.dofs());
    step.predicted = step.gaps = step.held_at = step.reactions = VectorXd::Zero(rows);
    for (std::size_t i = 0; i < assembly.nodes.size(); ++i)
      step.forces.segment<2>(static_cast<Index>(2 * i)) << strain * assembly.nodes[i].x(),
          -0.33 * strain * assembly.nodes[i].y();
    step.forces = step.forces.cwiseProduct(bodies.mass()) / (h * h);
    for (const int node : assembly.right) step.prescribed(2 * node) = strain * assembly.width;
    for (const Threshold& threshold : draw_thresholds(scene, assembly))
      step.laws.push_back(intact_law(threshold));
    step.states.assign(step.laws.size(), JointState::stick);
    step.broken.assign(step.laws.size(), 0);
    return step;
  }

  // Ā δ = g + Hᵀ r at every free node that no tie holds, and the prescribed displacements.
  void expect_motion(const JointStep& step, const JointStepResult& result) const {
    const VectorXd forces = step.forces + joint_forces_on_nodes(bodies, result.reactions);
    VectorXd missing = bodies.shifted_times(result.displacements) - forces;
    for (const Tie& tie : assembly.ties)
      for (const auto& edge : {tie.edge_top, tie.edge_bottom})
        for (const int node : edge) missing(2 * node + 1) = 0.0;
    for (Index i = 0; i < bodies.dofs(); ++i) {
      if (bodies.held()[static_cast<std::size_t>(i)] == 0) continue;
      missing(i) = 0.0;
      EXPECT_EQ(result.displacements(i), step.prescribed(i));
    }
    EXPECT_LT(missing.norm(), 1e-9 * forces.norm());
    EXPECT_LT((result.gaps - step.predicted - joint_gaps(bodies, result.displacements)).norm(),
              1e-10 * result.displacements.norm());
  }

  static int count(const JointStepResult& result, JointState state) {
    return static_cast<int>(std::count(result.states.begin(), result.states.end(), state));
  }
};
INSTANTIATE_TEST_SUITE_P(, EveryJointSolver,
                         testing::Combine(testing::Values(active_set, active_set_whole,
                                                          gauss_seidel),
                                          testing::Values(0.0, 45.0, 90.0)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) + "At" +
                                  std::to_string(static_cast<int>(std::get<1>(test.param)));
                         });

TEST_P(EveryJointSolver, HoldsAllJointsUnderALittleStrain) {
  const JointStep step = stretch(1e-5);
  const JointStepResult result = solver->solve(step);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(count(result, JointState::stick), static_cast<int>(step.laws.size()));
  EXPECT_LT(result.gaps.cwiseAbs().maxCoeff(), 1e-9 * 1e-5 * assembly.width);
  expect_motion(step, result);
  for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
    const Joint& joint = assembly.joints[j];
    const double pull = -scene.material.young * 1e-5 * joint.normal.x() * joint.length;
    EXPECT_NEAR(result.reactions(static_cast<Index>(2 * j)), pull * joint.normal.x(), 1e-4);
  }
}

TEST_P(EveryJointSolver, StopsWhenAskedTo) {
  JointStep step = stretch(0.01);
  const long whole = solver->solve(step).iterations;
  solver = std::get<0>(GetParam()).make(bodies);
  step.stop_asked = [] { return true; };
  const JointStepResult stopped = solver->solve(step);
  EXPECT_FALSE(stopped.converged);
  EXPECT_LT(stopped.iterations, whole);
}

TEST_P(EveryJointSolver, OpensAndSlidesWhatIsOverloaded) {
  const JointStep step = stretch(0.01);
  const JointStepResult result = solver->solve(step);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.residual, 1e-6);
  EXPECT_LT(joint_residual(step, result, joint_stiffness(bodies)), 1e-8);
  EXPECT_GT(count(result, JointState::open), 0);
  EXPECT_LT(count(result, JointState::stick), static_cast<int>(step.laws.size()));
  expect_motion(step, result);
}

// What the first step overloaded is broken in the second, which presses the specimen together.
TEST_P(EveryJointSolver, ClosesBrokenJointsWithFriction) {
  const JointStepResult first = solver->solve(stretch(0.01));
  JointStep step = stretch(-0.005);
  for (std::size_t j = 0; j < step.laws.size(); ++j) {
    if (first.states[j] == JointState::stick) continue;
    step.broken[j] = 1;
    step.laws[j] = broken_law(0.3);
  }
  step.states = first.states;
  step.force_scale = first.reactions.norm();
  const JointStepResult result = solver->solve(step);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(joint_residual(step, result, joint_stiffness(bodies)), 1e-8);
  expect_motion(step, result);
}

// The answer to a step is one: whatever finds it, and whatever was solved before.
TEST_P(EveryJointSolver, AgreesWithTheActiveSet) {
  for (const double strain : {0.002, 0.005, 0.02}) {
    const JointStep step = stretch(strain);
    const JointStepResult found = solver->solve(step);
    EXPECT_TRUE(found.converged);
    EXPECT_LT(joint_residual(step, found, joint_stiffness(bodies)), 1e-10);
    expect_motion(step, found);
    const JointStepResult other = active_set.make(bodies)->solve(step);
    EXPECT_LT((found.reactions - other.reactions).norm(), 1e-7 * other.reactions.norm());
    EXPECT_LT((found.displacements - other.displacements).norm(),
              1e-7 * other.displacements.norm());
    EXPECT_EQ(found.states, other.states);
  }
}

// Friction leaves several answers here, of which sweeps find the nearest to the last step's.
TEST_P(EveryJointSolver, TakesTheAnswerOfSweepsWhereFrictionIsStrong) {
  HAVERS_SLOW;
  scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, 0.5);
  for (const double strain : {0.0008, 0.001, 0.0015}) {
    const JointStep step = stretch(strain);
    const JointStepResult found = solver->solve(step);
    const JointStepResult nearest = gauss_seidel.make(bodies)->solve(step);
    EXPECT_TRUE(nearest.converged);
    EXPECT_LT(joint_residual(step, found, joint_stiffness(bodies)), 1e-10);
    EXPECT_LT((found.reactions - nearest.reactions).norm(), 1e-7 * nearest.reactions.norm());
  }
}

// Nor does it matter how joints are numbered, not even where all break together.
TEST_P(EveryJointSolver, DoesNotKnowTheOrderOfJoints) {
  std::vector<std::size_t> order(assembly.joints.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  Assembly shuffled = assembly;
  for (std::size_t j = 0; j < order.size(); ++j) shuffled.joints[j] = assembly.joints[order[j]];
  const Bodies others(shuffled, scene.material, {1.0 / (h * h), 1.0});
  for (const double scatter : {0.0, 1.0}) {
    scene.joints.scatter = scatter;
    const JointStep step = stretch(0.01);
    JointStep other = step;
    for (std::size_t j = 0; j < order.size(); ++j) other.laws[j] = step.laws[order[j]];
    const JointStepResult one = solver->solve(step),
                          two = std::get<0>(GetParam()).make(others)->solve(other);
    EXPECT_TRUE(two.converged);
    EXPECT_LT(count(two, JointState::stick), static_cast<int>(order.size()));
    for (std::size_t j = 0; j < order.size(); ++j)
      EXPECT_LT((two.reactions.segment<2>(static_cast<Index>(2 * j)) -
                 one.reactions.segment<2>(static_cast<Index>(2 * order[j])))
                    .norm(),
                1e-7 * one.reactions.norm());
  }
}

// The same force on every node, from rest.
JointStep first_step(const Bodies& bodies) {
  const std::size_t joints = bodies.assembly().joints.size();
  JointStep step;
  step.forces = VectorXd::Constant(bodies.dofs(), 1.0);
  step.prescribed = VectorXd::Zero(bodies.dofs());
  step.predicted = step.gaps = step.held_at = step.reactions =
      VectorXd::Zero(static_cast<Index>(2 * joints));
  step.laws.assign(joints, intact_law({500.0, 500.0}));
  step.states.assign(joints, JointState::stick);
  step.broken.assign(joints, 0);
  return step;
}

// The factor has no pivots, which a broken joint must not ask for what it does to the others.
TEST(ActiveSetSolver, AsksNothingOfAFactorWithoutPivots) {
  const Scene scene = test::small_scene(5.0, 300, 1);
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  const Bodies bodies(assembly, scene.material, {1.0 / (2e-8 * 2e-8), 1.0});
  ASSERT_FALSE(Structure(bodies).ok());
  JointStep step = first_step(bodies);
  step.broken[7] = 1;
  step.laws[7] = broken_law(0.3);
  const JointStepResult result = ActiveSetSolver(bodies).solve(step);
  EXPECT_EQ(result.states.size(), assembly.joints.size());
  EXPECT_TRUE(!result.converged || result.residual < 1e-9);
}

TEST(GaussSeidelSolver, SaysWhenItRanOutOfSweeps) {
  const Scene scene = test::small_scene(0.0, 3, 2);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
  const Bodies bodies(assembly, scene.material, {1e14, 1.0});
  const JointStepResult result = GaussSeidelSolver(bodies, 1e-12, 2).solve(first_step(bodies));
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_GT(result.residual, 1e-12);
}

}  // namespace
}  // namespace havers::sim
