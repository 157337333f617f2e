#include "sim/joint/thresholds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

constexpr std::uint64_t draws = 50000;

struct Moments {
  double mean = 0.0, deviation = 0.0, least = INFINITY, greatest = -INFINITY;
};

Moments moments(double scatter, Distribution distribution) {
  Moments m;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t joint = 0; joint < draws; ++joint) {
    const double w = ThresholdFactors(7, scatter, distribution)(joint);
    sum += w;
    squares += w * w;
    m.least = std::min(m.least, w);
    m.greatest = std::max(m.greatest, w);
  }
  m.mean = sum / draws;
  m.deviation = std::sqrt(squares / draws - m.mean * m.mean);
  return m;
}

// (M8): mean 1 and standard deviation d/√12 whatever the distribution.
TEST(ThresholdFactor, HasTheSameMeanAndDeviationInEveryDistribution) {
  for (const Distribution distribution :
       {Distribution::uniform, Distribution::weibull, Distribution::lognormal})
    for (const double scatter : {0.1, 0.6, 1.9}) {
      const Moments m = moments(scatter, distribution);
      const double deviation = scatter / std::sqrt(12.0);
      EXPECT_NEAR(m.mean, 1.0, 5.0 * deviation / std::sqrt(draws));
      EXPECT_NEAR(m.deviation / deviation, 1.0, 0.02);
      EXPECT_GT(m.least, 0.0);
    }
}

TEST(OpenUniform, ExcludesBothEnds) {
  EXPECT_EQ(open_uniform(0), 0x1p-54);
  EXPECT_EQ(open_uniform(std::uint64_t{1} << 63U), 0.5);
  EXPECT_EQ(open_uniform(~std::uint64_t{0} - 0x800), 1.0 - 0x1p-52);
  EXPECT_EQ(open_uniform(~std::uint64_t{0}), 1.0 - 0x1p-53);
}

TEST(ThresholdFactor, FillsTheWholeIntervalWhenUniform) {
  const Moments m = moments(0.8, Distribution::uniform);
  EXPECT_GT(m.least, 0.6);
  EXPECT_LT(m.greatest, 1.4);
  EXPECT_NEAR(m.least, 0.6, 1e-4);
  EXPECT_NEAR(m.greatest, 1.4, 1e-4);
}

// Philox2x64-10 [SMDS11], written out: the numbers that all draws come from.
std::uint64_t philox(std::uint64_t joint, std::uint64_t stream, std::uint64_t seed) {
  constexpr std::uint64_t multiplier = 0xD2B74407B1CE6E93, weyl = 0x9E3779B97F4A7C15;
  constexpr std::uint64_t low_half = 0xFFFFFFFF;
  for (int round = 0; round < 10; ++round, seed += weyl) {
    const std::uint64_t a = multiplier >> 32U, b = multiplier & low_half;
    const std::uint64_t c = joint >> 32U, d = joint & low_half;
    const std::uint64_t middle = a * d + ((b * d) >> 32U);
    const std::uint64_t carried = b * c + (middle & low_half);
    const std::uint64_t high = a * c + (middle >> 32U) + (carried >> 32U);
    joint = std::exchange(stream, multiplier * joint);
    joint ^= high ^ seed;
  }
  return joint;
}

// A scene of today is the same specimen tomorrow.
TEST(ThresholdFactor, IsDrawnFromTheNumbersOfPhilox) {
  EXPECT_EQ(philox(0, 0, 0), 0xCA00A0459843D731U);  // of its authors' table, as are these
  EXPECT_EQ(philox(~std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0}), 0x65B021D60CD8310FU);
  EXPECT_EQ(philox(0x243F6A8885A308D3, 0x13198A2E03707344, 0xA4093822299F31D0),
            0x0A5E742C2997341CU);
  EXPECT_DOUBLE_EQ(ThresholdFactors(0, 1.0, Distribution::uniform)(0),
                   0.5 + open_uniform(0xCA00A0459843D731));
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}})
    for (const std::uint64_t joint : {0U, 1U, 12345U}) {
      EXPECT_DOUBLE_EQ(ThresholdFactors(seed, 1.0, Distribution::uniform)(joint),
                       0.5 + open_uniform(philox(joint, 0, seed)));
      const double missing_above = open_uniform(philox(joint, 1, seed));
      EXPECT_FALSE(is_drawn_missing(seed, joint, missing_above));
      EXPECT_TRUE(is_drawn_missing(seed, joint, std::nextafter(missing_above, 1.0)));
    }
}

