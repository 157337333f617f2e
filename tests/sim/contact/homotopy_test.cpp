#include "sim/contact/homotopy.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/sim/contact/enumerated_contact.hpp"

namespace havers::sim {
namespace {

using Eigen::VectorXd;

VectorXd sticking_cohesion(const LocalContact& problem) {
  return cohesion_to_stick(problem.r0 - problem.S * problem.u0, problem.laws);
}

LocalContactResult release_from_sticking(const LocalContact& problem) {
  StateSystem system(problem);
  return follow_homotopy(system, {.cohesion = sticking_cohesion(problem)});
}

class ReleasePath : public testing::TestWithParam<std::tuple<int, double>> {};
INSTANTIATE_TEST_SUITE_P(JointsAndFriction, ReleasePath,
                         testing::Combine(testing::Values(1, 2, 3),
                                          testing::Values(0.0, 0.3, 1.0, 3.0)));

TEST_P(ReleasePath, ArrivesAtAnAnswer) {
  const auto [joints, friction] = GetParam();
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const LocalContact problem = test::random_contact(joints, friction, seed);
    const auto result = release_from_sticking(problem);
    EXPECT_TRUE(result.converged) << "seed " << seed;
    EXPECT_TRUE(test::keeps_law(problem, result.y, 1e-10)) << "seed " << seed;
  }
}

// With μ above the wedging limit the path turns back, and goes on where λ grows.
TEST(ReleasePathFromAllSticking, ArrivesWhateverTheFriction) {
  for (const int joints : {1, 3, 12, 30})
    for (const double friction : {0.3, 1.0, 5.0, 20.0})
      for (unsigned seed = 1; seed <= 100; ++seed) {
        const LocalContact problem = test::random_contact(joints, friction, seed);
        StateSystem system(problem);
        const double extra = sticking_cohesion(problem).maxCoeff();
        const auto result =
            follow_homotopy(system, {.cohesion = VectorXd::Constant(joints, extra)});
        ASSERT_TRUE(result.converged) << joints << ", " << friction << ", " << seed;
        EXPECT_TRUE(test::keeps_law(problem, result.y, 1e-9)) << seed;
      }
}

TEST(CohesionToStick, LetsEveryJointStick) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    LocalContact problem = test::random_contact(3, 0.4, seed);
    const VectorXd extra = sticking_cohesion(problem);
    for (std::size_t i = 0; i < 3; ++i)
      problem.laws[i].cohesion += extra(static_cast<Eigen::Index>(i));
    EXPECT_TRUE(test::keeps_law(problem, -problem.u0, 1e-12));
  }
}

}  // namespace
}  // namespace havers::sim
