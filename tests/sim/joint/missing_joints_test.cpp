// Joints that pores have taken away (M13): who is missing, and what the wall does without them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "sim/joint/thresholds.hpp"
#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

constexpr std::uint64_t drawn_joints = 50000;

TEST(MissingJoints, AreTheFractionAskedFor) {
  for (const double fraction : {0.01, 0.1, 0.5}) {
    int missing = 0;
    for (std::uint64_t joint = 0; joint < drawn_joints; ++joint)
      missing += is_drawn_missing(11, joint, fraction) ? 1 : 0;
    EXPECT_NEAR(missing / double(drawn_joints), fraction,
                4.0 * std::sqrt(fraction * (1.0 - fraction) / drawn_joints));
  }
  for (std::uint64_t joint = 0; joint < 1000; ++joint) EXPECT_FALSE(is_drawn_missing(1, joint, 0));
}

TEST(MissingJoints, StayMissingAtALargerFraction) {
  for (std::uint64_t joint = 0; joint < 1000; ++joint)
    EXPECT_LE(is_drawn_missing(3, joint, 0.1), is_drawn_missing(3, joint, 0.3));
}

// Were both drawn from one number, the weakest joints would be the missing ones.
TEST(MissingJoints, AreDrawnApartFromTheThresholds) {
  double sum = 0.0, missing = 0.0;
  for (std::uint64_t joint = 0; joint < drawn_joints; ++joint) {
    if (!is_drawn_missing(5, joint, 0.2)) continue;
    sum += ThresholdFactors(5, 1.0, Distribution::uniform)(joint);
    missing += 1.0;
  }
  EXPECT_NEAR(sum / missing, 1.0, 4.0 / std::sqrt(12.0 * missing));
}

TEST(MissingJoints, AreTheSameWhateverElseChanges) {
  Scene scene = test::small_scene(45.0);
  scene.joints.missing = 0.2;
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  const auto before = draw_thresholds(scene, assembly);
  scene.joints.scatter = 1.2;
  scene.joints.distribution = Distribution::weibull;
  scene.joints.head_tail = 80e6;
  const auto after = draw_thresholds(scene, assembly);
  scene.joints.missing = 0.0;
  const auto whole = draw_thresholds(scene, assembly);
  int missing = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(is_missing(before[i]), is_missing(after[i]));
    missing += is_missing(after[i]) ? 1 : 0;
    EXPECT_EQ(after[i].normal, is_missing(after[i]) ? 0.0 : whole[i].normal);
  }
  EXPECT_GT(missing, 0);
}

class WithMissingJoints : public testing::TestWithParam<Regime> {
 protected:
  static Simulation run(double missing) { return simulate(scene_of(missing)); }
  static Scene scene_of(double missing) {
    Scene scene = test::small_scene();
    scene.solver.regime = GetParam();
    if (GetParam() == Regime::dynamic) scene.solver.step = 1e-7;
    scene.loading.strain_rate = 200.0;
    scene.joints.missing = missing;
    return scene;
  }
};
INSTANTIATE_TEST_SUITE_P(, WithMissingJoints,
                         testing::Values(Regime::quasi_static, Regime::dynamic),
                         [](const auto& regime) {
                           return regime.param == Regime::dynamic ? "Dynamic" : "QuasiStatic";
                         });

TEST_P(WithMissingJoints, TheWallIsSofterAndWeakerTheMoreAreMissing) {
  HAVERS_SLOW;
  Simulation stronger = run(0.0);
  for (const double missing : {0.05, 0.15, 0.3}) {
    const Simulation weaker = run(missing);
    ASSERT_TRUE(weaker.trusted());
    EXPECT_LT(weaker.modulus, stronger.modulus);
    EXPECT_LT(weaker.strength, stronger.strength);
    EXPECT_GT(weaker.strength, 0.0);
    stronger = weaker;
  }
}

TEST_P(WithMissingJoints, TheyAreBrokenFromTheStartButAreNoBreaks) {
  const Simulation simulation = run(0.15);
  int missing = 0, broken = 0;
  for (const JointOutcome& joint : simulation.joints) {
    broken += joint.broken ? 1 : 0;
    if (!is_missing(joint.threshold)) continue;
    ++missing;
    EXPECT_TRUE(joint.broken);
    EXPECT_EQ(joint.broken_at_strain, 0.0);
    EXPECT_LE(std::abs(joint.reaction_tangent),
              scene_of(0.15).joints.friction * std::max(0.0, joint.reaction_normal) + 1e-6);
  }
  EXPECT_GT(missing, 0);
  EXPECT_EQ(simulation.broken_joints, broken - missing);
  EXPECT_EQ(simulation.curve.front().broken_joints, 0);
  EXPECT_GT(simulation.first_break_strain, 0.0);
}

