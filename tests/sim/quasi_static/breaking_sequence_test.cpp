#include "sim/quasi_static/breaking_sequence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/joint/cohesive_cone.hpp"
#include "sim/joint/thresholds.hpp"
#include "sim/quasi_static/intact_structure.hpp"
#include "sim/structure/disjoint_sets.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// Gaps of joints that hardly bear leave digits: the strength is looked at once more.
TEST(BreakingSequence, HasAStrengthOfAllDigits) {
  Scene scene = test::small_scene(0.0, 2, 8);
  scene.loading.lateral = Lateral::periodic;
  scene.loading.max_strain = 1.0;
  scene.material.layer_contrast = 0.5;
  scene.joints.head_tail = 50e6;
  scene.joints.flank = 0.5e6;
  scene.joints.scatter = 0.0;
  scene.joints.missing = 0.05;
  scene.joints.friction = 1.0;
  scene.joints.seed = 9888;
  const Simulation run = simulate(scene);
  scene.solver.leave_out = false;
  const Simulation in_full = simulate(scene);
  EXPECT_LE(run.rounding_error, 1e-9);
  EXPECT_NEAR(run.strength / in_full.strength, 1.0, 1e-9);
  EXPECT_NEAR(run.failure_strain / in_full.failure_strain, 1.0, 1e-9);
}

// One row of fibres is a chain: it is as strong as its weakest head-tail joint, and breaks there.
TEST(BreakingSequence, BreaksARowAtItsWeakestJoint) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    Scene scene = test::small_scene(0.0, 1, 6);
    scene.joints.scatter = 0.8;
    scene.joints.seed = seed;
    scene.joints.reinforced_boundary = false;
    const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
    const auto thresholds = draw_thresholds(scene, assembly);
    const auto weakest =
        std::min_element(thresholds.begin(), thresholds.end(),
                         [](const auto& a, const auto& b) { return a.normal < b.normal; });
    const Simulation simulation = simulate_quasi_static(scene, {});
    ASSERT_EQ(simulation.status, SimulationStatus::broken);
    EXPECT_EQ(simulation.steps, 1);
    EXPECT_NEAR(simulation.strength / (weakest->normal / 10e-6), 1.0, 1e-9);
    for (std::size_t j = 0; j < thresholds.size(); ++j)
      EXPECT_EQ(simulation.joints[j].broken, &thresholds[j] == &*weakest);
    const auto at = static_cast<std::size_t>(weakest - thresholds.begin());
    EXPECT_NEAR(simulation.joints[at].broken_at_strain,
                weakest->normal / (10e-6 * scene.material.young), 1e-12);
    EXPECT_NEAR(simulation.joints[at].gap,
                simulation.joints[at].broken_at_strain * scene.assembly.width(), 1e-15);
  }
}

// Without scatter all joints of that chain meet their cones together.
TEST(BreakingSequence, BreaksEqualJointsTogether) {
  Scene scene = test::small_scene(0.0, 1, 6);
  scene.joints.scatter = 0.0;
  const Simulation simulation = simulate_quasi_static(scene, {});
  EXPECT_EQ(simulation.steps, 1);
  EXPECT_EQ(simulation.curve.back().broken_joints, 5);
}

// Before the first break the stress is uniform, E ε along x, so each joint's forces are known.
TEST(BreakingSequence, FindsTheFirstBreakOfEveryOrientation) {
  for (const double degrees : test::orientations) {
    Scene scene = test::small_scene(degrees);
    scene.joints.seed = 3;
    scene.solver.leave_out = false;  // the limit would take that stress for what it has solved for
    const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
    const auto thresholds = draw_thresholds(scene, assembly);
    double first = INFINITY;
    std::size_t weakest = 0;
    for (std::size_t j = 0; j < thresholds.size(); ++j) {  // the uniform stress E ε alone
      const Joint& joint = assembly.joints[j];
      const double pull = scene.material.young * joint.normal.x() * joint.length;
      const double tension = pull * joint.normal.x(), shear = std::abs(pull * joint.tangent().x());
      const double ratio = thresholds[j].tangent / thresholds[j].normal;
      const double strain = thresholds[j].tangent / (shear + ratio * tension);
      if (strain < first) {
        first = strain;
        weakest = j;
      }
    }
    const Simulation simulation = simulate(scene);
    EXPECT_TRUE(simulation.joints[weakest].broken) << degrees;
    EXPECT_EQ(simulation.joints[weakest].broken_at_strain, simulation.first_break_strain);
    EXPECT_NEAR(simulation.joints[weakest].broken_at_strain / first, 1.0, 1e-8) << degrees;
  }
}

