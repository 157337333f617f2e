#include "sim/scene.hpp"

#include <gmock/gmock.h>

#include "sim/joint/thresholds.hpp"
#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

// (M9) by hand: N = 30, L/l = 10, σ₁ = 50 MPa, σ₂ = 10 MPa.
TEST(Resultant, AddsFlanksToHeadTailJoints) {
  EXPECT_NEAR(resultant({}, {}), 50e6 + 0.5 * (31.0 / 30.0) * 10.0 * 10e6, 1.0);
  EXPECT_NEAR(ratio({}, {}), 500.0 / 500.0, 1e-14);
}

// The balance that (M9) stands for: N f₁ + (N + 1) f₂ = N l Σ_res.
TEST(Resultant, IsTheForceOfAllLayersOverTheHeight) {
  const AssemblyOptions assembly{.layers = 7, .fibre_length = 80e-6, .fibre_height = 16e-6};
  JointOptions joints;
  joints.head_tail = 31e6;
  joints.flank = 4e6;
  const double f1 = 31e6 * 16e-6, f2 = 4e6 * 40e-6;
  EXPECT_NEAR(resultant(assembly, joints), (7.0 * f1 + 8.0 * f2) / (7.0 * 16e-6), 1e-3);
  EXPECT_NEAR(ratio(assembly, joints), f1 / f2, 1e-14);
}

TEST(Resultant, AndRatioGiveTheStressesBack) {
  const AssemblyOptions assembly{.layers = 12, .fibre_length = 90e-6, .fibre_height = 7e-6};
  for (const double r : {0.3, 1.0, 3.0}) {
    JointOptions joints;
    joints.head_tail = head_tail_from_resultant(assembly, 100e6, r);
    joints.flank = flank_from_ratio(assembly, joints.head_tail, r);
    EXPECT_NEAR(resultant(assembly, joints), 100e6, 1e-6);
    EXPECT_NEAR(ratio(assembly, joints), r, 1e-13);
  }
}

TEST(ReinforcedBoundary, IsOnAt0DegreesOnlyUnlessTheSceneSaysSo) {
  Scene scene = test::small_scene(0.0);
  EXPECT_TRUE(reinforced_boundary(scene));
  EXPECT_FALSE(reinforced_boundary(test::small_scene(45.0)));
  scene.joints.reinforced_boundary = false;
  EXPECT_FALSE(reinforced_boundary(scene));
}

TEST(Scene, IsSoundByDefault) {
  EXPECT_TRUE(Scene{}.problems().empty());
}

TEST(Scene, RefusesAStepThatLeadsNowhere) {
  Scene scene;
  scene.loading.strain_rate = 1e-3;
  scene.solver.step = 2e-8;
  ASSERT_EQ(scene.problems().size(), 1U);
  EXPECT_EQ(scene.problems().front().what, "is 2e-08: a strain of 0.0038 is 1.9e+08 steps away");
  scene.solver.regime = Regime::quasi_static;  // without steps
  EXPECT_TRUE(scene.problems().empty());
  scene.solver.regime = Regime::dynamic;
  scene.loading.strain_rate = 1e3;
  EXPECT_TRUE(scene.problems().empty());
}

// To the strain where the test ends, when that comes before the specimen fails: a thousand steps,
// of 38 millions to σ₁/E.
TEST(Scene, CountsStepsToTheStrainThatComesFirst) {
  Scene scene = test::dynamic_scene(0.0, 1e-12);
  scene.loading.strain_rate = 100.0;
  scene.loading.max_strain = 1e-7;
  EXPECT_TRUE(scene.problems().empty());
  scene.loading.max_strain = 0.05;
  ASSERT_EQ(scene.problems().size(), 1U);
  EXPECT_EQ(scene.problems().front().what, "is 1e-12: a strain of 0.0038 is 3.8e+07 steps away");
}

TEST(Scene, RefusesAStepLongerThanTheTest) {
  Scene scene;
  scene.loading.strain_rate = 1e3;
  scene.loading.max_strain = 0.05;
  scene.solver.step = 4.9e-5;
  EXPECT_TRUE(scene.problems().empty());
  scene.solver.step = 1e-3;
  ASSERT_EQ(scene.problems().size(), 1U);
  EXPECT_EQ(scene.problems().front().key, "solver.step_s");
  EXPECT_EQ(scene.problems().front().what,
            "is 0.001: one step is a strain of 1, and the test ends at 0.05");
  scene.solver.regime = Regime::quasi_static;
  EXPECT_TRUE(scene.problems().empty()) << "which takes no steps";
}

