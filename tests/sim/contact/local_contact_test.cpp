#include "sim/contact/local_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/assembly/assembly.hpp"
#include "sim/contact/homotopy.hpp"
#include "sim/contact/loose_joints.hpp"
#include "tests/sim/contact/enumerated_contact.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

using Eigen::VectorXd;
using States = std::vector<JointState>;

bool is_among(const VectorXd& y, const std::vector<VectorXd>& solutions) {
  return std::any_of(solutions.begin(), solutions.end(), [&](const VectorXd& other) {
    return (other - y).norm() < 1e-7 * (1.0 + y.norm());
  });
}

class LocalContactProblems : public testing::TestWithParam<std::tuple<int, double>> {
 protected:
  int joints = std::get<0>(GetParam());
  double friction = std::get<1>(GetParam());
};
INSTANTIATE_TEST_SUITE_P(JointsAndFriction, LocalContactProblems,
                         testing::Combine(testing::Values(1, 2, 3),
                                          testing::Values(0.0, 0.3, 1.0, 3.0)));

// Friction may leave several answers; the solver's must be one of them, whatever it starts from.
TEST_P(LocalContactProblems, AreSolvedWhereverEnumerationFindsASolution) {
  int missed = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const LocalContact problem = test::random_contact(joints, friction, seed);
    const auto solutions = test::all_solutions(problem);
    for (const JointState start : {JointState::stick, JointState::open, JointState::slip_forward}) {
      const auto result = solve_local_contact(problem, States(problem.laws.size(), start));
      SCOPED_TRACE(testing::Message()
                   << "seed " << seed << ", " << solutions.size() << " solutions");
      missed += solutions.empty() || result.converged ? 0 : 1;
      if (!result.converged) continue;
      EXPECT_TRUE(test::keeps_law(problem, result.y, 1e-10));
      EXPECT_TRUE(is_among(result.y, solutions));
    }
  }
  EXPECT_EQ(missed, 0);
}

// Lengths, forces and stiffnesses in other units: the same states, the gaps in the other unit.
TEST_P(LocalContactProblems, HaveNoScale) {
  const double force = 0x1p20, length = 0x1p-17;  // powers of two: not even rounding changes
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const LocalContact problem = test::random_contact(joints, friction, seed);
    LocalContact scaled = problem;
    scaled.S *= force / length;
    scaled.r0 *= force;
    scaled.u0 *= length;
    for (JointLaw& law : scaled.laws) law.cohesion *= force;
    const States start(problem.laws.size(), JointState::stick);
    const auto one = solve_local_contact(problem, start);
    const auto other = solve_local_contact(scaled, start);
    EXPECT_EQ(one.converged, other.converged);
    EXPECT_EQ(one.states, other.states);
    EXPECT_LT((other.y / length - one.y).norm(), 1e-12 * (1.0 + one.y.norm()));
  }
}

TEST(LocalContact, OfNoJointsIsSolved) {
  EXPECT_TRUE(solve_local_contact({}, {}).converged);
}

TEST(LocalContact, StartedFromItsAnswerTakesOneSet) {
  const LocalContact problem = test::random_contact(3, 0.3, 4);
  const auto first = solve_local_contact(problem, States(3, JointState::stick));
  const auto again = solve_local_contact(problem, first.states);
  EXPECT_EQ(again.iterations, 1);
  EXPECT_EQ(again.y, first.y);
}

// On the first of its paths: a problem that none of the first sets solves.
TEST(LocalContact, StopsWhenAskedTo) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    LocalContact problem = test::random_contact(12, 20.0, seed);
    const States start(12, JointState::stick);
    const int whole = solve_local_contact(problem, start).iterations;
    problem.stop_asked = [] { return true; };
    const auto stopped = solve_local_contact(problem, start);
    EXPECT_LE(stopped.iterations, 5) << seed;
    EXPECT_EQ(stopped.converged, whole <= 3) << seed;
    EXPECT_EQ(stopped.y.size(), 24);
  }
}

TEST(StateOf, LeavesAStateOnlyWhenItsConditionFails) {
  const JointLaw law{1.0, 0.5};
  const Local none(0.0, 0.0);
  using enum JointState;
  EXPECT_EQ(state_of({0.0, 0.4}, none, stick, law, 1.0), stick);
  EXPECT_EQ(state_of({0.0, -0.6}, none, stick, law, 1.0), slip_forward);
  EXPECT_EQ(state_of({0.0, 0.6}, none, stick, law, 1.0), slip_backward);
  EXPECT_EQ(state_of({-1.1, 0.0}, none, stick, law, 1.0), open);
  EXPECT_EQ(state_of({-1.1, 0.0}, none, slip_forward, law, 1.0), open);
  EXPECT_EQ(state_of({0.0, -0.5}, {0.0, 0.1}, slip_forward, law, 1.0), slip_forward);
  EXPECT_EQ(state_of({0.0, -0.5}, {0.0, -0.1}, slip_forward, law, 1.0), stick);
  EXPECT_EQ(state_of({-1.0, 0.0}, {0.1, 0.0}, open, law, 1.0), open);
  EXPECT_EQ(state_of({-1.0, 0.0}, {-0.1, 0.0}, open, law, 1.0), stick);
  EXPECT_EQ(state_of({0.0, 0.5 + 1e-14}, none, stick, law, 1.0), stick);  // rounding
}

