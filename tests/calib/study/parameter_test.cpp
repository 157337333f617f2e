#include "calib/study/parameter.hpp"

#include <gtest/gtest.h>

namespace havers::calib {
namespace {

TEST(Parameter, ReadsBackWhatItSet) {
  for (const auto& info : all_parameters()) {
    sim::Scene scene;
    PorosityOptions laws;
    const double value = 0.3 * info.lower + 0.7 * info.upper;
    apply(scene, info.name, value);
    apply(laws, info.name, value);
    EXPECT_NEAR(info.of_porosity ? value_of(laws, info.name) : value_of(scene, info.name), value,
                1e-12 * value)
        << info.name;
  }
}

TEST(Parameter, AspectRatioAndResultantKeepTheRatio) {
  for (const char* name : {"aspect_ratio", "resultant_MPa"}) {
    sim::Scene scene;
    const double ratio = sim::ratio(scene.assembly, scene.joints);
    apply(scene, name, 1.5 * value_of(scene, name));
    EXPECT_NEAR(sim::ratio(scene.assembly, scene.joints), ratio, 1e-12) << name;
  }
}

// Set apart to what it is by default, a pair changes no threshold.
TEST(Parameter, PairsSetApartStartAtTheirDefaults) {
  const sim::Scene scene;
  const auto& [assembly, material, joints, loading, solver] = scene;
  EXPECT_DOUBLE_EQ(value_of(scene, "head_tail_shear_MPa") * 1e6 * assembly.fibre_height,
                   joints.flank * 0.5 * assembly.fibre_length);
  EXPECT_DOUBLE_EQ(value_of(scene, "flank_tension_MPa") * 1e6 * 0.5 * assembly.fibre_length,
                   joints.head_tail * assembly.fibre_height);
}

TEST(Parameter, IsInSIInsideTheScene) {
  sim::Scene scene;
  apply(scene, "young_GPa", 15.0);
  apply(scene, "head_tail_MPa", 70.0);
  EXPECT_DOUBLE_EQ(scene.material.young, 15e9);
  EXPECT_DOUBLE_EQ(scene.joints.head_tail, 70e6);
}

TEST(Parameter, HeadTailScalesEveryStressThatBreaksAJoint) {
  sim::Scene scene;
  scene.joints.head_tail_shear = 20e6;
  scene.joints.flank_tension = 30e6;
  const double ratio = sim::ratio(scene.assembly, scene.joints);
  apply(scene, "head_tail_MPa", 2.0 * value_of(scene, "head_tail_MPa"));
  EXPECT_NEAR(sim::ratio(scene.assembly, scene.joints), ratio, 1e-12);
  EXPECT_DOUBLE_EQ(*scene.joints.head_tail_shear, 40e6);
  EXPECT_DOUBLE_EQ(*scene.joints.flank_tension, 60e6);
}

TEST(Parameter, RatioKeepsTheHeadTailStress) {
  sim::Scene scene;
  const double head_tail = scene.joints.head_tail;
  apply(scene, "ratio", 3.0);
  EXPECT_EQ(scene.joints.head_tail, head_tail);
  // r = f₁/f₂ = 2 σ₁ l / (σ₂ L) (M9)
  const auto& [assembly, material, joints, loading, solver] = scene;
  EXPECT_DOUBLE_EQ(2.0 * joints.head_tail * assembly.fibre_height,
                   3.0 * joints.flank * assembly.fibre_length);
}

TEST(Parameter, HasBoundsThatHoldTheDefaultScene) {
  for (const auto& info : all_parameters()) {
    const double value = info.of_porosity ? value_of(PorosityOptions{}, info.name)
                                          : value_of(sim::Scene{}, info.name);
    // Viscosity is searched over magnitudes, and the default scene has none.
    const bool none = value == 0.0 && info.scale == Scale::logarithmic;
    EXPECT_TRUE(none || info.lower <= value) << info.name;
    EXPECT_GT(info.upper, value) << info.name;
  }
}

TEST(Parameter, IsFoundByItsNameAlone) {
  EXPECT_EQ(find_parameter("ratio")->symbol, "r");
  EXPECT_EQ(find_parameter("rato"), nullptr);
}

}  // namespace
}  // namespace havers::calib