TEST(Scene, ChoosesNoStepLongerThanTheTest) {
  HAVERS_SLOW;
  Scene scene;
  scene.loading.start = Start::rest;
  scene.loading.strain_rate = 1e3;
  scene.loading.max_strain = 1e-7;
  EXPECT_TRUE(scene.problems().empty());
  scene.solver.regime = Regime::dynamic;
  const double end = simulate(scene).curve.back().strain;
  EXPECT_GE(end, 1e-7 * (1.0 - 1e-9));
  EXPECT_LT(end, 1.02e-7) << "in the step that reaches it";
}

// Nothing is leapt over from rest, and the curve of all those steps would fill the memory.
TEST(Scene, RefusesARateThatLeadsNowhereFromRest) {
  Scene scene;
  scene.loading.strain_rate = 1e-3;
  scene.loading.start = Start::rest;
  ASSERT_EQ(scene.problems().size(), 1U);
  EXPECT_EQ(scene.problems().front().key, "loading.strain_rate_per_s");
  scene.solver.regime = Regime::quasi_static;
  EXPECT_TRUE(scene.problems().empty());
  scene.solver.regime = Regime::automatic;
  scene.loading.strain_rate = 1e2;
  EXPECT_TRUE(scene.problems().empty());
  scene.loading.strain_rate = 1e-3;
  scene.loading.start = Start::uniform;
  scene.solver.regime = Regime::dynamic;
  EXPECT_TRUE(scene.problems().empty());
  scene.solver.leave_out = false;
  ASSERT_EQ(scene.problems().size(), 1U);
  EXPECT_THAT(scene.problems().front().hint, testing::HasSubstr("leave_out = true"));
}

// How far failure is, given thresholds say, not the strength that they replace.
TEST(Scene, CountsStepsToTheGivenThresholds) {
  Scene scene = test::dynamic_scene(0.0, 1e-11);
  scene.loading.strain_rate = 10.0;
  ASSERT_EQ(scene.problems().size(), 1U);
  scene.joints.thresholds =
      draw_thresholds(scene, build_assembly(scene.assembly, scene.loading.lateral));
  EXPECT_EQ(scene.problems().size(), 1U);
  for (Threshold& threshold : scene.joints.thresholds) threshold.normal *= 1e-3;
  EXPECT_TRUE(scene.problems().empty());
}

TEST(Scene, DoubtsValuesThatAreInOtherUnits) {
  Scene scene;
  EXPECT_TRUE(scene.doubts().empty());
  scene.joints.head_tail = 50e12;  // 50e6 where MPa are asked for
  EXPECT_THAT(scene.doubts(),
              testing::ElementsAre(testing::StartsWith(
                  "joints.head_tail_MPa is 5e+07, 3.8e+03 times material.young_GPa")));
  scene.joints.head_tail = 50e3;  // 0.05, as of GPa
  EXPECT_THAT(scene.doubts(),
              testing::ElementsAre(testing::StartsWith(
                  "joints.head_tail_MPa is 0.05, 3.8e-06 times material.young_GPa: bone bears")));
  scene = {};
  scene.material.young = 13e12;  // MPa where GPa are asked for
  EXPECT_THAT(scene.doubts(),
              testing::ElementsAre(testing::StartsWith("material.young_GPa is 1.3e+04, stiffer")));
}

TEST(Scene, DoubtsAViscosityThatBreaksItAtOnce) {
  Scene scene;
  scene.loading.strain_rate = 1e3;
  scene.material.viscosity = 1e-7;  // E tau times the rate is a fortieth of the threshold
  EXPECT_TRUE(scene.doubts().empty());
  scene.material.viscosity = 1.0;
  EXPECT_THAT(scene.doubts(),
              testing::ElementsAre(testing::StartsWith(
                  "material.viscosity_s is 1: at 1000 /s it stresses the fibres by 1.3e+07 MPa")));
}

TEST(Scene, DoubtsWhatTheLimitDoesNotKnow) {
  Scene scene;
  scene.material.viscosity = 1.0;
  scene.loading.strain_rate = 1e-9;
  scene.loading.start = Start::rest;
  scene.solver.step = 1e-8;
  scene.solver.contact = ContactMethod::gauss_seidel;
  EXPECT_TRUE(scene.doubts().empty());
  scene.solver.regime = Regime::quasi_static;
  EXPECT_THAT(scene.doubts(),
              testing::ElementsAre(testing::StartsWith("material.viscosity_s changes nothing"),
                                   testing::StartsWith("loading.start changes nothing"),
                                   testing::StartsWith("solver.step_s changes nothing"),
                                   testing::StartsWith("solver.contact changes nothing")));
  Scene plain;
  plain.solver.regime = Regime::quasi_static;
  EXPECT_TRUE(plain.doubts().empty());
}

}  // namespace
}  // namespace havers::sim
