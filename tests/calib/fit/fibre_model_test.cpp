// The fibre model as a calibration uses it: one stored simulation serves every E and σ₁.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calib/fit/calibrate.hpp"
#include "calib/fit/normal_form.hpp"
#include "calib/fit/simulation_batch.hpp"
#include "calib/study/parameter.hpp"
#include "calib/sweep/measure.hpp"
#include "tests/support/slow.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

sim::Scene small_scene(double degrees) {
  sim::Scene scene;
  scene.assembly.layers = 6;
  scene.assembly.fibres = 5;
  scene.assembly.orientation = degrees * std::numbers::pi / 180.0;
  scene.loading.strain_rate = 1e-4;
  apply(scene, "young_GPa", 17.3);
  apply(scene, "head_tail_MPa", 41.7);
  apply(scene, "ratio", 1.7);
  return scene;
}

TEST(FibreModel, GivesInNormalFormWhatItGivesPlain) {
  const auto model = fibre_model();
  for (const double degrees : {0.0, 45.0, 90.0}) {
    const auto scene = small_scene(degrees);
    ASSERT_TRUE(model.quasi_static(scene));
    const auto form = normal_form(scene, true);
    ASSERT_TRUE(form.scaled);
    const auto plain = model.run(scene).value();
    const auto scaled = rescaled(model.run(form.scene).value(), form);
    ASSERT_FALSE(plain.failed) << plain.why;
    EXPECT_EQ(scaled.broke, plain.broke);
    EXPECT_NEAR(scaled.modulus, plain.modulus, 1e-9 * plain.modulus);
    EXPECT_NEAR(scaled.strength, plain.strength, 1e-9 * plain.strength);
    EXPECT_NEAR(scaled.failure_strain, plain.failure_strain, 1e-9 * plain.failure_strain);
    ASSERT_EQ(scaled.stress.size(), plain.stress.size());
    for (std::size_t i = 0; i < plain.stress.size(); ++i)
      EXPECT_NEAR(scaled.stress[i], plain.stress[i], 1e-7 * plain.strength);
  }
}

TEST(FibreModel, IsNotScaledWhereTheLoadingIsFast) {
  auto scene = small_scene(0.0);
  scene.loading.strain_rate = 1000.0;
  EXPECT_FALSE(fibre_model().quasi_static(scene));
}

TEST(FibreModel, HasNoAnswerWhereNoJointIsLeft) {
  auto scene = small_scene(0.0);
  scene.joints.missing = 0.99;
  const auto response = fibre_model().run(scene).value();
  EXPECT_TRUE(response.failed);
  EXPECT_THAT(response.why, testing::HasSubstr("nothing that bears a load"));
}

// A sweep has its strength, and no modulus; a fit cannot use it.
TEST(FibreModel, HasNoModulusInAShock) {
  HAVERS_SLOW;
  Study study = test::synthetic_study({0.0});
  study.model = small_scene(0.0);
  study.model.loading.start = sim::Start::rest;
  study.model.loading.strain_rate = 1e4;
  study.model.solver.step = 2e-9;
  study.calibrate.replicates = 2;
  for (Specimen& specimen : study.specimens) specimen.test.strain_rate = 1e4;
  study.calibrate.parameters = {"young_GPa"};
  const auto response = fibre_model().run(study.model).value();
  EXPECT_FALSE(response.failed) << response.why;
  EXPECT_EQ(response.modulus, 0.0);
  const auto measures = measures_of(response, study.model, nullptr);
  EXPECT_TRUE(std::isnan(measures[static_cast<std::size_t>(Measure::modulus)]));
  EXPECT_GT(measures[static_cast<std::size_t>(Measure::strength)], 0.0);
  const CalibrationResult result = calibrate(study, nullptr);
  EXPECT_EQ(result.status, CalibrationStatus::all_failed);
  EXPECT_THAT(result.most_failed_because, testing::HasSubstr("the modulus is that of a shock"));
}

TEST(FibreModel, StopsInsideARunInStepsAndInTheLimit) {
  HAVERS_SLOW;
  for (const double rate : {1e-4, 1000.0}) {
    auto scene = small_scene(0.0);
    scene.assembly.layers = 3;
    scene.loading.strain_rate = rate;
    int asked = 0;
    EXPECT_FALSE(fibre_model([&] { return ++asked == 3; }).run(scene));
    EXPECT_EQ(asked, 3);
    EXPECT_TRUE(fibre_model([] { return false; }).run(scene));
  }
}

}  // namespace
}  // namespace havers::calib
