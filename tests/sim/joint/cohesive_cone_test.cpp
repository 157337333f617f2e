#include "sim/joint/cohesive_cone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// Moreau's decomposition characterises the projection on a cone with its tip at (−c, 0):
// p in the cone, r − p in the polar cone, and r − p orthogonal to p − tip.
TEST(CohesiveCone, ProjectsToTheNearestPoint) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const double mu : {0.0, 0.3, 1.0, 5.0})
    for (const double cohesion : {0.0, 0.7}) {
      const JointLaw law{cohesion, mu};
      for (int i = 0; i < 1000; ++i) {
        const Local r(2.0 * normal(random), 2.0 * normal(random));
        const Local p = project_on_cone(r, law), q = r - p;
        const Local from_tip(p.x() + cohesion, p.y());
        EXPECT_GE(cone_margin(p, law), -1e-14);
        EXPECT_LE(mu * std::abs(q.y()), -q.x() + 1e-14);
        EXPECT_NEAR(from_tip.dot(q), 0.0, 1e-14);
      }
    }
}

TEST(CohesiveCone, HasItsTipAtTheTensionThreshold) {
  const JointLaw law = intact_law({.normal = 5.0, .tangent = 2.0});
  EXPECT_DOUBLE_EQ(cone_margin({-5.0, 0.0}, law), 0.0);
  EXPECT_DOUBLE_EQ(cone_margin({0.0, 2.0}, law), 0.0);
  EXPECT_DOUBLE_EQ(cone_margin({0.0, -2.0}, law), 0.0);
  EXPECT_GT(cone_margin({0.0, 1.9}, law), 0.0);
  EXPECT_LT(cone_margin({-5.1, 0.0}, law), 0.0);
}

TEST(CohesiveCone, IsCoulombsWhenBroken) {
  const JointLaw law = broken_law(0.3);
  EXPECT_DOUBLE_EQ(cone_margin({10.0, 3.0}, law), 0.0);
  EXPECT_LT(cone_margin({-1e-9, 0.0}, law), 0.0);
}

// A cone without width leaves to rounding which way its joint slides, and a run says what it did.
TEST(CohesiveCone, IsNoNarrowerThanTheLeastFriction) {
  EXPECT_EQ(intact_law({.normal = 1000.0, .tangent = 0.1}).friction, least_friction);
  const auto is_said = [](const Scene& scene) {
    return std::ranges::any_of(simulate(scene).left_out, [](const LeftOut& part) {
      return part.what == "shear thresholds below 0.001 of those in tension";
    });
  };
  for (Scene scene : {test::small_scene(0.0, 2, 2), test::dynamic_scene()}) {
    EXPECT_FALSE(is_said(scene));
    scene.loading.max_strain = 1e-3;
    scene.joints.flank = flank_from_ratio(scene.assembly, scene.joints.head_tail, 1000.0);
    scene.joints.reinforced_boundary = false;
    EXPECT_FALSE(is_said(scene)) << "it is just as wide";
    scene.joints.flank *= 0.99;
    EXPECT_TRUE(is_said(scene));
    const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
    scene.joints.thresholds.assign(assembly.joints.size(), {.normal = 1000.0, .tangent = 1000.0});
    EXPECT_FALSE(is_said(scene));
    scene.joints.thresholds.back() = {.normal = 0.0, .tangent = 0.0};
    EXPECT_FALSE(is_said(scene)) << "it is missing";
    scene.joints.thresholds.back() = {.normal = 1000.0, .tangent = 0.5};
    EXPECT_TRUE(is_said(scene));
  }
}

TEST(CohesiveCone, IsMetAtTheStrainWhereNoMarginIsLeft) {
  const JointLaw law = intact_law({.normal = 5.0, .tangent = 2.0});
  constexpr double modulus = 4.0;
  for (const Local& r : {Local(-1.0, 0.3), Local(-1.0, 0.0), Local(0.5, -2.0)}) {
    const Local reaction = strain_at_cone(r, law, modulus, 0.0) * modulus * r;
    EXPECT_NEAR(cone_margin(reaction, law), 0.0, 1e-14);
  }
  EXPECT_TRUE(std::isinf(strain_at_cone({1.0, 0.3}, law, modulus, 0.0)));  // held by friction
  EXPECT_TRUE(std::isinf(strain_at_cone({-1e-9, 0.0}, law, modulus, 1e-8)));
}

// (M11) is zero where the law holds ...
TEST(LawResidual, VanishesWhereTheLawHolds) {
  const JointLaw law = intact_law({.normal = 5.0, .tangent = 2.0});
  for (const double stiffness : {0.1, 10.0}) {
    const auto residual = [&](const Local& r, const Local& u) {
      return law_residual(r, u, law, stiffness).norm();
    };
    EXPECT_LT(residual({1.0, 0.5}, {0.0, 0.0}), 1e-14);   // sticks
    EXPECT_LT(residual({0.0, -2.0}, {0.0, 0.3}), 1e-14);  // slides forward
    EXPECT_LT(residual({5.0, 4.0}, {0.0, -0.3}), 1e-14);  // slides backward
    EXPECT_LT(residual({-5.0, 0.0}, {0.2, 0.1}), 1e-14);  // opens
  }
}

// ... and the force that is wrong where it does not.
TEST(LawResidual, MeasuresWhatIsWrong) {
  const JointLaw law = broken_law(0.5);
  EXPECT_NEAR(law_residual({-1.0, 0.0}, {0.0, 0.0}, law, 1.0).norm(), 1.0, 1e-14);  // pulls
  EXPECT_NEAR(law_residual({0.0, 0.0}, {-0.1, 0.0}, law, 3.0).norm(), 0.3, 1e-14);  // penetrates
  EXPECT_GT(law_residual({1.0, 0.5}, {0.0, 0.3}, law, 1.0).norm(), 0.1);   // pushed by friction
  EXPECT_GT(law_residual({1.0, 0.1}, {0.0, -0.3}, law, 1.0).norm(), 0.1);  // slides inside the cone
}

}  // namespace
}  // namespace havers::sim