// A broken joint beside one of ratio f1/f2 = 1e-4, whose friction is above the wedging limit: sets
// cycle between stick and open while it slides forward.
TEST(LocalContact, FindsTheSlidingJointThatSetsCycleAround) {
  LocalContact problem;
  problem.S.resize(4, 4);
  problem.S << 162.588, 0.723324, 93.318, -9.76308, 0.723324, 28.6504, -8.6074, 7.87179, 93.318,
      -8.6074, 137.629, -3.38088, -9.76308, 7.87179, -3.38088, 27.281;
  problem.r0 = Eigen::Vector4d(-49.3834, -0.343279, -530.679, -59.6599);
  problem.u0 = Eigen::Vector4d(7.6057, 0.0, 0.0, 0.0);
  problem.laws = {broken_law(0.3), {501.694, 1e4}};
  const auto result = solve_local_contact(problem, {JointState::open, JointState::slip_backward});
  ASSERT_TRUE(result.converged);
  EXPECT_EQ(result.states, (std::vector{JointState::open, JointState::slip_forward}));
  EXPECT_TRUE(test::keeps_law(problem, result.y, 1e-9));
}

// What stays open whatever its gap has to be open where the path starts, and the same all along it.
TEST(LocalContact, IsSolvedBesideJointsThatAreApart) {
  HAVERS_SLOW;
  for (const int joints : {3, 12, 30})
    for (const double friction : {0.3, 20.0})
      for (unsigned seed = 1; seed <= 200; ++seed) {
        LocalContact problem = test::random_contact(joints, friction, seed);
        for (int i = 0; i < joints; ++i) problem.apart.push_back(i % 4 == 2 ? 1 : 0);
        const auto result =
            solve_local_contact(problem, States(problem.laws.size(), JointState::stick));
        ASSERT_TRUE(result.converged) << joints << ", " << friction << ", " << seed;
        EXPECT_LT(law_residual_of(problem, result.y), 1e-9) << seed;
      }
}

// Of a wall in long steps, most joints broken, any gaps and forces: pieces hang on nothing but
// their inertia, 1e-11 to 1e-15 of the stiffness of the others.
TEST(LocalContact, IsSolvedWherePiecesHangOnAlmostNothing) {
  HAVERS_SLOW;
  const Scene scene = test::small_scene(0.0, 4, 5);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::periodic);
  int lawful = 0;
  for (const double h : {1e-3, 1e-1}) {
    const Bodies bodies(assembly, scene.material, {1.0 / (h * h), 1.0 + 1e-6 / h});
    const Structure structure(bodies);
    for (unsigned seed = 1; seed <= 20; ++seed) {
      std::mt19937 random(seed);
      std::normal_distribution<double> normal;
      std::uniform_real_distribution<double> uniform;
      LooseJoints loose(structure);
      for (int joint = 0; joint < static_cast<int>(assembly.joints.size()); ++joint)
        if (uniform(random) < 0.7) loose.add(joint);
      LocalContact problem{.S = loose.stiffness(), .r0 = {}, .u0 = {}, .laws = {}};
      problem.trace = 1e-13;
      const auto draw = [&] { return 1e-7 * normal(random); };
      problem.r0 = 0.1 * problem.S * VectorXd::NullaryExpr(problem.S.rows(), draw);
      problem.u0 = VectorXd::NullaryExpr(problem.S.rows(), draw);
      for (Eigen::Index row = 0; row < problem.u0.size(); row += 2)
        problem.u0(row) = std::abs(problem.u0(row)) - 0.2e-7;
      problem.laws.assign(loose.size(), broken_law(0.3));
      const auto result = solve_local_contact(problem, States(loose.size(), JointState::open));
      if (result.converged && test::keeps_law(problem, result.y, 1e-9 * problem.r0.norm()))
        ++lawful;
    }
  }
  EXPECT_EQ(lawful, 40);
}

// Half of a wall's joints are broken: pieces hang on nothing but 1e-13 of their stiffness.
TEST(LocalContact, IsSolvedWhereHalfOfTheJointsAreBroken) {
  HAVERS_SLOW;
  constexpr double h = 0.1;
  for (const int layers : {3, 4, 5}) {
    const Scene scene = test::small_scene(0.0, layers, 4);
    const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
    const Bodies bodies(assembly, scene.material, {1.0 / (h * h), 1.0});
    const Structure structure(bodies);
    for (unsigned seed = 1; seed <= 40; ++seed) {
      std::mt19937 random(seed);
      LooseJoints loose(structure);
      std::bernoulli_distribution broken(0.5);
      for (int joint = 0; joint < static_cast<int>(assembly.joints.size()); ++joint)
        if (broken(random)) loose.add(joint);
      LocalContact problem{.S = loose.stiffness(), .r0 = {}, .u0 = {}, .laws = {}, .trace = 1e-13};
      std::normal_distribution<double> gap(0.0, 1e-8);
      problem.u0 = VectorXd::Zero(problem.S.rows());
      problem.r0 = problem.S * VectorXd::NullaryExpr(problem.S.rows(), [&] { return gap(random); });
      problem.laws.assign(loose.size(), broken_law(0.05));
      const auto result = solve_local_contact(problem, States(loose.size(), JointState::stick));
      EXPECT_TRUE(result.converged) << layers << ", " << seed;
      EXPECT_LE(law_residual_of(problem, result.y), 1e-8) << layers << ", " << seed;
    }
  }
}

}  // namespace
}  // namespace havers::sim
