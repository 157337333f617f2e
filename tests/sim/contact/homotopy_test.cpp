#include "sim/contact/homotopy.hpp"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "tests/sim/contact/enumerated_contact.hpp"

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

// Joints that are all alike and far from each other would change their states at once.
TEST_P(FromSticking, ArrivesWhereAllJointsAreAlike) {
  const LocalContact one = test::random_contact(1, friction, 5);
  LocalContact all{.S = Eigen::MatrixXd::Zero(2 * joints, 2 * joints),
                   .r0 = one.r0.replicate(joints, 1),
                   .u0 = one.u0.replicate(joints, 1),
                   .laws = {one.laws.begin(), one.laws.end()}};
  all.laws.assign(static_cast<std::size_t>(joints), one.laws.front());
  for (Index i = 0; i < joints; ++i) all.S.block<2, 2>(2 * i, 2 * i) = one.S;
  StateSystem system(all);
  const auto result = follow_homotopy(system, from_sticking(system));
  ASSERT_TRUE(result.converged);
  EXPECT_TRUE(test::keeps_law(all, result.y, 1e-9));
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
        const VectorXd y = system.solve(problem.r0, -problem.u0, cohesions(problem)).y;
        EXPECT_TRUE(test::keeps_law(problem, y, 1e-9)) << "seed " << seed;
      }
}

}  // namespace
}  // namespace havers::sim
