#include "sim/contact/homotopy.hpp"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "sim/assembly/assembly.hpp"
#include "sim/contact/loose_joints.hpp"
#include "sim/scene.hpp"
#include "tests/sim/contact/enumerated_contact.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using States = std::vector<JointState>;

class FromSticking : public testing::TestWithParam<std::tuple<int, double>> {
 protected:
  const int joints = std::get<0>(GetParam());
  const double friction = std::get<1>(GetParam());
};
// From 1 on friction is above the wedging limit: paths turn back, and go on where λ grows.
INSTANTIATE_TEST_SUITE_P(JointsAndFriction, FromSticking,
                         testing::Combine(testing::Values(1, 2, 3, 12, 30),
                                          testing::Values(0.0, 0.3, 1.0, 5.0, 20.0)));

TEST_P(FromSticking, ArrivesOnAnyWay) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const LocalContact problem = test::random_contact(joints, friction, seed);
    for (const int way : {0, 1, 2}) {
      StateSystem system(problem);
      const auto result = follow_homotopy(system, from_sticking(system, way));
      ASSERT_TRUE(result.converged) << "seed " << seed << ", way " << way;
      EXPECT_TRUE(test::keeps_law(problem, result.y, 1e-9)) << "seed " << seed << ", way " << way;
    }
  }
}

TEST_P(FromSticking, LeavesOpenWhatIsApart) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    LocalContact problem = test::random_contact(joints, friction, seed);
    std::mt19937 random(seed);
    std::bernoulli_distribution apart(0.3);
    for (int i = 0; i < joints; ++i) problem.apart.push_back(apart(random) ? 1 : 0);
    StateSystem system(problem);
    const auto result = follow_homotopy(system, from_sticking(system));
    ASSERT_TRUE(result.converged) << "seed " << seed;
    EXPECT_LT(law_residual_of(problem, result.y), 1e-10) << "seed " << seed;
    for (std::size_t i = 0; i < problem.laws.size(); ++i)
      EXPECT_TRUE(!problem.is_apart(i) || result.states[i] == JointState::open);
  }
}

// At λ = 1 the states that a path starts from are the answer.
TEST_P(FromSticking, AndFromOtherStatesStartsAtAnAnswer) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const JointState state :
         {JointState::stick, JointState::open, JointState::slip_forward, JointState::slip_backward})
      for (const bool sticking : {true, false}) {
        LocalContact problem = test::random_contact(joints, friction, seed);
        StateSystem system(problem, States(problem.laws.size(), state));
        const Homotopy added = sticking ? from_sticking(system) : from_states(system).value();
        if (added.reactions.size() > 0) problem.r0 += added.reactions;
        if (added.gaps.size() > 0) problem.u0 += added.gaps;
        for (Index i = 0; i < added.cohesion.size(); ++i)
          problem.laws[static_cast<std::size_t>(i)].cohesion += added.cohesion(i);
        const VectorXd y = system.solve().y;
        EXPECT_TRUE(test::keeps_law(problem, y, 1e-9)) << "seed " << seed;
      }
}

// Most joints of a wall in long steps, any gaps and forces: joints that close have slipped since
// the branch began.
TEST(FromStickingInAWall, ArrivesInLongSteps) {
  HAVERS_SLOW;
  for (const double angle : {0.0, 30.0}) {
    const Scene scene = test::small_scene(angle, 5, 4);
    const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
    const double h = 100.0 * scene.assembly.fibre_length / wave_speed(scene.material);
    const Bodies bodies(assembly, scene.material, {1.0 / (h * h), 1.0});
    const Structure structure(bodies);
    for (const double friction : {0.6, 1.4})
      for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        LooseJoints loose(structure);
        std::bernoulli_distribution broken(0.7);
        for (int joint = 0; joint < static_cast<int>(assembly.joints.size()); ++joint)
          if (broken(random)) loose.add(joint);
        LocalContact problem{.S = loose.stiffness(), .r0 = {}, .u0 = {}, .laws = {}};
        std::normal_distribution<double> gap(0.0, 1e-7);
        const auto draw = [&] { return gap(random); };
        problem.u0 = VectorXd::NullaryExpr(problem.S.rows(), draw);
        problem.r0 = problem.S * VectorXd::NullaryExpr(problem.S.rows(), draw);
        problem.laws.assign(loose.size(), broken_law(friction));
        StateSystem system(problem);
        const auto result = follow_homotopy(system, from_sticking(system));
        EXPECT_TRUE(result.converged) << angle << ", " << friction << ", " << seed;
        EXPECT_LT(law_residual_of(problem, result.y), 1e-9) << angle << ", " << seed;
      }
  }
}

}  // namespace
}  // namespace havers::sim
