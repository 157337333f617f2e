// What leaves a breaking sequence few digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sim/quasi_static/intact_structure.hpp"
#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// Where a tie nearly does what a body's other ports do, a joint of 50 MPa bore 10 GPa. Nothing is
// left out: the uniform stress (M1) is compared with what was solved for.
TEST(BreakingDigits, LosesNoDigitsWhereATieSaysNearlyWhatOthersSay) {
  Scene scene = test::small_scene(-2.7, 2, 2);
  scene.assembly.fibre_length = 118.7e-6;
  scene.loading.lateral = Lateral::periodic;
  for (const int refinement : {1, 2}) {
    scene.assembly.refinement = refinement;
    scene.solver.leave_out = false;
    const auto intact = intact_structure(scene);
    ASSERT_FALSE(intact->assembly().ties.empty());
    const Eigen::VectorXd exact = uniform_stress_forces(intact->assembly(), 1.0);
    EXPECT_LT((intact->answer().reactions - exact).lpNorm<Eigen::Infinity>(),
              1e-8 * exact.lpNorm<Eigen::Infinity>())
        << refinement;
    const Simulation run = simulate(scene);
    EXPECT_TRUE(run.trusted()) << run.why_not_trusted();
    scene.solver.leave_out = true;
    EXPECT_NEAR(simulate(scene).strength / run.strength, 1.0, 1e-9);
  }
}

// Stiff in one way by 5000 times what it is in others.
Scene nearly_incompressible(std::uint64_t seed) {
  Scene scene = test::small_scene(0.0, 5, 4);
  scene.material.plane = Plane::strain;
  scene.material.poisson = 0.4999;
  scene.joints.scatter = 1.0;
  scene.joints.friction = 0.6;
  scene.joints.seed = seed;
  return scene;
}

// What an avalanche's pieces do has few digits, its strength has all of them.
TEST(BreakingDigits, IsTrustedWhereTheMaterialHardlyChangesItsVolume) {
  double defect = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Simulation run = simulate(nearly_incompressible(seed));
    EXPECT_TRUE(run.trusted()) << seed << ' ' << run.why_not_trusted();
    EXPECT_LE(run.rounding_error, 1e-8);
    defect = std::max(defect, run.energy_defect);
  }
  EXPECT_GT(defect, 1e-14) << "a hundred times what rounding leaves of two numbers";
}

// A solve that misses the law's equations by more than is asked for does not pass for an answer.
TEST(BreakingDigits, IsNotTrustedToAToleranceBelowThem) {
  Scene scene = nearly_incompressible(1);
  const double residual = simulate(scene).residual_to_strength;
  ASSERT_GT(residual, 0.0);
  scene.solver.tolerance = 0.01 * residual;
  EXPECT_EQ(simulate(scene).why_not_trusted(), "the joints' law is not met to the tolerance");
}

// What rounding leaves of gaps that are closed. An event is at one strain and the next at a larger
// one: overlaps grow with it until then.
TEST(BreakingDigits, LeaveNoLargerOverlapThanIsSeen) {
  double largest = 0.0;
  for (std::uint64_t seed = 3; seed <= 9; ++seed) {
    double seen = 0.0, overlap = 0.0, strain = 0.0;
    const auto look = [&](const std::vector<JointOutcome>& joints, double now) {
      if (strain > 0.0) seen = std::max(seen, overlap * now / strain);
      overlap = 0.0;
      for (const JointOutcome& joint : joints) overlap = std::max(overlap, -joint.gap);
      strain = now;
    };
    const Simulation run = simulate(nearly_incompressible(seed), [&](const Progress& progress) {
      look(progress.joints(), progress.point.strain);
    });
    strain = 0.0;  // the last row is one that was seen, with more digits
    look(run.joints, run.curve.back().strain);
    EXPECT_NEAR(run.worst_penetration, std::max(seen, overlap), 1e-9 * run.worst_penetration);
    largest = std::max(largest, run.worst_penetration);
  }
  EXPECT_GT(largest, 0.0);
}

// An event whose contact is not found is left without: what overlaps then is said.
TEST(BreakingDigits, CountOverlapsOfEventsWithoutContact) {
  Scene scene = test::small_scene(0.0, 9, 6);
  scene.material.poisson = -0.9;
  scene.joints.flank =
      flank_from_ratio(scene.assembly, scene.joints.head_tail, 0.12548133189325758);
  scene.joints.scatter = 0.703042392579633;
  scene.joints.missing = 0.1;
  scene.joints.friction = 2.0;
  scene.joints.seed = 97;
  scene.loading.lateral = Lateral::free;
  scene.loading.max_strain = 0.1;
  scene.loading.end_fraction = 0.02;
  const Simulation run = simulate(scene);
  double overlap = 0.0;
  for (const JointOutcome& joint : run.joints) overlap = std::max(overlap, -joint.gap);
  ASSERT_GT(run.events_without_contact, 0);
  ASSERT_GT(overlap, scene.assembly.fibre_height);
  EXPECT_GE(run.worst_penetration, overlap);
}

}  // namespace
}  // namespace havers::sim
