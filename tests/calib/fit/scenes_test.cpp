#include "calib/fit/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace havers::calib {
namespace {

Study one_specimen() {
  Study study;
  study.model.joints.scatter = 0.25;
  study.specimens.resize(1);
  study.specimens[0].id = "A1";
  study.specimens[0].orientation = 0.7;
  study.specimens[0].test.strain_rate = 3e-4;
  return study;
}

TEST(ModelOfASpecimen, TakesOrientationAndRateFromTheTest) {
  const auto model = model_of(one_specimen(), 0);
  EXPECT_EQ(model.scene.assembly.orientation, 0.7);
  EXPECT_EQ(model.scene.loading.strain_rate, 3e-4);
  EXPECT_TRUE(std::isnan(model.porosity));
}

TEST(ModelOfASpecimen, TakesScatterAndModulusFromItsSections) {
  auto study = one_specimen();
  study.porosity.to_modulus = ToModulus::power;
  SectionPorosity section;
  section.porosity = 0.1;
  section.porosity_standard_error = 0.01;
  section.window_sd = 0.02;
  study.specimens[0].sections = {section};
  const auto model = model_of(study, 0);
  const auto pooled = pool_sections(study.specimens[0].sections);
  EXPECT_EQ(model.scene.joints.scatter, scatter_of(pooled, study.porosity));
  EXPECT_EQ(model.modulus_factor, modulus_factor(pooled, study.porosity));
  EXPECT_EQ(model.porosity, 0.1);
  EXPECT_TRUE(model.scatter_told);
  EXPECT_NEAR(model.modulus_standard_error, 2.7 * 0.01 / 0.9, 1e-15);
}

// (K5): pores larger than a window take joints away, and leave the others' thresholds alone.
TEST(ModelOfASpecimen, MissesJointsWhereItsPoresAreLargerThanAFibre) {
  auto study = one_specimen();
  SectionPorosity section;
  section.porosity = 0.1;
  section.porosity_standard_error = 0.02;
  section.window_sd = 0.2;
  section.pore_area = 1e-8;
  section.window_area = 1e-9;
  section.pore_area_ratio = 2e-9;
  study.specimens[0].sections = {section};
  const auto large = model_of(study, 0);
  EXPECT_EQ(large.scene.joints.missing, 0.1);
  EXPECT_EQ(large.scene.joints.scatter, 0.25);
  EXPECT_EQ(large.scatter_standard_error, 0.0);
  EXPECT_EQ(large.missing_standard_error, 0.02);
  EXPECT_FALSE(large.scatter_told);

  study.specimens[0].sections[0].pore_area_ratio = 0.5e-9;
  const auto small = model_of(study, 0);
  EXPECT_EQ(small.scene.joints.missing, 0.0);
  EXPECT_GT(small.scene.joints.scatter, 0.25);

  study.specimens[0].sections[0].pore_area_ratio = 2e-9;
  study.porosity.to_scatter = ToScatter::linear;  // a map that was asked for is not overruled
  EXPECT_EQ(model_of(study, 0).scene.joints.missing, 0.0);
}

TEST(ModelOfASpecimen, KeepsTheStudysScatterWhereNothingGivesAnother) {
  auto study = one_specimen();
  EXPECT_EQ(model_of(study, 0).scene.joints.scatter, 0.25);
  study.specimens[0].porosity = 0.1;  // a porosity alone says nothing of its spread
  EXPECT_EQ(model_of(study, 0).scene.joints.scatter, 0.25);
  study.porosity.to_scatter = ToScatter::linear;
  study.porosity.linear_offset = 0.1;
  study.porosity.linear_slope = 2.0;
  EXPECT_NEAR(model_of(study, 0).scene.joints.scatter, 0.3, 1e-15);
}

TEST(ReplicateSeed, DependsOnStudySpecimenAndReplicateAlone) {
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t study : {1U, 2U})
    for (const char* id : {"A1", "A2", "B1"})
      for (int replicate = 0; replicate < 8; ++replicate) {
        seeds.insert(replicate_seed(study, id, replicate));
        EXPECT_EQ(replicate_seed(study, id, replicate), replicate_seed(study, id, replicate));
      }
  EXPECT_EQ(seeds.size(), 48U);
}

}  // namespace
}  // namespace havers::calib