// The uniform number u that it was drawn from is the part of the distribution below it.
TEST(ThresholdFactor, HasThePartOfItsDistributionBelowItThatWasDrawn) {
  // Rayleigh's law is Weibull's of shape 2: mean √π/2, coefficient of variation √(4/π − 1).
  const double cv = std::sqrt(4.0 / std::numbers::pi - 1.0), d = cv * std::sqrt(12.0);
  const double s = std::sqrt(std::log1p(cv * cv));
  for (std::uint64_t joint = 0; joint < 100; ++joint) {
    const double u = open_uniform(philox(joint, 0, 3));
    EXPECT_NEAR(ThresholdFactors(3, d, Distribution::uniform)(joint), 1.0 + d * (u - 0.5), 1e-14);
    const double rayleigh = ThresholdFactors(3, d, Distribution::weibull)(joint);
    EXPECT_NEAR(-std::expm1(-0.25 * std::numbers::pi * rayleigh * rayleigh), u, 1e-11);
    const double deviations =
        (std::log(ThresholdFactors(3, d, Distribution::lognormal)(joint)) + 0.5 * s * s) / s;
    EXPECT_NEAR(0.5 * std::erfc(-deviations / std::numbers::sqrt2), u, 1e-11);
  }
}

TEST(ThresholdFactor, DependsOnSeedAndJointAlone) {
  EXPECT_EQ(ThresholdFactors(5, 0.4, Distribution::uniform)(17),
            ThresholdFactors(5, 0.4, Distribution::uniform)(17));
  EXPECT_NE(ThresholdFactors(5, 0.4, Distribution::uniform)(17),
            ThresholdFactors(6, 0.4, Distribution::uniform)(17));
  EXPECT_NE(ThresholdFactors(5, 0.4, Distribution::uniform)(17),
            ThresholdFactors(5, 0.4, Distribution::uniform)(18));
  EXPECT_EQ(ThresholdFactors(5, 0.0, Distribution::weibull)(17), 1.0);
}

// A longer interval or another distribution stretches the draw, but does not reshuffle it.
TEST(ThresholdFactor, KeepsTheOrderOfJointsWhenParametersChange) {
  for (std::uint64_t joint = 0; joint < 100; ++joint) {
    const double w = ThresholdFactors(2, 0.2, Distribution::uniform)(joint);
    EXPECT_NEAR(ThresholdFactors(2, 1.0, Distribution::uniform)(joint) - 1.0, 5.0 * (w - 1.0),
                1e-14);
    const double next = ThresholdFactors(2, 0.2, Distribution::uniform)(joint + 1);
    for (const Distribution other : {Distribution::weibull, Distribution::lognormal})
      EXPECT_EQ(w < next, ThresholdFactors(2, 0.7, other)(joint) <
                              ThresholdFactors(2, 0.7, other)(joint + 1));
  }
}

Joint joint_of(JointKind kind, double length, double y) {
  Joint joint;
  joint.kind = kind;
  joint.length = length;
  joint.position = {1e-4, y};
  return joint;
}

TEST(MeanThreshold, IsThePapersSingleLawUnlessAKindIsSetApart) {
  Scene scene = test::small_scene(45.0);
  const double l = scene.assembly.fibre_height, half = 0.5 * scene.assembly.fibre_length;
  const double f1 = scene.joints.head_tail * l, f2 = scene.joints.flank * half;
  for (const auto& [kind, length] :
       {std::pair{JointKind::head_tail, l}, std::pair{JointKind::flank, half}}) {
    const Threshold full = mean_threshold(scene, joint_of(kind, length, 0.0));
    EXPECT_DOUBLE_EQ(full.normal, f1);
    EXPECT_DOUBLE_EQ(full.tangent, f2);
    const Threshold piece = mean_threshold(scene, joint_of(kind, 0.3 * length, 0.0));
    EXPECT_DOUBLE_EQ(piece.normal, 0.3 * f1);
    EXPECT_DOUBLE_EQ(piece.tangent, 0.3 * f2);
  }
  scene.joints.head_tail_shear = 7e6;
  scene.joints.flank_tension = 3e6;
  EXPECT_DOUBLE_EQ(mean_threshold(scene, joint_of(JointKind::head_tail, l, 0.0)).tangent, 7e6 * l);
  EXPECT_DOUBLE_EQ(mean_threshold(scene, joint_of(JointKind::flank, half, 0.0)).normal, 3e6 * half);
}

