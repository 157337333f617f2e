// Where a run that leaves something out ends (end_fraction_used).
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sim/quasi_static/breaking_sequence.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

// Wide intervals of thresholds stop many an avalanche below half of what the specimen bore before,
// and it bears more thereafter.
TEST(AvalancheEnd, GivesTheSameRunWhenNothingIsLeftOut) {
  HAVERS_SLOW;
  for (const double degrees : {0.0, 45.0})
    for (const double scatter : {0.2, 1.0, 1.9})
      for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        Scene scene = test::small_scene(degrees, 8, 5);
        scene.joints.scatter = scatter;
        scene.joints.seed = seed;
        const Simulation one = simulate(scene);
        scene.solver.leave_out = false;
        const Simulation all = simulate(scene);
        EXPECT_NEAR(one.strength / all.strength, 1.0, 1e-9) << degrees << " " << scatter;
        EXPECT_NEAR(one.failure_strain / all.failure_strain, 1.0, 1e-9);
        ASSERT_LE(one.curve.size(), all.curve.size());
        EXPECT_TRUE(scatter <= 1.0 || one.curve.size() == all.curve.size());
        for (std::size_t i = 0; i < one.curve.size(); ++i)
          EXPECT_NEAR(one.curve[i].stress_right / all.strength,
                      all.curve[i].stress_right / all.strength, 1e-8);
      }
}

// The deepest fall of the stress before a wall bears more than ever, as part of what it bore.
double deepest_recovered_fall(const Simulation& simulation) {
  double strength = 0.0, least = 0.0, deepest = 0.0;
  for (const CurvePoint& point : simulation.curve) {
    if (point.stress_right > strength) {
      if (strength > 0.0) deepest = std::max(deepest, 1.0 - least / strength);
      strength = least = point.stress_right;
    }
    least = std::min(least, point.stress_right);
  }
  return deepest;
}

// Among the walls in which avalanches stopped late, for their size. Turned ones of wide intervals
// are followed all the way: one of 630 fibres at 45° fell by 0.63.
TEST(AvalancheEnd, FollowsAvalanchesThatStopAsFarAsTheyDo) {
  HAVERS_SLOW;
  struct Wall {
    int layers, fibres;
    double scatter, ratio;
    std::uint64_t seed;
    double fall;
  };
  for (const Wall& wall : {Wall{13, 6, 1.0, 1.2, 8, 0.07}, Wall{13, 6, 1.0, 1.2, 19, 0.06},
                           Wall{13, 6, 1.0, 1.2, 329, 0.16}, Wall{20, 6, 1.0, 1.2, 9, 0.05},
                           Wall{20, 6, 1.0, 1.2, 25, 0.08}, Wall{20, 10, 1.4, 3.0, 12, 0.12},
                           Wall{14, 12, 1.5, 1.2, 6, 0.09}, Wall{14, 12, 1.5, 0.5, 48, 0.10}}) {
    Scene scene = test::small_scene(0.0, wall.layers, wall.fibres);
    scene.assembly.fibre_length = 20.0 * scene.assembly.fibre_height;
    scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, wall.ratio);
    scene.joints.scatter = wall.scatter;
    scene.joints.seed = wall.seed;
    scene.loading.end_fraction = 0.4;  // below where any is left
    const Simulation one = simulate(scene);
    scene.solver.leave_out = false;
    const Simulation all = simulate(scene);
    EXPECT_GT(deepest_recovered_fall(all), wall.fall);
    EXPECT_LT(one.curve.size(), all.curve.size());
    EXPECT_NEAR(one.strength / all.strength, 1.0, 1e-9) << wall.layers << ", " << wall.seed;
    EXPECT_NEAR(one.failure_strain / all.failure_strain, 1.0, 1e-9);
  }
}

TEST(AvalancheEnd, IsThatOfTheSceneWhereTurnedWallsHaveWideIntervals) {
  Scene scene = test::small_scene(0.0, 30, 21);
  scene.joints.scatter = 1.6;
  EXPECT_NEAR(end_fraction_used(scene), 1.0 - 0.005 - 2.2 * 25.0 / 630 - 0.128 - 0.06, 1e-12);
  scene.assembly.orientation = 0.1;
  EXPECT_EQ(end_fraction_used(scene), 0.3);
  scene.joints.scatter = 1.0;
  EXPECT_NEAR(end_fraction_used(scene), 1.0 - 0.005 - 25.0 / 630 - 0.05, 1e-12);
  scene.loading.end_fraction = 0.95;
  EXPECT_EQ(end_fraction_used(scene), 0.95) << "the scene asks for more";
}

// Any one of these, and the walls that the rule was found with do not tell.
TEST(AvalancheEnd, IsThatOfTheSceneWhereItIsOtherThanTheRulesWalls) {
  using Change = void (*)(Scene&);
  const Scene wall = test::small_scene(0.0, 30, 21);
  const double of_the_rule = 1.0 - 0.005 - 25.0 / 630 - 0.002;  // d = 0.2
  EXPECT_NEAR(end_fraction_used(wall), of_the_rule, 1e-12);
  const std::vector<std::pair<const char*, Change>> changes{
      {"thresholds",
       [](Scene& s) {
         s.joints.thresholds.assign(1, {500.0, 500.0});
       }},
      {"head-tail shear", [](Scene& s) { s.joints.head_tail_shear = 50e6; }},
      {"flank tension", [](Scene& s) { s.joints.flank_tension = 10e6; }},
      {"layers' contrast", [](Scene& s) { s.material.layer_contrast = 0.99; }},
      {"Weibull", [](Scene& s) { s.joints.distribution = Distribution::weibull; }},
      {"log-normal", [](Scene& s) { s.joints.distribution = Distribution::lognormal; }},
      {"missing joints", [](Scene& s) { s.joints.missing = 0.01; }},
      {"nothing left out", [](Scene& s) { s.solver.leave_out = false; }}};
  for (const auto& [what, change] : changes) {
    Scene other = wall;
    change(other);
    EXPECT_EQ(end_fraction_used(other), 0.3) << what;
  }
  for (const auto& [r, part] : {std::pair{0.19, 0.3}, {0.21, of_the_rule}}) {
    Scene other = wall;
    other.joints.flank = flank_from_ratio(other.assembly, other.joints.head_tail, r);
    EXPECT_NEAR(end_fraction_used(other), part, 1e-12) << r;
  }
}

}  // namespace
}  // namespace havers::sim
