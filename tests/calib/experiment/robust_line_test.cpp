#include "calib/experiment/robust_line.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "calib/experiment/channel_noise.hpp"

namespace havers::calib {
namespace {

struct Points {
  std::vector<double> x, y;
};

// Stress of 13 GPa over strain, with noise. [-], [Pa]
Points noisy_line(double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Points points;
  for (int i = 0; i < 60; ++i) {
    points.x.push_back(1e-5 * i);
    points.y.push_back(13e9 * points.x.back() + 2e6 + noise * normal(random));
  }
  return points;
}

TEST(RobustLine, IsExactOnALine) {
  const Points points = noisy_line(0.0, 1);
  for (const Line& line :
       {fit_robust_line(points.x, points.y), fit_plain_line(points.x, points.y)}) {
    EXPECT_TRUE(line.fitted);
    EXPECT_NEAR(line.slope, 13e9, 1e-3);
    EXPECT_NEAR(line.intercept, 2e6, 1e-3);
    EXPECT_NEAR(line.slope_standard_error, 0.0, 1e-2);
  }
}

TEST(RobustLine, DoesNotCountSpikes) {
  Points points = noisy_line(1e4, 2);
  const double clean = fit_robust_line(points.x, points.y).slope;
  for (const std::size_t i : {5U, 40U, 55U}) points.y[i] += 5e6;
  EXPECT_NEAR(fit_robust_line(points.x, points.y).slope, clean, 0.005 * clean);
  EXPECT_GT(std::abs(fit_plain_line(points.x, points.y).slope - clean), 0.02 * clean);
}

// Of 1000 fits, 68 % within one standard error and 95 % within two, as far as 60 points can.
TEST(RobustLine, StatesItsErrorTruly) {
  int within_one = 0, within_two = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const Points points = noisy_line(1e5, seed);
    const Line line = fit_robust_line(points.x, points.y);
    const double error = std::abs(line.slope - 13e9) / line.slope_standard_error;
    within_one += error < 1.0 ? 1 : 0;
    within_two += error < 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(within_one, 683, 50);
  EXPECT_NEAR(within_two, 954, 30);
}

TEST(RobustLine, SaysWhenThereIsNone) {
  EXPECT_FALSE(fit_robust_line(std::vector{1.0, 2.0}, std::vector{1.0, 2.0}).fitted);
  EXPECT_FALSE(fit_robust_line(std::vector{1.0, 1.0, 1.0}, std::vector{1.0, 2.0, 3.0}).fitted);
  const Line flat = fit_robust_line(std::vector{1.0, 2.0, 3.0}, std::vector{4.0, 4.0, 4.0});
  EXPECT_TRUE(flat.fitted);
  EXPECT_EQ(flat.slope, 0.0);
  EXPECT_EQ(flat.intercept, 4.0);
}

TEST(ChannelNoise, IsThatOfTheSignalAndDeafToABreak) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 0.5);
  std::vector<double> force;
  for (int i = 0; i < 4000; ++i) force.push_back((i < 3900 ? 0.1 * i : 5.0) + normal(random));
  EXPECT_NEAR(noise_of(force), 0.5, 0.03);
}

TEST(ChannelNoise, RateIsDeafToAHold) {
  std::vector<double> strain, time;
  for (int i = 0; i < 400; ++i) {
    time.push_back(0.1 * i + (i > 200 ? 20.0 : 0.0));
    strain.push_back(1e-5 * i);
  }
  EXPECT_NEAR(median_rate(strain, time), 1e-4, 1e-12);
  EXPECT_EQ(median_rate(strain, std::vector<double>(strain.size(), 1.0)), 0.0);
}

TEST(ChannelNoise, MedianTakesTheMiddle) {
  EXPECT_EQ(median({}), 0.0);
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
}

}  // namespace
}  // namespace havers::calib
