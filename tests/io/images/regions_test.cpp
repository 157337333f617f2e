// Which part of an image is bone, and on which side of it pores are.
#include "io/images/regions.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "io/images/measure_section.hpp"
#include "tests/support/sections.hpp"
#include "tests/support/slow.hpp"

namespace havers::io {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

calib::SectionPorosity found_in(const cv::Mat& image, const SectionOptions& options = {}) {
  SectionOptions scaled = options;
  scaled.pixel_size = 2e-6;
  return measure_sections(test::write(image, "regions.png"), scaled).front().porosity;
}

double area_in_pixels(const calib::SectionPorosity& section) {
  return section.bone_area / 4e-12;
}

struct GreyLevels {
  const char* name;
  double bone, pore, background;
};

class OfAllLevels : public testing::TestWithParam<GreyLevels> {};
INSTANTIATE_TEST_SUITE_P(, OfAllLevels,
                         testing::Values(GreyLevels{"GreyOnBlackPoresBright", 0.5, 0.9, 0.1},
                                         GreyLevels{"GreyOnWhitePoresDark", 0.5, 0.1, 0.9},
                                         GreyLevels{"BrightOnBlackPoresDark", 0.9, 0.1, 0.1},
                                         GreyLevels{"DarkOnWhitePoresBright", 0.1, 0.9, 0.9},
                                         GreyLevels{"BrightOnGreyPoresDark", 0.9, 0.1, 0.5},
                                         GreyLevels{"DarkOnGreyPoresBright", 0.1, 0.9, 0.5}),
                         [](const auto& levels) { return levels.param.name; });

TEST_P(OfAllLevels, PoresAreFound) {
  HAVERS_SLOW;
  unsigned seed = 0;
  for (const test::Outline outline :
       {test::Outline::bar, test::Outline::tilted_bar, test::Outline::ring})
    for (const double porosity : {0.01, 0.05, 0.2})
      for (const int bits : {8, 16}) {
        const auto& [name, bone, pore, background] = GetParam();
        const auto drawn = test::draw({.outline = outline,
                                       .width = 520,
                                       .height = 440,
                                       .porosity = porosity,
                                       .largest_radius = ++seed % 2 == 0 ? 4.0 : 20.0,
                                       .bone = bone,
                                       .pore = pore,
                                       .background = background,
                                       .noise = 0.05,
                                       .blur = 1.0,
                                       .cupping = 0.1,
                                       .bits = bits,
                                       .seed = seed});
        const auto measured = found_in(drawn.image);
        EXPECT_NEAR(100.0 * measured.porosity, 100.0 * drawn.porosity, 0.3)
            << name << ", outline " << static_cast<int>(outline) << ", " << bits << " bit";
        const double area = cv::sum(drawn.bone)[0];
        EXPECT_NEAR(area_in_pixels(measured), area, 0.01 * area) << name;
      }
}

TEST(Sides, PoresUnlikeTheBackgroundAreSaid) {
  const auto drawn = test::draw({.bone = 0.5, .pore = 0.9, .background = 0.1, .blur = 0.7});
  const auto found = found_in(drawn.image);
  EXPECT_NEAR(found.porosity, drawn.porosity, 2e-3);
  EXPECT_THAT(found.warnings, Contains(HasSubstr("taken to be brighter than bone")));
  const auto told = found_in(drawn.image, {.pores = Pores::bright});
  EXPECT_NEAR(told.porosity, drawn.porosity, 2e-3);
  EXPECT_THAT(told.warnings, Not(Contains(HasSubstr("taken to be brighter than bone"))));
}

// Some canals are filled with a stain, some are not.
TEST(Sides, BothOfThemLeaveAWarning) {
  auto drawn = test::draw({.porosity = 0.0, .bone = 0.5, .pore = 0.1, .background = 0.1});
  for (int i = 0; i < 8; ++i) cv::circle(drawn.image, {150 + 50 * i, 200}, 15, 230, cv::FILLED);
  for (int i = 0; i < 4; ++i) cv::circle(drawn.image, {150 + 50 * i, 400}, 15, 26, cv::FILLED);
  const double area = cv::sum(drawn.bone)[0], disc = std::numbers::pi * 15.5 * 15.5;
  const auto measured = found_in(drawn.image);
  EXPECT_NEAR(measured.porosity, 8.0 * disc / area, 2e-3);
  EXPECT_THAT(measured.warnings, Contains(HasSubstr("% of the bone is as much darker")));
}

TEST(Sides, WithoutPoresAreSaidToHaveNone) {
  const auto measured = found_in(test::draw({.porosity = 0.0, .noise = 0.05, .blur = 1.0}).image);
  EXPECT_EQ(measured.porosity, 0.0);
  EXPECT_THAT(measured.warnings, Contains(HasSubstr("no pores were found")));
}

// Labels of three materials, as another program writes them.
TEST(Sides, OfThreeLabelsAreFound) {
  for (const auto& [background, bone, pore] :
       {std::array{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {1, 0, 2}}) {
    cv::Mat labels(400, 500, CV_8U, cv::Scalar(background));
    const cv::Rect bar(50, 70, 400, 260);
    labels(bar).setTo(bone);
    for (int i = 0; i < 12; ++i)
      cv::circle(labels, {100 + 60 * (i % 6), 150 + 100 * (i / 6)}, 14, pore, cv::FILLED);
    const double truth = cv::countNonZero(labels(bar) == pore) / static_cast<double>(bar.area());
    const auto measured = found_in(labels);
    EXPECT_NEAR(measured.porosity, truth, 1e-3) << background << bone << pore;
    EXPECT_NEAR(area_in_pixels(measured), bar.area(), 0.01 * bar.area());
  }
}

struct Narrow {
  int width, height;
  double bar_height;
};

// Bars of 1:1 to 1:30 in images as narrow, and in wide ones.
TEST(NarrowBar, IsMeasuredAsItIs) {
  HAVERS_SLOW;
  unsigned seed = 0;
  for (const auto& [width, height, bar_height] : {Narrow{800, 800, 0.8},
                                                  {1000, 200, 0.5},
                                                  {1500, 100, 0.7},
                                                  {3000, 120, 0.7},
                                                  {4000, 150, 0.5},
                                                  {1000, 1000, 0.08},
                                                  {1000, 1000, 0.05}})
    for (const bool bright : {false, true})
      for (const double pore : {0.2, 0.9}) {
        const auto drawn = test::draw({.width = width,
                                       .height = height,
                                       .bar_height = bar_height,
                                       .porosity = 0.06,
                                       .largest_radius = 6.0,
                                       .bone = pore > 0.5 ? 0.5 : 0.8,
                                       .pore = pore,
                                       .noise = 0.05,
                                       .blur = 0.8,
                                       .bright_pores = bright,
                                       .seed = ++seed});
        const auto measured = found_in(drawn.image);
        EXPECT_NEAR(100.0 * measured.porosity, 100.0 * drawn.porosity, 0.3)
            << width << " x " << height << ", bar " << bar_height << ", pores " << pore << bright;
      }
}

// Pores as small as this are gone on the small copy, where whole grey levels of quiet bone would be
// two levels.
TEST(Bone, OfLittleNoiseIsNotDivided) {
  for (const double pore : {0.1, 0.5}) {
    const auto drawn = test::draw({.outline = test::Outline::filled,
                                   .porosity = 0.01,
                                   .bone = 0.8,
                                   .pore = pore,
                                   .noise = 0.03,
                                   .blur = 0.8});
    const auto measured = found_in(drawn.image);
    EXPECT_NEAR(100.0 * measured.porosity, 100.0 * drawn.porosity, 0.1) << pore;
    EXPECT_NEAR(area_in_pixels(measured), 700.0 * 600.0, 1.0);
  }
}

// A ring has a marrow cavity, a sawn bar has not.
TEST(Bone, OfABarHasItsLargestPoreCounted) {
  auto drawn = test::draw({.porosity = 0.0});
  cv::circle(drawn.image, {350, 300}, 100, 51, cv::FILLED);
  const auto measured = found_in(drawn.image);
  EXPECT_NEAR(measured.porosity, std::numbers::pi * 1e4 / cv::sum(drawn.bone)[0], 3e-3);
  EXPECT_THAT(measured.warnings, Contains(HasSubstr("marrow cavity")));
}

// Above a tenth of what the outline encloses, the marrow is none of the bone.
TEST(Bone, HasNoMarrowBelowATenthOfIt) {
  for (const bool marrow : {false, true}) {
    cv::Mat image(600, 700, CV_8U, cv::Scalar(51));
    cv::circle(image, {350, 300}, 270, 204, cv::FILLED);
    const double whole = cv::countNonZero(image == 204);
    cv::circle(image, {350, 300}, marrow ? 90 : 80, 51, cv::FILLED);  // 11.1 and 8.8 %
    const double solid = cv::countNonZero(image == 204);
    const auto measured = found_in(image);
    EXPECT_NEAR(measured.porosity, marrow ? 0.0 : 1.0 - solid / whole, 1e-3);
    EXPECT_NEAR(area_in_pixels(measured), marrow ? solid : whole, 2e-3 * whole);
  }
}

// A section cut by three sides of the image: bone has most of the frame, and the pores.
TEST(Bone, OnMostOfTheFrameIsToldByItsPores) {
  for (const bool negative : {false, true})
    for (const double background : {0.2, 0.05, 0.5}) {
      auto drawn = test::draw({.outline = test::Outline::filled,
                               .porosity = 0.08,
                               .largest_radius = 12.0,
                               .noise = 0.04,
                               .blur = 0.7});
      cv::Mat resin = drawn.image.colRange(500, 700);
      cv::theRNG().state = 1;
      cv::randn(resin, 255.0 * background, 5.0);
      const double truth = cv::mean(drawn.pores.colRange(0, 500))[0];
      if (negative) drawn.image = 255 - drawn.image;
      const auto measured = found_in(drawn.image);
      EXPECT_NEAR(100.0 * measured.porosity, 100.0 * truth, 0.3) << background << negative;
      EXPECT_FALSE(measured.doubtful) << background << negative;
    }
}

TEST(Bone, OnMostOfTheFrameWithoutPoresIsInDoubt) {
  auto drawn = test::draw({.outline = test::Outline::filled, .porosity = 0.0, .noise = 0.04});
  drawn.image.colRange(500, 700).setTo(51);
  const auto measured = found_in(drawn.image);
  EXPECT_THAT(measured.warnings, Contains(HasSubstr("pores do not tell them apart")));
  const auto told = found_in(drawn.image, {.pores = Pores::dark});
  EXPECT_NEAR(area_in_pixels(told), 500.0 * 600.0, 2000.0);
}

// A natural surface is wavy: what lies between its crests is no pore.
TEST(Bone, WithWavesIsNoMachinedBar) {
  auto drawn = test::draw({.outline = test::Outline::filled, .porosity = 0.0});
  for (int x = 0; x < 700; ++x) {
    const int wave = static_cast<int>(std::lround(20.0 * std::sin(x / 20.0)));
    drawn.image.col(x).rowRange(0, 80 + wave).setTo(51);
    drawn.image.col(x).rowRange(520 + wave, 600).setTo(51);
  }
  cv::Mat pores = cv::Mat::zeros(drawn.image.size(), CV_8U);
  for (int i = 0; i < 24; ++i)
    cv::circle(pores, {80 + 100 * (i % 6), 170 + 80 * (i / 6)}, 15, 255, cv::FILLED);
  drawn.image.setTo(51, pores);
  const double truth = cv::countNonZero(pores) / (700.0 * 440.0);
  EXPECT_NEAR(found_in(drawn.image).porosity, truth, 1e-3);
}

TEST(Bone, WithoutABackgroundIsSaidToFillTheImage) {
  const auto drawn = test::draw({.outline = test::Outline::filled, .blur = 1.0});
  const auto found = found_in(drawn.image), told = found_in(drawn.image, {.fills_image = true});
  EXPECT_THAT(found.warnings, Contains(HasSubstr("bone is taken to fill the image")));
  EXPECT_THAT(told.warnings, Not(Contains(HasSubstr("bone is taken to fill the image"))));
  EXPECT_EQ(found.porosity, told.porosity);
}

}  // namespace
}  // namespace havers::io