// Some that are pressed together slide, and none bears more than that.
TEST_P(WithMissingJoints, TheyRubByTheFrictionOfTheScene) {
  for (const double friction : {0.1, 0.6}) {
    Scene scene = scene_of(0.15);
    scene.assembly.layers = scene.assembly.fibres = 4;
    scene.loading.strain_rate = 1000.0;
    if (scene.solver.step) scene.solver.step = 2e-8;
    scene.joints.friction = friction;
    int sliding = 0;
    double largest = 0.0, most = 0.0;
    simulate(scene, [&](const Progress& progress) {
      const std::vector<JointOutcome> joints = progress.joints();
      for (const JointOutcome& joint : joints)
        largest = std::max(largest, std::abs(joint.reaction_normal));
      for (const JointOutcome& joint : joints) {
        // Of next to no pressure the solver's tolerance is a large part.
        if (!is_missing(joint.threshold) || joint.reaction_normal < 1e-3 * largest) continue;
        const double part = std::abs(joint.reaction_tangent) / joint.reaction_normal;
        most = std::max(most, part);
        sliding += std::abs(part - friction) < 1e-6 ? 1 : 0;
      }
    });
    EXPECT_GT(sliding, 0) << friction;
    EXPECT_LT(most, friction + 1e-6);
  }
}

TEST_P(WithMissingJoints, TheirThresholdsReadBackGiveTheSameCurve) {
  Scene scene = scene_of(0.15);
  const Simulation drawn = simulate(scene);
  scene.joints.thresholds =
      draw_thresholds(scene, build_assembly(scene.assembly, scene.loading.lateral));
  scene.joints.missing = 0.0;
  ASSERT_TRUE(scene.problems().empty());
  const Simulation given = simulate(scene);
  ASSERT_EQ(given.curve.size(), drawn.curve.size());
  EXPECT_GT(given.curve.size(), 3U);
  for (std::size_t i = 0; i < given.curve.size(); ++i) {
    EXPECT_EQ(given.curve[i].strain, drawn.curve[i].strain) << i;
    EXPECT_EQ(given.curve[i].stress_right, drawn.curve[i].stress_right) << i;
    EXPECT_EQ(given.curve[i].stress_left, drawn.curve[i].stress_left) << i;
    EXPECT_EQ(given.curve[i].broken_joints, drawn.curve[i].broken_joints) << i;
  }
}

// Slow loading and none: one modulus, and nearly one strength.
TEST(MissingJoints, WeakenTheWallAlikeInBothRegimes) {
  Scene scene = test::small_scene();
  scene.joints.missing = 0.15;
  const Simulation limit = simulate(scene);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = 1e-7;
  scene.loading.strain_rate = 100.0;
  const Simulation slow = simulate(scene);
  EXPECT_NEAR(slow.modulus, limit.modulus, 0.01 * limit.modulus);
  EXPECT_NEAR(slow.strength, limit.strength, 0.03 * limit.strength);
}

// Rounding is no strength, and its energy no reason not to trust the run.
TEST(MissingJoints, MaySeverTheSpecimenWithoutDoubt) {
  for (const Lateral lateral : {Lateral::periodic, Lateral::free}) {
    Scene scene = test::small_scene(90.0);
    scene.loading.lateral = lateral;
    const Assembly assembly = build_assembly(scene.assembly, lateral);
    const double cut = 25.0 * scene.assembly.fibre_height;  // between two rows of fibres
    for (const Joint& joint : assembly.joints) {
      const bool missing = std::abs(joint.position.x() - cut) < 0.1 * scene.assembly.fibre_height;
      scene.joints.thresholds.push_back(missing ? Threshold{} : Threshold{500.0, 500.0});
    }
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.strength, 0.0);
    EXPECT_TRUE(simulation.trusted()) << simulation.why_not_trusted();
  }
}

// In time the loose fibres would swing to the largest strain.
TEST(MissingJoints, LeaveNothingToSimulateInTimeWhereTheyAreAll) {
  Scene scene = test::dynamic_scene();
  const std::size_t joints = build_assembly(scene.assembly, scene.loading.lateral).joints.size();
  scene.joints.thresholds.assign(joints, Threshold{});
  const Simulation simulation = simulate(scene);
  EXPECT_EQ(simulation.regime, Regime::quasi_static);
  EXPECT_EQ(simulation.strength, 0.0);
  EXPECT_EQ(simulation.status, SimulationStatus::severed);
  EXPECT_TRUE(simulation.trusted()) << simulation.why_not_trusted();
  EXPECT_THAT(simulation.regime_ground, testing::HasSubstr("missing joints leave nothing"));
  scene.joints.thresholds.front() = {500.0, 500.0};  // of two pieces
  EXPECT_EQ(simulate(scene).status, SimulationStatus::severed);
}

