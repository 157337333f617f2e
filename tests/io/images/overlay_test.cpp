// The pictures of a section: what was found, drawn into it, and its histogram of depths.
#include "io/images/overlay.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "io/images/measure_section.hpp"
#include "tests/support/sections.hpp"

namespace havers::io {
namespace {

using test::pixel;

TEST(Overlay, ShowsPoresInASmallPicture) {
  const auto drawn =
      test::draw({.width = 1400, .height = 900, .largest_radius = 20.0, .noise = 0.1});
  const auto png = measure_sections(test::write(drawn.image, "overlay.png"), {.pixel_size = pixel})
                       .front()
                       .overlay_png;
  const cv::Mat overlay = cv::imdecode(png, cv::IMREAD_COLOR);
  ASSERT_EQ(overlay.cols, 467);  // a third: whole pixels become one, at most 640
  EXPECT_LT(png.size(), 200000U);
  cv::Mat red;
  cv::inRange(overlay, cv::Scalar(48, 48, 224), cv::Scalar(48, 48, 224), red);
  const double scale = 1.0 / 3.0;
  EXPECT_NEAR(cv::countNonZero(red), scale * scale * cv::sum(drawn.pores)[0],
              0.1 * cv::countNonZero(red));
}

// Red pores, yellow cracks, a blue outline; one pixel each, as the image is small.
TEST(Overlay, HasAColourForEachThing) {
  auto drawn = test::draw({.width = 600, .height = 500, .porosity = 0.0});
  drawn.image(cv::Rect(150, 150, 200, 5)).setTo(51);
  cv::circle(drawn.image, {300, 300}, 20, 51, cv::FILLED);
  const auto found = measure_sections(test::write(drawn.image, "colours.png"), {}).front();
  const cv::Mat overlay = cv::imdecode(found.overlay_png, cv::IMREAD_COLOR);
  ASSERT_EQ(overlay.size(), drawn.image.size());
  const auto colour_at = [&](int x, int y) {
    const auto& c = overlay.at<cv::Vec3b>(y, x);
    return std::vector<int>{c[2], c[1], c[0]};  // red, green, blue
  };
  const std::vector<int> red{224, 48, 48}, yellow{240, 208, 32}, blue{0, 128, 224};
  EXPECT_EQ(colour_at(300, 300), red);
  EXPECT_EQ(colour_at(250, 152), yellow);
  EXPECT_EQ(colour_at(60, 250), blue) << "the bar's left side";
  EXPECT_EQ(colour_at(539, 250), blue) << "the bar's right side";
}

// Bone lies about depth 0, pores about 1; what is deeper than the threshold is the porosity.
TEST(Histogram, IsOfTheDepthsOfBoneAndPores) {
  const auto drawn = test::draw({.porosity = 0.1, .largest_radius = 15.0, .noise = 0.02});
  const auto found = measure_sections(test::write(drawn.image, "depths.png"), {}).front();
  const auto& [depth, share, threshold] = found.histogram;
  ASSERT_EQ(depth.size(), share.size());
  EXPECT_EQ(threshold, found.porosity.threshold);
  double all = 0.0, deep = 0.0, bone = 0.0, pores = 0.0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    all += share[i];
    deep += depth[i] > threshold ? share[i] : 0.0;
    bone += std::abs(depth[i]) < 0.1 ? share[i] : 0.0;
    pores += std::abs(depth[i] - 1.0) < 0.1 ? share[i] : 0.0;
  }
  EXPECT_NEAR(all, 1.0, 1e-9);
  EXPECT_NEAR(deep, drawn.porosity, 5e-3);
  // The pores' borders lie between the two.
  EXPECT_NEAR(bone, 1.0 - drawn.porosity, 0.02);
  EXPECT_GT(pores, 0.7 * drawn.porosity);
}

}  // namespace
}  // namespace havers::io
