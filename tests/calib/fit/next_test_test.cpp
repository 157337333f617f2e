// What one more test would tell, before it is made.
#include "calib/fit/next_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/fit/calibrate.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

TEST(NextTest, KnowsWhichFurtherTestTellsMost) {
  const auto result = test::fit(test::synthetic_study({0.0, 0.0, 45.0}, {.specimen_effect = 0.05}));
  ASSERT_EQ(result.next_tests.size(), 3U);  // 90 degrees is simulated
  const auto ratio =
      static_cast<std::size_t>(std::ranges::find(result.fitted, "ratio") - result.fitted.begin());
  ASSERT_LT(ratio, result.fitted.size());
  for (const auto& test : result.next_tests)
    for (const double width : test.width) EXPECT_LE(width, 1.0 + 1e-9) << test.what;
  EXPECT_LT(result.next_tests[1].width[ratio], result.next_tests[0].width[ratio]);
  EXPECT_LT(result.next_tests[1].width[ratio], 0.9);
}

// Strength that follows the modulus would tell of it too; these tests are asked for the modulus
// alone. Of two the mean has an error of s/√2, of three one of s/√3.
TEST(NextTest, ExpectsOfAFurtherTestWhatTheOthersAreAskedFor) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"young_GPa"};
  study.calibrate.terms = {"modulus"};
  const auto simulator = test::altered(
      [](Response& response, const sim::Scene& scene) {
        response.strength *= scene.material.young / 14e9;
        response.failure_strain = response.strength / response.modulus;
      },
      {.quasi_static = false});
  const auto result = calibrate_with(simulator, study);
  ASSERT_EQ(result.next_tests.size(), 3U);
  for (const auto& test : result.next_tests)
    EXPECT_NEAR(test.width.at(0), std::sqrt(2.0 / 3.0), 1e-3) << test.what;
}

// "auto" tries the scatter where no specimen has porosity. One has here, that at 90 degrees is made
// from another.
TEST(NextTest, FitsNothingMoreToAFurtherTestThanToTheOthers) {
  auto study = test::synthetic_study({0.0, 0.0, 45.0});
  study.porosity.to_scatter = ToScatter::linear;
  study.specimens[0].porosity = 0.05;
  const auto asked = test::fit(study);
  study.calibrate.automatic = true;
  const auto automatic = test::fit(study);
  ASSERT_EQ(automatic.fitted, asked.fitted);
  ASSERT_EQ(automatic.next_tests.size(), 3U);
  EXPECT_EQ(automatic.next_tests[2].width, asked.next_tests[2].width);
}

// In the quasi-static limit a faster test is the same test.
TEST(NextTest, KnowsWhatATestAtAnotherRateWouldTell) {
  auto study = test::synthetic_study(test::three_orientations);
  for (auto& specimen : study.specimens) specimen.test.strain_rate = 1e-3;
  const auto result = test::fit(study);
  ASSERT_EQ(result.next_tests.size(), 4U);
  EXPECT_EQ(result.next_tests[3].what, "one more specimen at 0 deg, 10 times as fast");
  for (std::size_t k = 0; k < result.fitted.size(); ++k)
    EXPECT_NEAR(result.next_tests[3].width[k], result.next_tests[0].width[k], 1e-6);
}

// A stopped test tells no strength; one more would.
TEST(NextTest, IsLikeOneThatBroke) {
  auto study = test::synthetic_study({0.0, 45.0});
  study.specimens[0].broke = study.specimens[0].test.broke = false;
  study.specimens[0].test.strength *= 0.5;
  study.specimens[0].test.failure_strain *= 0.5;
  const auto result = test::fit(study);
  const auto strength = static_cast<std::size_t>(std::ranges::find(result.fitted, "head_tail_MPa") -
                                                 result.fitted.begin());
  ASSERT_LT(strength, result.fitted.size());
  EXPECT_LT(result.next_tests[0].width[strength], 0.9);
}

