#include "calib/experiment/robust_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "calib/experiment/channel_noise.hpp"
#include "tests/support/slow.hpp"

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
  HAVERS_SLOW;
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

// A long record is fitted by the means of its rows; nothing is lost by it.
TEST(RobustLine, UsesEveryRowOfALongRecord) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0.0, 0.1);
  constexpr int rows = 100'000;
  Points points;
  for (int i = 0; i < rows; ++i) {
    points.x.push_back(1.0 * i / rows);
    points.y.push_back(3.0 * points.x.back() + normal(random));
  }
  const double standard_error = 0.1 / std::sqrt(rows / 12.0);  // σ / √Σ(x − x̄)²
  for (const Line& line :
       {fit_robust_line(points.x, points.y), fit_plain_line(points.x, points.y)}) {
    EXPECT_NEAR(line.slope, 3.0, 3.0 * standard_error);
    EXPECT_NEAR(line.slope_standard_error, standard_error, 0.05 * standard_error);
  }
}

// Norris of the NIST Statistical Reference Datasets (itl.nist.gov/div898/strd), linear regression,
// with its certified values.
TEST(RobustLine, AgreesWithTheReferenceOfNist) {
  const std::vector x{0.2,   337.4, 118.2, 884.6, 10.1,  226.5, 666.3, 996.3, 448.6,
                      777.0, 558.2, 0.4,   0.6,   775.5, 666.9, 338.0, 447.5, 11.6,
                      556.0, 228.1, 995.8, 887.6, 120.2, 0.3,   0.3,   556.8, 339.1,
                      887.2, 999.0, 779.0, 11.1,  118.3, 229.2, 669.1, 448.9, 0.5};
  const std::vector y{0.1,   338.8, 118.1, 888.0, 9.2,   228.1, 668.5, 998.5, 449.1,
                      778.9, 559.2, 0.3,   0.1,   778.1, 668.8, 339.3, 448.9, 10.8,
                      557.7, 228.3, 998.0, 888.8, 119.6, 0.3,   0.6,   557.6, 339.3,
                      888.0, 998.5, 778.9, 10.2,  117.6, 228.9, 668.4, 449.2, 0.2};
  const Line plain = fit_plain_line(x, y);
  EXPECT_NEAR(plain.slope, 1.00211681802045, 1e-13);
  EXPECT_NEAR(plain.intercept, -0.262323073774029, 1e-12);
  EXPECT_NEAR(plain.slope_standard_error, 0.429796848199937e-3, 1e-13);
  const Line robust = fit_robust_line(x, y);
  EXPECT_NEAR(robust.slope, plain.slope, 2.0 * plain.slope_standard_error);
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
  EXPECT_NEAR(loading_rate(strain, time), 1e-4, 1e-12);
  EXPECT_EQ(loading_rate(strain, std::vector<double>(strain.size(), 1.0)), 0.0);
}

// A record may begin long before the loading, and be as long at rest between cycles of preload.
TEST(ChannelNoise, RateIsThatOfTheLoadingHoweverLongTheMachineWaits) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 2e-6);
  std::vector<double> strain, time;
  const auto add = [&](int rows, double from, double to) {
    for (int i = 0; i < rows; ++i) {
      time.push_back(0.01 * static_cast<double>(time.size()));
      strain.push_back(from + (to - from) * i / rows + noise(random));
    }
  };
  add(3000, 0.0, 0.0);
  for (int cycle = 0; cycle < 3; ++cycle) {
    add(200, 0.0, 4e-4);
    add(200, 4e-4, 0.0);
  }
  add(500, 0.0, 5e-3);
  EXPECT_NEAR(loading_rate(strain, time), 1e-3, 1e-5);
}

// Of a fast test there may be fewer rows than steps.
TEST(ChannelNoise, RateOfFewRowsIsTheirs) {
  EXPECT_NEAR(loading_rate(std::vector{0.0, 0.001, 0.002, 0.003}, std::vector{1.0, 2.0, 3.0, 4.0}),
              1e-3, 1e-15);
  EXPECT_EQ(loading_rate(std::vector{0.0, -1.0}, std::vector{1.0, 2.0}), 0.0);
  EXPECT_EQ(loading_rate({}, {}), 0.0);
}

TEST(ChannelNoise, MedianTakesTheMiddle) {
  EXPECT_EQ(median({}), 0.0);
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
}

}  // namespace
}  // namespace havers::calib