TEST(MeanThreshold, GivesTheOuterLayersTheMissingFlanksForce) {
  Scene scene = test::small_scene(0.0);
  const double l = scene.assembly.fibre_height, half = 0.5 * scene.assembly.fibre_length;
  const double f1 = scene.joints.head_tail * l, f2 = scene.joints.flank * half;
  const auto normal = [&](JointKind kind, double y) {
    return mean_threshold(scene, joint_of(kind, kind == JointKind::flank ? half : l, y)).normal;
  };
  EXPECT_DOUBLE_EQ(normal(JointKind::head_tail, 0.5 * l), f1 + f2);
  EXPECT_DOUBLE_EQ(normal(JointKind::head_tail, scene.assembly.height() - 0.5 * l), f1 + f2);
  EXPECT_DOUBLE_EQ(normal(JointKind::head_tail, 1.5 * l), f1);
  EXPECT_DOUBLE_EQ(normal(JointKind::flank, 0.0), f1);
  scene.assembly.layers = 1;
  EXPECT_DOUBLE_EQ(normal(JointKind::head_tail, 0.5 * l), f1 + 2.0 * f2) << "it is both";
  scene.joints.reinforced_boundary = false;
  EXPECT_DOUBLE_EQ(normal(JointKind::head_tail, 0.5 * l), f1);
}

TEST(MeanThreshold, LetsOneLayerBearTheResultant) {
  Scene scene = test::small_scene(0.0, 1, 5);
  scene.joints.scatter = 0.0;
  EXPECT_NEAR(simulate(scene).strength / resultant(scene.assembly, scene.joints), 1.0, 1e-9);
}

TEST(DrawThresholds, ScalesBothThresholdsOfAJointByOneDraw) {
  const Scene scene = test::small_scene(45.0);
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  const auto thresholds = draw_thresholds(scene, assembly);
  ASSERT_EQ(thresholds.size(), assembly.joints.size());
  for (std::size_t i = 0; i < thresholds.size(); ++i) {
    const Threshold mean = mean_threshold(scene, assembly.joints[i]);
    const double w = ThresholdFactors(scene.joints.seed, 0.2, Distribution::uniform)(i);
    EXPECT_DOUBLE_EQ(thresholds[i].normal, w * mean.normal);
    EXPECT_DOUBLE_EQ(thresholds[i].tangent, w * mean.tangent);
  }
}

TEST(DrawThresholds, TakesGivenOnesAsTheyAre) {
  Scene scene = test::small_scene();
  const Assembly assembly = build_assembly(scene.assembly, scene.loading.lateral);
  scene.joints.thresholds.assign(assembly.joints.size(), {12.0, 34.0});
  for (const Threshold& threshold : draw_thresholds(scene, assembly)) {
    EXPECT_EQ(threshold.normal, 12.0);
    EXPECT_EQ(threshold.tangent, 34.0);
  }
}

// Outer layers bear more, and say no more of σ₁ than others do.
TEST(HeadTailStrength, OfGivenThresholdsIsThatOfTheSceneThatDrewThem) {
  for (const int layers : {2, 6}) {
    Scene scene = test::small_scene(0.0);
    scene.assembly.layers = layers;
    scene.joints.scatter = 0.0;
    scene.joints.thresholds =
        draw_thresholds(scene, build_assembly(scene.assembly, scene.loading.lateral));
    EXPECT_NEAR(head_tail_strength(scene) / scene.joints.head_tail, 1.0, 1e-14) << layers;
    for (Threshold& threshold : scene.joints.thresholds) threshold.normal *= 0.5;
    EXPECT_NEAR(head_tail_strength(scene) / scene.joints.head_tail, 0.5, 1e-14) << layers;
  }
}

TEST(HeadTailStrength, OfTwoJointsIsTheMeanOfBoth) {
  Scene scene = test::small_scene(0.0, 1, 3);
  scene.joints.reinforced_boundary = false;
  const double f1 = scene.joints.head_tail * scene.assembly.fibre_height;
  scene.joints.thresholds = {{.normal = f1, .tangent = f1}, {.normal = 3.0 * f1, .tangent = f1}};
  EXPECT_DOUBLE_EQ(head_tail_strength(scene), 2.0 * scene.joints.head_tail);
}

// Thresholds of 0 say nothing of σ₁.
TEST(HeadTailStrength, PassesOverMissingJoints) {
  Scene scene = test::small_scene(0.0, 1, 4);
  scene.joints.reinforced_boundary = false;
  const double f1 = scene.joints.head_tail * scene.assembly.fibre_height;
  scene.joints.thresholds = {{}, {.normal = 2.0 * f1, .tangent = f1}, {}};
  EXPECT_DOUBLE_EQ(head_tail_strength(scene), 2.0 * scene.joints.head_tail);
  scene.joints.thresholds.assign(3, {});
  EXPECT_EQ(head_tail_strength(scene), scene.joints.head_tail) << "nothing else is known";
}

}  // namespace
}  // namespace havers::sim