// The variance of a mean over n sections falls from 1/n to 1/(n + 1). Of specimens with one and
// with three of them, known to 5 %, of which the scatter's error makes 4 %.
TEST(NextTest, KnowsWhatOneMoreSectionWouldTell) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"head_tail_MPa"};
  study.specimens[0].sections.resize(1);
  study.specimens[1].sections.resize(3);
  const FitProblem problem = make_problem(study);
  SimulationBatch batch(test::ClosedForm{}.simulator(), nullptr, 1);
  Answer answer{.active = {0}, .replicates = 1};
  answer.best.point = start_point(problem.unknowns);
  answer.weights.scatter.assign(2, Landmarks(Landmarks::Zero()));
  answer.weights.sd.assign(2, Landmarks(Landmarks::Constant(0.05)));
  for (Landmarks& scatter : answer.weights.scatter) scatter[strength] = 0.04;
  answer.slopes.jacobian = Eigen::MatrixXd::Zero(2 * landmark_count, 1);
  for (const std::size_t f : {0U, 1U})
    answer.slopes.jacobian(first_row(f) + strength, 0) = 1.0 / 0.05;
  const auto tests = next_tests(batch, problem, answer);
  ASSERT_EQ(tests.size(), 4U);  // after one more specimen at 0, 45 and 90 degrees
  EXPECT_EQ(tests.back().what, "one more section of every specimen");
  const double now = 2.0 / 25e-4, then = 1.0 / (25e-4 - 16e-4 / 2.0) + 1.0 / (25e-4 - 16e-4 / 4.0);
  EXPECT_NEAR(tests.back().width.at(0), std::sqrt(now / then), 1e-9);
}

// Of the modulus of another bar a new one tells nothing; of four strengths five are the mean.
TEST(NextTest, TellsNothingOfWhatIsAnotherSpecimensOwn) {
  auto study = test::synthetic_study({0.0, 0.0});
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  study.calibrate.level["young_GPa"] = Level::specimen;
  const auto result = test::fit(study);
  ASSERT_EQ(result.next_tests.size(), 1U);
  const std::vector<double>& width = result.next_tests[0].width;
  ASSERT_EQ(width.size(), 5U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(width[k], 1.0, 1e-9) << result.fitted[k];
  EXPECT_NEAR(width[4], std::sqrt(4.0 / 5.0), 1e-3);
}

// Nor of the ratio, where the threshold that acts with it is each specimen's own.
TEST(NextTest, TellsNothingThatItsOwnParametersFollow) {
  auto study = test::synthetic_study({0.0, 45.0});
  study.calibrate.parameters = {"head_tail_MPa", "ratio"};
  study.calibrate.level["head_tail_MPa"] = Level::specimen;
  const FitProblem problem = make_problem(study);
  SimulationBatch batch(test::ClosedForm{}.simulator(), nullptr, 1);
  Answer answer{.active = {0, 1, 2, 3, 4}, .replicates = 1};
  answer.weights.scatter.assign(4, Landmarks(Landmarks::Zero()));
  answer.slopes.jacobian = Eigen::MatrixXd::Zero(4 * landmark_count, 5);
  for (const std::size_t f : {0U, 1U, 2U, 3U}) {
    answer.slopes.jacobian(first_row(f) + strength, static_cast<Eigen::Index>(f)) = 50.0;
    answer.slopes.jacobian(first_row(f) + energy, 4) = 10.0;
    answer.slopes.jacobian(first_row(f) + strength, 4) = f < 2 ? 0.0 : -30.0;
  }
  const auto tests = next_tests(batch, problem, answer);
  ASSERT_EQ(tests.size(), 2U);
  for (const NextTest& test : tests)
    EXPECT_NEAR(test.width.at(4), std::sqrt(4.0 / 5.0), 1e-9) << test.what;
}

}  // namespace
}  // namespace havers::calib
