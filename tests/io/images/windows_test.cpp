// Windows over pore images whose variance is known exactly.
#include "io/images/windows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "calib/porosity/scatter_map.hpp"

namespace havers::images {
namespace {

cv::Mat full(int side) {
  return {side, side, CV_8U, cv::Scalar(255)};
}

cv::Mat independent_pixels(int side, double p, unsigned seed = 5) {
  std::mt19937_64 random(seed);
  cv::Mat pores(side, side, CV_8U);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      pores.at<std::uint8_t>(y, x) = static_cast<double>(random() >> 11U) * 0x1p-53 < p ? 255 : 0;
  return pores;
}

// Independent pixels: the variance of a mean of n is p(1−p)/n.
TEST(Windows, AverageIndependentPixels) {
  const double p = 0.1;
  const auto spread = window_spread(full(1500), independent_pixels(1500, p), 10.0, 4.0);
  const double expected = std::sqrt(p * (1.0 - p) / 40.0);
  EXPECT_NEAR(spread.sd, expected, 0.01 * expected);
  EXPECT_NEAR(spread.sd, expected, 4.0 * spread.standard_error);
}

// A side of 2.5 pixels weighs them 1, 1 and ½: the variance falls by (1+1+¼)/2.5² a side.
TEST(Windows, CountFractionsOfPixels) {
  const double p = 0.3, per_side = 2.25 / 6.25;
  const auto spread = window_spread(full(1000), independent_pixels(1000, p), 2.5, 2.5);
  EXPECT_NEAR(spread.sd, std::sqrt(p * (1.0 - p)) * per_side, 0.003);
}

// A window smaller than a pixel sees pore or bone.
TEST(Windows, SmallerThanAPixelSeeTheCoin) {
  const auto spread = window_spread(full(600), independent_pixels(600, 0.2), 0.5, 0.25);
  EXPECT_NEAR(spread.sd, 0.4, 0.004);
}

TEST(Windows, LargerThanAnyImageSeeNothing) {
  const cv::Mat bone = full(100);
  for (const double length : {101.0, 1e6, 1e12, 1e300})
    EXPECT_TRUE(std::isnan(window_spread(bone, bone, length, length).sd)) << length;
}

// Left half pores: windows well away from the border are all or nothing, and those that lie across
// it rise linearly. Written out for a window of 10 × 10 in 100 × 100: SD² = E[q²] − E[q]².
TEST(Windows, SeeASharpBorderAsALinearRise) {
  cv::Mat pores = cv::Mat::zeros(100, 100, CV_8U);
  pores.colRange(0, 50).setTo(255);
  double n = 0.0, q = 0.0, qq = 0.0;
  for (int x = 0; x <= 90; x += 5) {
    const double local = std::clamp(50.0 - x, 0.0, 10.0) / 10.0;
    n += 1.0, q += local, qq += local * local;
  }
  const double expected = std::sqrt(qq / n - q * q / n / n);
  EXPECT_NEAR(window_spread(full(100), pores, 10.0, 10.0).sd, expected, 1e-12);
}

TEST(Windows, LieWhollyInsideTheBone) {
  cv::Mat bone = cv::Mat::zeros(100, 100, CV_8U), pores = bone.clone();
  bone(cv::Rect(20, 20, 60, 60)).setTo(255);
  EXPECT_EQ(window_spread(bone, pores, 30.0, 5.0).sd, 0.0);
  EXPECT_TRUE(std::isnan(window_spread(bone, pores, 61.0, 5.0).sd));
  EXPECT_TRUE(std::isnan(window_spread(bone, pores, 300.0, 5.0).sd));
  // Pores outside the bone do not count.
  pores(cv::Rect(0, 0, 100, 20)).setTo(255);
  EXPECT_EQ(window_spread(bone, pores, 30.0, 5.0).sd, 0.0);
}

// (K2) against pores placed independently, which is what it describes: for window areas from less
// to much more than a pore's.
TEST(Windows, FollowTheClosedFormOfIndependentPores) {
  const int side = 3000;
  const double radius = 8.0;
  std::mt19937_64 random(8);
  cv::Mat pores = cv::Mat::zeros(side, side, CV_8U);
  for (int i = 0; i < 2000; ++i)
    cv::circle(pores, {static_cast<int>(random() % side), static_cast<int>(random() % side)},
               static_cast<int>(radius), 255, cv::FILLED);
  const double porosity = cv::countNonZero(pores) / static_cast<double>(side) / side;
  cv::Mat labels;
  cv::Mat stats, centroids;
  const int objects = cv::connectedComponentsWithStats(pores, labels, stats, centroids);
  double area = 0.0, squared = 0.0;
  for (int i = 1; i < objects; ++i) {
    const double a = stats.at<int>(i, cv::CC_STAT_AREA);
    area += a, squared += a * a;
  }
  for (const double window : {4.0, 15.0, 60.0}) {
    const double measured = window_spread(full(side), pores, window, window).sd;
    const double closed =
        std::sqrt(porosity * (1.0 - porosity) / (1.0 + window * window / (squared / area)));
    EXPECT_NEAR(measured, closed, 0.15 * closed) << "window of " << window << " px";
  }
}

// Across stripes of 5 pixels a lying window of 10 × 1 sees one half everywhere, a standing one of
// 1 × 10 all or nothing; there are as many of either.
TEST(Windows, LieAndStand) {
  cv::Mat stripes = cv::Mat::zeros(100, 100, CV_8U);
  for (int x = 0; x < 100; x += 10) stripes.colRange(x, x + 5).setTo(255);
  EXPECT_NEAR(window_spread(full(100), stripes, 10.0, 1.0).sd, std::sqrt(0.5 * 0.25), 1e-12);
  EXPECT_NEAR(window_spread(full(100), stripes.t(), 10.0, 1.0).sd, std::sqrt(0.125), 1e-12);
}

// Root mean square over many images of independent pixels.
double mean_error(double (*error_in)(const cv::Mat& pores)) {
  constexpr unsigned images = 1000;
  double squares = 0.0;
  for (unsigned seed = 1; seed <= images; ++seed)
    squares += std::pow(error_in(independent_pixels(24, 0.2, seed)), 2);
  return std::sqrt(squares / images);
}

// Of n pixels the mean errs by √(p(1−p)/n). Sixteen blocks know that to some 18 %, a thousand
// images to 0.6 %; n in place of n − 1 blocks would make it 3 % less.
TEST(PorosityStandardError, IsThatOfIndependentBlocks) {
  const double found =
      mean_error([](const cv::Mat& pores) { return porosity_standard_error(full(24), pores); });
  const double expected = std::sqrt(0.2 * 0.8) / 24.0;
  EXPECT_NEAR(found, expected, 0.015 * expected);
  EXPECT_EQ(porosity_standard_error(full(24), cv::Mat::zeros(24, 24, CV_8U)), 0.0);
}

// Windows of one pixel have the variance p(1−p), whose slope is 1−2p: the SD errs by half of
// (1−2p)/√n.
TEST(Windows, KnowTheErrorOfTheirSpread) {
  const double found = mean_error(
      [](const cv::Mat& pores) { return window_spread(full(24), pores, 1.0, 1.0).standard_error; });
  const double expected = 0.5 * 0.6 / 24.0;
  EXPECT_NEAR(found, expected, 0.02 * expected);
}

}  // namespace
}  // namespace havers::images
