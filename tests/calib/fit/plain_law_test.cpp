#include "calib/fit/plain_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace havers::calib {
namespace {

// n ln(RSS/n) + 2k + 2k(k+1)/(n−k−1), by hand: 10 ln(0.1) + 6 + 24/6 with k = 3.
TEST(PlainLaw, ComputesTheCorrectedCriterionOfAkaike) {
  EXPECT_NEAR(aicc(1.0, 10.0, 2.0), 10.0 * std::log(0.1) + 6.0 + 4.0, 1e-12);
  EXPECT_TRUE(std::isinf(aicc(1.0, 4.0, 3.0)));
}

std::vector<Broken> strengths(double slope, double noise, double model_bias) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<Broken> specimens;
  for (int i = 0; i < 30; ++i) {
    const double orientation = 0.7 * (i % 3), scatter = 0.2 + 0.02 * i;
    const double truth = 18.0 - orientation - slope * scatter;
    specimens.push_back({orientation, scatter, 1.0, truth + noise * normal(random),
                         truth + (i % 3 == 1 ? model_bias : 0.0)});
  }
  return specimens;
}

TEST(PlainLaw, FindsTheSlopeInTheScatterWhereThereIsOne) {
  EXPECT_EQ(best_plain_law(strengths(0.5, 0.02, 0.0), 2.0).name,
            "one strength per orientation, falling with the scatter");
  EXPECT_EQ(best_plain_law(strengths(0.0, 0.02, 0.0), 2.0).name, "one strength per orientation");
}

// Six is where the verdict rejects: chance alone rarely gets there.
TEST(PlainLaw, DoesNotRejectAModelThatIsTrueAndRejectsOneThatIsNot) {
  const PlainLaw loses = best_plain_law(strengths(0.5, 0.02, 0.0), 2.0);
  EXPECT_GT(loses.criterion, loses.model_criterion - 6.0);
  const PlainLaw wins = best_plain_law(strengths(0.5, 0.02, 0.2), 2.0);
  EXPECT_LT(wins.criterion, wins.model_criterion - 6.0);
}

// Laws of another modulus and unit of strength: a factor is free, the shape is not.
TEST(PlainLaw, TakesASweepsLawsWhereTheyHold) {
  const std::vector<SweepLaw> laws{
      {"assembly.orientation_deg", 0.0, {"joints.scatter"}, {-20e6, 60e6}},
      {"assembly.orientation_deg", 90.0, {"joints.ratio", "joints.scatter"}, {2e6, -5e6, 10e6}}};
  const double across = std::numbers::pi / 2.0;
  EXPECT_DOUBLE_EQ(strength_by(laws, {0.0, 0.5}), 50e6);
  EXPECT_DOUBLE_EQ(strength_by(laws, {across, 0.4, 3.0}), 14e6);
  EXPECT_DOUBLE_EQ(strength_by(laws, {-across, 0.4, 3.0}), 14e6) << "a mirror image";
  EXPECT_TRUE(std::isnan(strength_by(laws, {0.7, 0.5})));

  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<Broken> specimens;
  for (int i = 0; i < 10; ++i) {
    Broken one{i % 2 == 0 ? 0.0 : across, 0.2 + 0.06 * i, 2.0};
    one.strength = one.model = std::log(1.7 * strength_by(laws, one)) + 0.01 * normal(random);
    one.model += 0.05 * normal(random);
    specimens.push_back(one);
  }
  const PlainLaw best = best_plain_law(specimens, 2.0, laws);
  EXPECT_EQ(best.name, "the sweep's laws times a factor");
  EXPECT_LT(best.criterion, best.model_criterion - 6.0);
  specimens.front().orientation = 0.7;
  EXPECT_TRUE(best.laws_compared);
  EXPECT_FALSE(best_plain_law(specimens, 2.0, laws).laws_compared) << "none at 0.7 rad";
  EXPECT_NE(best_plain_law(specimens, 2.0, laws).name, best.name);
}

TEST(PlainLaw, TakesTheLawOfTheNearestRatio) {
  const std::vector<SweepLaw> laws{{"joints.ratio", 0.333, {}, {1e6}},
                                   {"joints.ratio", 3.0, {}, {2e6}}};
  EXPECT_EQ(strength_by(laws, {0.0, 0.2, 0.5}), 1e6);
  EXPECT_EQ(strength_by(laws, {0.0, 0.2, 1.5}), 2e6);
}

TEST(Weibull, FindsItsModulusAgain) {
  std::mt19937_64 random(7);
  std::weibull_distribution<double> draw(12.0, 80e6);
  std::vector<double> values;
  for (int i = 0; i < 4000; ++i) values.push_back(draw(random));
  const Weibull found = weibull(values);
  const double error = std::sqrt(6.0 / 4000.0) / std::numbers::pi;  // as of ever more values
  EXPECT_NEAR(found.modulus, 12.0, 3.0 * 12.0 * error);
  EXPECT_NEAR(found.unbiased, found.modulus, 1e-3 * found.modulus);
  EXPECT_NEAR(std::log(found.interval_95[1] / found.interval_95[0]), 2.0 * 1.96 * error,
              0.01 * error);
}

// 95 and 50 % of 2000 samples, within three standard errors of such counts.
TEST(Weibull, KnowsHowWellFewValuesTellIt) {
  std::mt19937_64 random(11);
  std::weibull_distribution<double> draw(8.0, 60e6);
  for (const std::size_t n : {5U, 6U, 10U, 20U}) {
    int inside = 0, above = 0;
    for (int sample = 0; sample < 2000; ++sample) {
      std::vector<double> values(n);
      for (double& value : values) value = draw(random);
      const Weibull found = weibull(values);
      inside += found.interval_95[0] <= 8.0 && 8.0 <= found.interval_95[1] ? 1 : 0;
      above += found.unbiased > 8.0 ? 1 : 0;
    }
    EXPECT_NEAR(inside, 1900, 3.0 * std::sqrt(2000.0 * 0.95 * 0.05)) << n;
    EXPECT_NEAR(above, 1000, 3.0 * std::sqrt(2000.0 * 0.25)) << n;
  }
}

}  // namespace
}  // namespace havers::calib
