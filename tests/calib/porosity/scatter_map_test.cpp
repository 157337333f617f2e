#include "calib/porosity/scatter_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace havers::calib {
namespace {

SectionPorosity section(double porosity, double bone_area, double window_sd) {
  SectionPorosity made;
  made.porosity = porosity;
  made.bone_area = bone_area;
  made.window_sd = window_sd;
  return made;
}

// (K3) by its meaning: thresholds uniform on an interval of length d (1 − p)^n have the scatter's
// SD.
TEST(Scatter, IsTheLengthOfTheIntervalWithTheSpreadOfLocalStrength) {
  const SpecimenPorosity porosity{.porosity = 0.1, .window_sd = 0.03};
  const double d = scatter_of(porosity, {.strength_exponent = 2.0});
  const double relative_sd_of_strength = 2.0 * 0.03 / 0.9;
  EXPECT_NEAR(d / std::sqrt(12.0), relative_sd_of_strength, 1e-15);
}

TEST(Scatter, IsLinearInPorosityWhereAsked) {
  const PorosityOptions options{
      .to_scatter = ToScatter::linear, .linear_offset = 0.1, .linear_slope = 3.0};
  EXPECT_NEAR(scatter_of({.porosity = 0.05}, options), 0.25, 1e-15);
  // And back: porosity from the scatter that it gave.
  EXPECT_NEAR((scatter_of({.porosity = 0.07}, options) - 0.1) / 3.0, 0.07, 1e-15);
}

TEST(Scatter, StaysWhereNoJointStartsBroken) {
  EXPECT_EQ(scatter_of({.porosity = 0.5, .window_sd = 0.5}, {}), 1.99);
  EXPECT_EQ(scatter_of({.porosity = 0.1}, {.to_scatter = ToScatter::linear, .linear_offset = -1.0}),
            0.0);
}

TEST(Scatter, IsUnknownWhereTheImagesDoNotGiveIt) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(scatter_of({.porosity = 0.1, .window_sd = unknown}, {})));
  EXPECT_TRUE(std::isnan(scatter_of({.porosity = 0.1}, {.to_scatter = ToScatter::none})));
  EXPECT_TRUE(std::isnan(scatter_standard_error({.window_sd = unknown}, {})));
}

// First-order propagation against the map itself.
TEST(Scatter, CarriesTheStandardErrorsOfWhatItComesFrom) {
  const SpecimenPorosity porosity{.porosity = 0.1,
                                  .porosity_standard_error = 0.004,
                                  .window_sd = 0.05,
                                  .window_sd_standard_error = 0.003};
  const auto shifted = [&](double dp, double dsd) {
    return scatter_of({.porosity = 0.1 + dp, .window_sd = 0.05 + dsd}, {});
  };
  const double expected = std::hypot(0.5 * (shifted(0.004, 0.0) - shifted(-0.004, 0.0)),
                                     0.5 * (shifted(0.0, 0.003) - shifted(0.0, -0.003)));
  EXPECT_NEAR(scatter_standard_error(porosity, {}), expected, 1e-3 * expected);
  EXPECT_NEAR(
      scatter_standard_error(porosity, {.to_scatter = ToScatter::linear, .linear_slope = 2.0}),
      0.008, 1e-15);
}

TEST(PooledSections, WeighByBoneArea) {
  EXPECT_NEAR(pool_sections({section(0.1, 3e-6, 0.0), section(0.2, 1e-6, 0.0)}).porosity, 0.125,
              1e-15);
}

TEST(PooledSections, WeighEquallyWhereAnAreaIsUnknown) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(pool_sections({section(0.1, unknown, 0.0), section(0.2, 1e-6, 0.0)}).porosity, 0.15,
              1e-15);
}

// The windows of both sections in one bag: variance within plus variance of the means.
TEST(PooledSections, WidenTheWindowSpreadByTheirDifference) {
  const auto pooled = pool_sections({section(0.1, 1.0, 0.03), section(0.14, 1.0, 0.04)});
  EXPECT_NEAR(pooled.window_sd, std::sqrt(0.5 * (0.03 * 0.03 + 0.04 * 0.04) + 0.02 * 0.02), 1e-15);
}

TEST(PooledSections, DifferAsTheirMeanIsUncertain) {
  const auto pooled = pool_sections({section(0.1, 1.0, 0.0), section(0.14, 1.0, 0.0)});
  EXPECT_NEAR(pooled.porosity_standard_error, 0.02, 1e-15);  // half the difference of two
}

TEST(PooledSections, KeepTheirOwnUncertaintyWhereTheyAgreeByChance) {
  auto one = section(0.1, 1.0, 0.05);
  one.porosity_standard_error = 0.02;
  one.window_sd_standard_error = 0.01;
  const auto pooled = pool_sections({one, one});
  EXPECT_NEAR(pooled.porosity_standard_error, 0.02 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(pooled.window_sd_standard_error, 0.01 / std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(pool_sections({one}).window_sd_standard_error, 0.01, 1e-15);
}

TEST(PooledSections, TakeTheWindowSpreadFromThoseThatHaveIt) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(pool_sections({section(0.1, 1.0, unknown), section(0.1, 1.0, 0.04)}).window_sd, 0.04,
              1e-15);
  EXPECT_TRUE(std::isnan(pool_sections({section(0.1, 1.0, unknown)}).window_sd));
}

TEST(MissingJoints, AreThoseInPoresLargerThanAWindow) {
  SpecimenPorosity porosity{.porosity = 0.08, .pore_area_ratio = 500e-12, .window_area = 1000e-12};
  EXPECT_FALSE(removes_joints(porosity));
  EXPECT_EQ(missing_joints(porosity), 0.0);
  porosity.pore_area_ratio = 2000e-12;
  EXPECT_TRUE(removes_joints(porosity));
  EXPECT_EQ(missing_joints(porosity), 0.08);
}

// Two sections as one bag of pores: Σa²/Σa.
TEST(PooledSections, PoolTheirPoresAreas) {
  auto one = section(0.1, 1.0, 0.0), other = one;
  one.pore_area = 3.0, one.pore_area_ratio = 2.0, other.pore_area = 1.0,
  other.pore_area_ratio = 6.0;
  EXPECT_NEAR(pool_sections({one, other}).pore_area_ratio, 3.0, 1e-15);
}

TEST(ModulusFactor, IsAPowerOfWhatIsSolidOrOne) {
  const PorosityOptions power{.to_modulus = ToModulus::power, .modulus_exponent = 2.0};
  EXPECT_NEAR(modulus_factor({.porosity = 0.1}, power), 0.81, 1e-15);
  EXPECT_EQ(modulus_factor({.porosity = 0.0}, power), 1.0);
  EXPECT_EQ(modulus_factor({.porosity = 0.1}, {}), 1.0);
}

}  // namespace
}  // namespace havers::calib
