#include "sim/contact/state_system.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "tests/sim/contact/enumerated_contact.hpp"

namespace havers::sim {
namespace {

using Eigen::VectorXd;

// More changes than a factor is bordered with, one at a time: each answer is that of the full
// equations, from nothing as from the last one, of two loads at once.
TEST(StateSystem, FollowsAnyWalkOfItsStates) {
  const LocalContact problem = test::random_contact(40, 0.3, 1);
  LocalContact other = problem;
  other.r0 = problem.r0.reverse();
  other.u0.setZero();
  Eigen::MatrixX2d r0(80, 2), held(80, 2), cohesion(40, 2);
  r0 << problem.r0, other.r0;
  held << -problem.u0, other.u0;
  cohesion << cohesions(problem), cohesions(other);
  StateSystem system(problem);
  StateSolution known{Eigen::MatrixX2d::Zero(80, 2), r0};
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const auto joint = static_cast<std::size_t>(random() % 40);
    system.set(joint, static_cast<JointState>(random() % 4));
    const VectorXd truth = test::gaps_of(problem, system.states());
    ASSERT_LT((system.solve().y - truth).norm(), 1e-9 * truth.norm()) << "change " << i;
    known = system.solve_from(std::move(known), r0, held, cohesion, 1e-12);
    ASSERT_LT((known.y.col(0) - truth).norm(), 1e-9 * truth.norm()) << "change " << i;
    const VectorXd others = test::gaps_of(other, system.states());
    ASSERT_LT((known.y.col(1) - others).norm(), 1e-9 * others.norm()) << "change " << i;
  }
}

TEST(StateSystem, TakesJointsInOnTheWay) {
  const LocalContact whole = test::random_contact(12, 0.3, 2);
  LocalContact problem;
  StateSystem system(problem);
  for (Eigen::Index n = 1; n <= 12; ++n) {
    problem.S = whole.S.topLeftCorner(2 * n, 2 * n);
    problem.r0 = whole.r0.head(2 * n);
    problem.u0 = whole.u0.head(2 * n);
    problem.laws.push_back(whole.laws[static_cast<std::size_t>(n - 1)]);
    system.grow();
    system.set(static_cast<std::size_t>(n - 1),
               n % 2 == 0 ? JointState::open : JointState::slip_forward);
    const VectorXd truth = test::gaps_of(problem, system.states());
    EXPECT_LT((system.solve().y - truth).norm(), 1e-9 * truth.norm()) << n << " joints";
  }
}

}  // namespace
}  // namespace havers::sim
