// What a study asks of its simulations.
#include "calib/fit/fit_problem.hpp"

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// 14 layers of 10 fibres at 45 degrees: runs of such walls end early in their avalanche.
Study one_oblique_bar() {
  Study study;
  study.model.assembly.layers = 14;
  study.model.assembly.fibres = 10;
  study.model.joints.scatter = 0.8;
  study.calibrate.parameters = {"head_tail_MPa"};
  Specimen& specimen = study.specimens.emplace_back();
  specimen.id = "A1";
  specimen.orientation = 45.0 * test::degree;
  specimen.test = test::straight_test(13e9, 20e6);
  specimen.test.strain_rate = 1e-4;
  return study;
}

std::vector<sim::Scene> scenes_of(const Study& study) {
  const FitProblem problem = make_problem(study);
  return replicate_scenes(problem, start_point(problem.unknowns), 0, 16);
}

TEST(FitProblem, FollowsAFallToHalfWhereThePostPeakDropCounts) {
  Study study = one_oblique_bar();
  const auto usual = scenes_of(study);
  study.calibrate.terms.emplace_back("post-peak drop");
  const auto followed = scenes_of(study);
  int later = 0;
  for (std::size_t i = 0; i < usual.size(); ++i) {
    const auto model = fibre_model();
    const auto ended = model.run(usual[i]).value(), fell = model.run(followed[i]).value();
    ASSERT_FALSE(fell.failed) << fell.why;
    EXPECT_LE(fell.stress.back(), 0.5 * fell.strength);
    EXPECT_NEAR(fell.strength, ended.strength, 1e-9 * ended.strength);
    EXPECT_NEAR(fell.failure_strain, ended.failure_strain, 1e-9 * ended.failure_strain);
    const double drop = landmarks_of(fell)[post_peak];
    EXPECT_GE(drop, landmarks_of(ended)[post_peak] * (1.0 - 1e-9));
    later += drop > landmarks_of(ended)[post_peak] + 0.01 ? 1 : 0;
  }
  EXPECT_GT(later, 0);
}

// The first test broke, the second was stopped.
TEST(FitProblem, CountsNoBoundAmongTheResiduals) {
  Study study = test::synthetic_study({0.0});
  study.specimens[1].broke = false;
  const FitProblem problem = make_problem(study);
  Evaluation at;
  at.predictions.resize(2);
  const auto told = [&](double above) {
    for (std::size_t f = 0; f < 2; ++f) {
      at.predictions[f].mean = problem.targets[f].value;
      at.predictions[f].mean[strength] += above;
    }
    return residuals_told(problem, at);
  };
  EXPECT_EQ(told(0.1)[strength], 1.0);
  EXPECT_EQ(told(-0.1)[strength], 1.0);
  EXPECT_EQ(told(0.0)[modulus], 2.0);
  EXPECT_EQ(told(0.0)[linearity], 1.0);
  at.predictions[0].censored = true;  // its simulations do not break
  EXPECT_EQ(told(0.1)[strength], 1.0);
  EXPECT_EQ(told(-0.1)[strength], 0.0);
  EXPECT_EQ(told(0.0)[modulus], 2.0);
  EXPECT_EQ(told(0.0)[linearity], 0.0);
}

// d goes with the exponent of the strength (K3), and so does its standard error.
TEST(FitProblem, WeighsTheErrorOfAScatterByTheLawThatIsFitted) {
  Study study = test::synthetic_study({0.0});
  SectionPorosity section;
  section.porosity = 0.05;
  section.bone_area = 1e-6;
  section.window_sd = 0.05;
  section.window_sd_standard_error = 0.01;
  section.window_area = 1e-9;
  for (auto& specimen : study.specimens) specimen.sections = {section};
  study.calibrate.parameters = {"strength_exponent"};
  const FitProblem problem = make_problem(study);
  SimulationBatch batch(test::ClosedForm{}.simulator(), nullptr, 1);
  const auto error_at = [&](double exponent) {
    const Point point = Point::Constant(1, to_search(*problem.unknowns[0].info, exponent));
    const auto at = predict(problem, batch, {point}, 4).front();
    return porosity_error(problem, batch, point, 0, at.predictions[0])[strength];
  };
  // Log strength falls by 1/(2 − d) of the scatter.
  const auto slope = [](double d) { return 1.0 / (2.0 - d); };
  const double d = std::sqrt(12.0) * 0.05 / 0.95;
  EXPECT_GT(error_at(1.0), 0.0);
  EXPECT_NEAR(error_at(2.0) / error_at(1.0), 2.0 * slope(2.0 * d) / slope(d), 0.03);
}

// (K4), (K5): what the porosity takes from moduli and joints has its error too.
TEST(FitProblem, WeighsTheErrorOfMissingJointsAndOfModuli) {
  Study study = test::synthetic_study({0.0});
  SectionPorosity section;
  section.porosity = 0.05;
  section.porosity_standard_error = 0.01;
  section.bone_area = 1e-6;
  section.window_sd = 0.05;
  section.pore_area = 1e-8;
  section.pore_area_ratio = 2e-9;
  section.window_area = 1e-9;
  for (auto& specimen : study.specimens) specimen.sections = {section};
  study.porosity.to_modulus = ToModulus::power;
  const FitProblem problem = make_problem(study);
  const Simulator missing_weaken{.run =
                                     [](const sim::Scene& scene) {
                                       Response response =
                                           test::ClosedForm{}.simulator().run(scene).value();
                                       response.strength *= std::exp(-7.0 * scene.joints.missing);
                                       return std::optional(response);
                                     },
                                 .quasi_static = [](const sim::Scene&) { return false; }};
  SimulationBatch batch(missing_weaken, nullptr, 1);
  const Point point = start_point(problem.unknowns);
  const auto at = predict(problem, batch, {point}, 4).front();
  const Landmarks error = porosity_error(problem, batch, point, 0, at.predictions[0]);
  EXPECT_NEAR(error[strength], 7.0 * 0.01, 1e-9);
  EXPECT_NEAR(error[modulus], 2.7 * 0.01 / 0.95, 1e-12);
}

// In time a run ends by its end fraction alone, and without what it leaves out it takes long.
TEST(FitProblem, LeavesOutInTimeWhatItDoesOtherwise) {
  Study study = one_oblique_bar();
  study.specimens[0].test.strain_rate = 1000.0;
  study.calibrate.terms.emplace_back("post-peak drop");
  study.model.loading.end_fraction = 0.7;
  EXPECT_EQ(scenes_of(study)[0].loading.end_fraction, 0.5);
  EXPECT_TRUE(scenes_of(study)[0].solver.leave_out);
  study.model.loading.end_fraction = 0.3;
  EXPECT_EQ(scenes_of(study)[0].loading.end_fraction, 0.3);
}

}  // namespace
}  // namespace havers::calib
