// Residuals that follow porosity reject the model, and those of a true one do not.
#include "calib/fit/porosity_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/slow.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

using test::check_of;
using test::says;

// Of the six sample bars.
constexpr std::array<double, 6> porosities{0.024, 0.061, 0.038, 0.079, 0.031, 0.087};

// Residuals of a true model with one or two parameters, the noise of two specimens each `noise`.
PorositySample true_sample(const std::array<double, 3>& noise, double between, int parameters,
                           std::mt19937& random) {
  std::normal_distribution<double> normal;
  PorositySample sample{Eigen::VectorXd(6), Eigen::VectorXd(6), Eigen::VectorXd(6),
                        Eigen::MatrixXd::Zero(6, parameters)};
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double sd = noise.at(static_cast<std::size_t>(i / 2));
    sample.variance[i] = sd * sd;
    sample.porosity[i] = porosities.at(static_cast<std::size_t>(i));
    sample.difference[i] = std::hypot(sd, between) * normal(random);
    sample.slopes(i, 0) = 1.0;
    if (parameters > 1 && i > 1 && i < 4) sample.slopes(i, 1) = -0.6;  // the ratio, at 45 degrees
  }
  return sample;
}

// Shares of true models whose chance is said to be below 1 and 5 %.
std::array<double, 2> shares_below(const std::array<double, 3>& noise, double between,
                                   int parameters) {
  constexpr int draws = 1000;
  std::mt19937 random(1);
  std::array<double, 2> below{};
  for (int i = 0; i < draws; ++i) {
    const auto trend = porosity_trend(true_sample(noise, between, parameters, random)).value();
    below[0] += trend.chance < 0.01 ? 1.0 / draws : 0.0;
    below[1] += trend.chance < 0.05 ? 1.0 / draws : 0.0;
  }
  return below;
}

// Strengths are known to 7, 4 and 0.3 %, moduli alike; specimens are alike, or 0.3 to 10 % apart.
TEST(PorosityTrend, IsAsRareInTrueModelsAsItSays) {
  HAVERS_SLOW;
  for (const double between : {0.0, 0.003, 0.03, 0.1}) {
    const auto [at_1, at_5] = shares_below({0.07, 0.04, 0.003}, between, 2);
    EXPECT_LT(at_1, 0.02) << between;  // 0.01 and three standard errors
    EXPECT_LT(at_5, 0.071) << between;
  }
  const auto [at_1, at_5] = shares_below({0.002, 0.002, 0.002}, 0.1, 1);
  EXPECT_LT(at_1, 0.02);
  EXPECT_GT(at_5, 0.03);  // and no rarer, where all are known alike
}

TEST(PorosityTrend, FindsTheSlopeBesideWhatTheParametersMakeUpFor) {
  std::mt19937 random(2);
  PorositySample sample = true_sample({0.002, 0.002, 0.002}, 0.0, 2, random);
  for (const Eigen::Index i : {2, 3}) sample.difference[i] += 0.5;
  sample.difference.array() += 0.3 - 2.7 * sample.porosity.array();
  const auto trend = porosity_trend(sample).value();
  EXPECT_NEAR(trend.slope, -2.7, 0.2);
  EXPECT_LT(trend.chance, 1e-3);
  sample.porosity.setConstant(0.05);
  EXPECT_FALSE(porosity_trend(sample));
}

// Two bars each at 0, 45 and 90 degrees, of known porosity.
Study study_of_porous_bars(double specimen_effect = 0.0, unsigned draw = 1) {
  Study study =
      test::synthetic_study(test::three_orientations, {.specimen_effect = specimen_effect}, draw);
  for (std::size_t s = 0; s < study.specimens.size(); ++s)
    study.specimens[s].porosity = porosities.at(s);
  return study;
}

Check porosity_check_of(const Study& study) {
  return check_of(test::fit(study), "residuals and porosity");
}

// (1−p)^2.7 makes the moduli differ by 17 %, those measured are alike.
TEST(Verdict, RejectsALawOfPorosityThatTheModuliDoNotFollow) {
  Study study = study_of_porous_bars();
  const Check alike = porosity_check_of(study);
  EXPECT_EQ(alike.outcome, Outcome::pass);
  EXPECT_TRUE(says(alike, "Residuals do not follow porosity (modulus: p = 0."));
  study.porosity.to_modulus = ToModulus::power;
  const auto result = test::fit(study);
  const Check check = check_of(result, "residuals and porosity");
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_FALSE(result.trusted());
  EXPECT_TRUE(says(check, "the simulated moduli fall by 2.")) << check.text;
  EXPECT_TRUE(says(check, "Leave it out (porosity.to_modulus = \"none\")")) << check.text;
  study.calibrate.parameters.emplace_back("modulus_exponent");  // takes what a trend could
  const Check fitted = porosity_check_of(study);
  EXPECT_EQ(fitted.outcome, Outcome::pass) << fitted.text;
}

TEST(Verdict, AsksForALawOfPorosityWhereOneIsMissing) {
  Study study = study_of_porous_bars();
  const auto follow = [&](double exponent) {
    for (Specimen& specimen : study.specimens) {
      const double factor = std::pow(1.0 - *specimen.porosity, exponent);
      specimen.test =
          test::straight_test(factor * specimen.test.modulus, factor * specimen.test.strength);
    }
  };
  follow(2.7);
  study.porosity.to_scatter = ToScatter::none;
  const Check check = porosity_check_of(study);
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_TRUE(says(check, "Give it a law (porosity.to_modulus = \"power\")")) << check.text;
  EXPECT_TRUE(says(check, "Give it a law (porosity.to_scatter = \"window\")")) << check.text;
  follow(-5.4);
  EXPECT_TRUE(says(porosity_check_of(study), "Are sections exchanged")) << check.text;
}

TEST(Verdict, RejectsFewTrueModelsByPorosity) {
  HAVERS_SLOW;
  int rejected = 0;
  for (unsigned draw = 1; draw <= 40; ++draw) {
    const Study study = study_of_porous_bars(draw % 2 == 0 ? 0.05 : 0.0, draw);
    rejected += porosity_check_of(study).outcome == Outcome::fail ? 1 : 0;
  }
  EXPECT_LE(rejected, 2);  // where 1 % are, three of 40 are once in 130 times
}

TEST(Verdict, LeavesPorosityUncheckedWhereItIsNotKnown) {
  Study study = study_of_porous_bars();
  for (Specimen& specimen : study.specimens) specimen.porosity.reset();
  const Check check = porosity_check_of(study);
  EXPECT_EQ(check.outcome, Outcome::pass);
  EXPECT_FALSE(check.done);
  EXPECT_TRUE(says(check, "Not checked: ")) << check.text;
}

}  // namespace
}  // namespace havers::calib