// Rows of the curve come in pairs at one strain: the stress drops, and what is set free is kept.
// Between pairs joints rub. The area under the curve is what is stored and what is lost.
TEST(BreakingSequence, AccountsForTheEnergyOfEachBreak) {
  Scene scene = test::small_scene(2.0, 4, 3);
  scene.joints.scatter = 1.0;
  scene.joints.seed = 8;
  const auto intact = intact_structure(scene);
  double largest = 0.0;
  int watched = 0;
  const Simulation simulation = simulate_quasi_static(scene, [&](const Progress& now) {
    const double stored = scene.material.young * intact->energy(now.displacements());
    largest = std::max(largest, stored);
    EXPECT_NEAR(now.point.elastic, stored, 1e-10 * largest) << "event " << ++watched;
  });
  ASSERT_GT(simulation.steps, 5);
  EXPECT_NEAR(simulation.curve.back().elastic,
              scene.material.young * intact->energy(simulation.displacements), 1e-10 * largest);
  double work = 0.0, friction = 0.0;
  for (std::size_t i = 1; i + 1 < simulation.curve.size(); i += 2) {
    const CurvePoint &from = simulation.curve[i - 1], &before = simulation.curve[i],
                     &after = simulation.curve[i + 1];
    EXPECT_EQ(before.strain, after.strain);
    EXPECT_GT(after.broken_joints, before.broken_joints);
    EXPECT_LE(after.stress_right, before.stress_right * (1.0 + 1e-12));
    EXPECT_DOUBLE_EQ(before.time, before.strain / 1000.0);
    work += 0.5 * (from.stress_right + before.stress_right) * (before.strain - from.strain) *
            scene.assembly.width() * scene.assembly.height();
    EXPECT_NEAR(before.elastic + before.dissipated, work, 1e-9 * work);
    EXPECT_NEAR(after.elastic + after.dissipated, work, 1e-9 * work);
    friction += before.dissipated - from.dissipated;
    EXPECT_GE(before.dissipated, from.dissipated - 1e-12 * work);
  }
  EXPECT_GT(friction, 1e-3 * work);
}

// Friction far beyond 1 wedges pieces against each other. After the strength it would not matter.
TEST(BreakingSequence, IsNotTrustedWhereABreakAddsEnergyToTheStrength) {
  Scene scene = test::small_scene(2.0, 4, 3);
  scene.joints.scatter = 1.0;
  scene.joints.seed = 146;
  EXPECT_TRUE(simulate(scene).trusted());
  scene.joints.friction = 3.0;
  const Simulation wedged = simulate(scene);
  const auto strongest = std::max_element(
      wedged.curve.begin(), wedged.curve.end(),
      [](const CurvePoint& a, const CurvePoint& b) { return a.stress_right < b.stress_right; });
  double gain = 0.0;
  for (auto row = wedged.curve.begin() + 1; row <= strongest; ++row)
    if (row->strain == (row - 1)->strain) gain = std::max(gain, row->elastic - (row - 1)->elastic);
  EXPECT_NEAR(wedged.energy_gain, gain / strongest->elastic, 1e-12);
  EXPECT_GT(gain, 0.01 * strongest->elastic);
  EXPECT_LE(wedged.energy_defect, 1e-10);
  EXPECT_THAT(wedged.why_not_trusted(), testing::HasSubstr("energy stored"));
}

// Joints between bodies that bonded joints connect to an end: contact of all others is left out.
std::vector<std::size_t> carried_joints(const Assembly& assembly,
                                        const std::vector<JointOutcome>& joints) {
  DisjointSets pieces(assembly.bodies.size() + 1);
  for (const std::vector<int>& side : {assembly.left, assembly.right})
    for (const int node : side)
      for (std::size_t b = 0; b < assembly.bodies.size(); ++b)
        if (node >= assembly.bodies[b].first_node &&
            node < assembly.bodies[b].first_node + assembly.bodies[b].nodes)
          pieces.unite(assembly.bodies.size(), b);
  const auto body = [](int index) { return static_cast<std::size_t>(index); };
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (!joints[j].broken)
      pieces.unite(body(assembly.joints[j].body_a), body(assembly.joints[j].body_b));
  std::vector<std::size_t> carried;
  const std::size_t end = pieces.find(assembly.bodies.size());
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (pieces.find(body(assembly.joints[j].body_a)) == end &&
        pieces.find(body(assembly.joints[j].body_b)) == end)
      carried.push_back(j);
  return carried;
}

