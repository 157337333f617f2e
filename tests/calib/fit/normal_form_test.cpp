#include "calib/fit/normal_form.hpp"

#include <gtest/gtest.h>

#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

sim::Scene some_scene() {
  sim::Scene scene;
  scene.assembly.orientation = 0.785;
  scene.loading.strain_rate = 1e-4;
  scene.joints.head_tail_shear = 12e6;
  apply(scene, "young_GPa", 17.3);
  apply(scene, "head_tail_MPa", 41.7);
  apply(scene, "ratio", 1.7);
  return scene;
}

Response in_normal_form(const sim::Scene& scene) {
  const auto form = normal_form(scene, true);
  return rescaled(test::ClosedForm{}(form.scene), form);
}

TEST(NormalForm, GivesTheResponseOfTheSceneAskedFor) {
  const auto scene = some_scene();
  const auto plain = test::ClosedForm{}(scene), scaled = in_normal_form(scene);
  EXPECT_NEAR(scaled.modulus, plain.modulus, 1e-10 * plain.modulus);
  EXPECT_NEAR(scaled.strength, plain.strength, 1e-10 * plain.strength);
  EXPECT_NEAR(scaled.failure_strain, plain.failure_strain, 1e-10 * plain.failure_strain);
  ASSERT_EQ(scaled.stress.size(), plain.stress.size());
  EXPECT_NEAR(scaled.stress[1], plain.stress[1], 1e-10 * plain.strength);
  EXPECT_TRUE(scaled.broke);
}

TEST(NormalForm, IsTheSameForEveryModulusAndHeadTailStress) {
  const auto key = key_of(normal_form(some_scene(), true).scene);
  auto scene = some_scene();
  for (const double factor : {0.37, 1.9, 3.3}) {
    apply(scene, "young_GPa", 17.3 * factor);
    apply(scene, "head_tail_MPa", 41.7 / factor);
    EXPECT_EQ(key_of(normal_form(scene, true).scene), key);
  }
}

TEST(NormalForm, HasNoSeedWhereNothingIsDrawn) {
  const auto seed_of = [](double scatter, double missing) {
    auto scene = some_scene();
    scene.joints.scatter = scatter;
    scene.joints.missing = missing;
    scene.joints.seed = 7;
    return normal_form(scene, true).scene.joints.seed;
  };
  EXPECT_EQ(seed_of(0.0, 0.0), 0U);
  EXPECT_EQ(seed_of(0.3, 0.0), 7U);
  EXPECT_EQ(seed_of(0.0, 0.1), 7U);
}

TEST(NormalForm, DiffersInWhateverChangesTheSequenceOfBreaks) {
  const auto key = key_of(normal_form(some_scene(), true).scene);
  const auto differs = [&](auto change) {
    auto scene = some_scene();
    change(scene);
    return key_of(normal_form(scene, true).scene) != key;
  };
  EXPECT_TRUE(differs([](sim::Scene& s) { apply(s, "ratio", 1.71); }));
  EXPECT_TRUE(differs([](sim::Scene& s) { s.joints.scatter += 0.01; }));
  EXPECT_TRUE(differs([](sim::Scene& s) { s.joints.seed = 2; }));
  EXPECT_TRUE(differs([](sim::Scene& s) { s.joints.friction = 0.1; }));
  EXPECT_TRUE(differs([](sim::Scene& s) { s.assembly.orientation = 0.0; }));
  EXPECT_TRUE(differs([](sim::Scene& s) { s.material.poisson = 0.3; }));
  EXPECT_TRUE(differs([](sim::Scene& s) { *s.joints.head_tail_shear *= 1.1; }));
}

TEST(NormalForm, LeavesADynamicSceneAlone) {
  const auto scene = some_scene();
  const auto form = normal_form(scene, false);
  EXPECT_EQ(key_of(form.scene), key_of(scene));
  const auto plain = test::ClosedForm{}(scene);
  EXPECT_EQ(rescaled(plain, form).strength, plain.strength);
}

TEST(NormalForm, LeavesThresholdsFromAFileAlone) {
  auto scene = some_scene();
  scene.joints.thresholds = {{100.0, 20.0}};
  EXPECT_EQ(key_of(normal_form(scene, true).scene), key_of(scene));
}

// The limit asked for ends the curve half way up: unbroken, and its strength a lower bound.
TEST(NormalForm, CutsTheCurveAtTheStrainLimit) {
  auto scene = some_scene();
  const auto whole = in_normal_form(scene);
  scene.loading.max_strain = 0.5 * whole.failure_strain;
  const auto cut = in_normal_form(scene);
  EXPECT_FALSE(cut.broke);
  EXPECT_NEAR(cut.strength, 0.5 * whole.strength, 1e-10 * whole.strength);
  EXPECT_NEAR(cut.failure_strain, scene.loading.max_strain, 1e-15);
  EXPECT_EQ(cut.strain.back(), scene.loading.max_strain);
}

}  // namespace
}  // namespace havers::calib