// A chain: without any one of its joints it is two pieces.
TEST(MissingJoints, SeverAChain) {
  for (const Regime regime : {Regime::quasi_static, Regime::dynamic}) {
    Scene scene = test::dynamic_scene();
    scene.assembly.layers = 1;
    scene.solver.regime = regime;
    scene.joints.thresholds.assign(4, {500.0, 500.0});
    EXPECT_EQ(simulate(scene).status, SimulationStatus::broken);
    scene.joints.thresholds[2] = {};
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.status, SimulationStatus::severed);
    EXPECT_EQ(simulation.strength, 0.0);
    EXPECT_EQ(simulation.curve.back().stress_right, 0.0);
  }
}

// Of two layers of two fibres there are left the lower left fibre, the upper middle one, hung on it
// at the middle of its lower side, and the upper right half, which ends that one half a height
// further up: what is pulled turns the middle one and meets no resistance.
// Where the material hardly changes its volume, rounding of that is large.
TEST(MissingJoints, MayLeaveHingesThatBearNothing) {
  for (const auto& [regime, plane, poisson] :
       {std::tuple{Regime::quasi_static, Plane::stress, 0.33},
        {Regime::dynamic, Plane::stress, 0.33},
        {Regime::quasi_static, Plane::strain, 0.4999}}) {
    Scene scene = test::dynamic_scene();
    scene.assembly.layers = scene.assembly.fibres = 2;
    scene.loading.lateral = Lateral::free;
    scene.solver.regime = regime;
    scene.material.plane = plane;
    scene.material.poisson = poisson;
    const AssemblyOptions& wall = scene.assembly;
    for (const Joint& joint : build_assembly(wall, scene.loading.lateral).joints) {
      const Eigen::Vector2d at(joint.position.x() / wall.fibre_length,
                               joint.position.y() / wall.fibre_height);
      const bool hinge = (at - Eigen::Vector2d(0.75, 1.0)).norm() < 1e-9 ||
                         (at - Eigen::Vector2d(1.5, 1.5)).norm() < 1e-9;
      scene.joints.thresholds.push_back(hinge ? Threshold{500.0, 500.0} : Threshold{});
    }
    ASSERT_EQ(std::ranges::count_if(scene.joints.thresholds,
                                    [](const Threshold& t) { return !is_missing(t); }),
              2);
    const Simulation simulation = simulate(scene);
    EXPECT_EQ(simulation.status, SimulationStatus::severed);
    EXPECT_EQ(simulation.strength, 0.0);
    EXPECT_TRUE(simulation.trusted()) << simulation.why_not_trusted();
  }
}

// Digits are lost where nothing is left to bear and the material hardly changes its volume: what is
// left of the force is rounding of either sign. A chain either hangs together or does not.
TEST(MissingJoints, LeaveNothingOfAChainThatHardlyChangesItsVolume) {
  int severed = 0, whole = 0;
  for (const double length : {20e-6, 50e-6, 100e-6, 150e-6})
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
      Scene scene = test::small_scene(0.0, 1, 3);
      scene.assembly.fibre_length = length;
      scene.material.plane = Plane::strain;
      scene.material.poisson = 0.4999;
      scene.joints.missing = 0.4;
      scene.joints.seed = seed;
      scene.loading.lateral = Lateral::free;
      const Simulation run = simulate(scene);
      SCOPED_TRACE(testing::Message() << length << ", seed " << seed);
      EXPECT_EQ(run.why_not_trusted(), "");
      double weakest = INFINITY;
      for (const JointOutcome& joint : run.joints)
        weakest = std::min(weakest, joint.threshold.normal);
      const double strength = weakest / scene.assembly.fibre_height;
      if (weakest == 0.0) {
        EXPECT_EQ(run.status, SimulationStatus::severed);
        EXPECT_EQ(run.strength, 0.0);
        EXPECT_EQ(run.modulus, 0.0);
        ++severed;
      } else {
        EXPECT_EQ(run.status, SimulationStatus::broken);
        EXPECT_NEAR(run.strength, strength, 1e-9 * strength);
        ++whole;
      }
      for (const CurvePoint& row : run.curve) EXPECT_GE(row.elastic, 0.0);
    }
  EXPECT_GT(severed, 0);
  EXPECT_GT(whole, 0);
}

}  // namespace
}  // namespace havers::sim