// Slender walls of which long pieces come to hang on next to nothing: where they lie is not told by
// the equations of their states alone.
TEST(BreakingSequence, KeepsTheLawAtEveryBreakWherePiecesHangLoosely) {
  struct Wall {
    int layers, fibres;
    double slenderness, degrees, scatter, friction, missing, flank;
    std::uint64_t seed;
  };
  for (const Wall& wall : {Wall{7, 8, 39.30092930442931, 0.0, 0.91095617098482984,
                                0.46398291802137409, 0.15243906996838524, 3469146.0716635743, 134},
                           Wall{6, 4, 28.547383393029921, 1.0552121484057735, 0.99654623252146668,
                                0.6528136463388482, 0.0, 603423.32665611815, 26}}) {
    SCOPED_TRACE(wall.seed);
    Scene scene = test::small_scene(wall.degrees, wall.layers, wall.fibres);
    scene.assembly.fibre_length = wall.slenderness * scene.assembly.fibre_height;
    scene.joints.scatter = wall.scatter;
    scene.joints.friction = wall.friction;
    scene.joints.missing = wall.missing;
    scene.joints.flank = wall.flank;
    scene.joints.seed = wall.seed;
    scene.loading.lateral = Lateral::free;
    scene.solver.regime = Regime::quasi_static;
    const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
    double largest = 0.0;
    int seen = 0;
    const Simulation watched = simulate(scene, [&](const Progress& progress) {
      ++seen;
      const std::vector<JointOutcome> joints = progress.joints();
      for (const JointOutcome& joint : joints)
        largest = std::max({largest, joint.reaction_normal, std::abs(joint.reaction_tangent)});
      const double noise = 1e-7 * largest;
      for (const std::size_t j : carried_joints(assembly, joints)) {
        const JointOutcome& joint = joints[j];
        if (!joint.broken) continue;
        const double push = joint.reaction_normal, opening = scene.material.young * joint.gap;
        EXPECT_GE(push, -noise) << j;
        EXPECT_GE(opening, -noise) << j;
        EXPECT_LE(std::min(push, opening), noise) << j;
        EXPECT_LE(std::abs(joint.reaction_tangent), wall.friction * push + noise) << j;
      }
    });
    EXPECT_GE(seen, watched.steps);
    EXPECT_GT(watched.steps, 10);
    EXPECT_LE(watched.worst_residual, scene.solver.tolerance);
  }
}

// All joints of a kind break together, and leave pieces that hang on nothing: by up to eight times
// the height of a fibre their joints would overlap.
TEST(BreakingSequence, LaysNoPieceThatHangsOnNothingIntoAnother) {
  Scene scene = test::small_scene(0.0, 5, 3);
  scene.loading.lateral = Lateral::free;
  scene.joints.scatter = 0.0;
  const Simulation run = simulate(scene);
  EXPECT_GT(run.broken_joints, 20);
  for (const JointOutcome& joint : run.joints)
    EXPECT_GE(joint.gap, -1e-9 * scene.assembly.fibre_height);
}

// Friction acts on what is pressed together, and there is no jump where it vanishes: what it
// changes in the curve, up to and after the peak, is proportional to it.
TEST(BreakingSequence, HasALimitWithoutFriction) {
  struct Wall {
    double degrees, scatter, end;
    unsigned seed;
  };
  for (const Wall& wall :
       {Wall{0.0, 0.2, 0.7, 1}, Wall{30.0, 0.2, 0.7, 3}, Wall{45.0, 1.5, 0.0, 1}}) {
    Scene scene = test::small_scene(wall.degrees, 8, 5);
    scene.joints.scatter = wall.scatter;
    scene.joints.seed = wall.seed;
    scene.loading.end_fraction = wall.end;
    scene.joints.friction = least_friction;
    const Simulation none = simulate_quasi_static(scene, {});
    const auto change = [&](double friction) {
      scene.joints.friction = friction;
      const Simulation some = simulate_quasi_static(scene, {});
      EXPECT_EQ(some.curve.size(), none.curve.size());
      double largest = 0.0;
      for (std::size_t i = 0; i < std::min(none.curve.size(), some.curve.size()); ++i)
        largest =
            std::max(largest, std::abs(some.curve[i].stress_right - none.curve[i].stress_right));
      return largest / none.strength;
    };
    const double little = change(0.01), more = change(0.1);
    EXPECT_GT(little, 1e-6) << wall.degrees;
    EXPECT_NEAR(more / little, (0.1 - least_friction) / (0.01 - least_friction), 1.0);
  }
}

}  // namespace
}  // namespace havers::sim
