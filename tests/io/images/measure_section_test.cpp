// Sections of known porosity, through every hardship that a laboratory's images have.
#include "io/images/measure_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/images/windows.hpp"
#include "tests/support/sections.hpp"
#include "tests/support/slow.hpp"

namespace havers::io {
namespace {

using test::measure;
using test::Outline;
using test::pixel;
using test::SectionTruth;
struct Hardship {
  const char* name;
  SectionTruth section;
};

const std::vector<Hardship>& hardships() {
  static const std::vector<Hardship> all{
      {"Blur", {.noise = 0.05, .blur = 1.5}},
      {"BlurWithoutNoise", {.noise = 0.02, .blur = 1.5}},
      {"Noise", {.noise = 0.25, .blur = 0.7}},
      {"Cupping", {.noise = 0.05, .blur = 1.0, .cupping = 0.4}},
      {"LowContrastUnderCupping",
       {.pore = 0.55, .background = 0.55, .noise = 0.1, .blur = 1.0, .cupping = 0.4}},
      {"NegativeUnderCupping", {.noise = 0.1, .blur = 0.8, .cupping = 0.4, .bright_pores = true}},
      {"SixteenBitNarrow",
       {.bone = 0.3, .pore = 0.28, .background = 0.28, .noise = 0.1, .blur = 1.2, .bits = 16}},
      {"Stain", {.noise = 0.1, .blur = 1.0, .cupping = 0.2, .colour = true}},
      {"BackgroundDarkerThanPores",
       {.pore = 0.3, .background = 0.05, .noise = 0.1, .blur = 1.0, .cupping = 0.3}},
  };
  return all;
}

class UnderHardship : public testing::TestWithParam<Hardship> {};
INSTANTIATE_TEST_SUITE_P(, UnderHardship, testing::ValuesIn(hardships()),
                         [](const auto& hardship) { return hardship.param.name; });

void expect_porosity_within(double points, SectionTruth section, const std::string& name) {
  const test::DrawnSection drawn = test::draw(section);
  const calib::SectionPorosity measured = measure(drawn, name + ".png");
  EXPECT_NEAR(100.0 * measured.porosity, 100.0 * drawn.porosity, points)
      << "outline " << static_cast<int>(section.outline) << ", radius " << section.smallest_radius
      << " to " << section.largest_radius;
}

TEST_P(UnderHardship, PorosityIsRightToThreeTenthsOfAPoint) {
  HAVERS_SLOW;
  unsigned seed = 0;
  for (const Outline outline : {Outline::filled, Outline::bar, Outline::tilted_bar, Outline::ring})
    for (const double porosity : {0.01, 0.05, 0.2}) {
      SectionTruth section = GetParam().section;
      section.width = 520, section.height = 440;
      section.outline = outline;
      section.porosity = porosity;
      section.seed = ++seed;
      section.largest_radius = seed % 2 == 0 ? 4.0 : 20.0;
      expect_porosity_within(0.3, section, GetParam().name);
    }
}

// Where nothing surrounds the bone, the user has to say that there is any.
TEST_P(UnderHardship, ASectionWithoutPoresHasNone) {
  HAVERS_SLOW;
  for (const Outline outline :
       {Outline::filled, Outline::bar, Outline::tilted_bar, Outline::ring}) {
    SectionTruth section = GetParam().section;
    section.outline = outline;
    section.porosity = 0.0;
    const auto measured = measure(test::draw(section), std::string(GetParam().name) + ".png",
                                  {.pixel_size = pixel, .fills_image = outline == Outline::filled});
    EXPECT_LT(measured.porosity, 5e-4) << static_cast<int>(outline);
  }
}

// Noise that passes the test for a second level by chance: next to nothing must come of it.
TEST(Section, MakesLittleOfNoiseThatLooksLikeAPore) {
  const auto drawn = test::draw({.outline = Outline::filled,
                                 .width = 441,
                                 .height = 558,
                                 .porosity = 0.0,
                                 .noise = 0.25,
                                 .blur = 0.7,
                                 .seed = 9000182});
  EXPECT_LT(
      100.0 * measure(drawn, "noise.png", {.pixel_size = pixel, .fills_image = true}).porosity,
      0.05);
}

// On the small copy, where bone is looked for, the walls that hold this corner are gone.
TEST(Section, KeepsACornerThatPoresNearlyCutOff) {
  const auto drawn = test::draw({.width = 520,
                                 .height = 440,
                                 .porosity = 0.2,
                                 .largest_radius = 30.0,
                                 .clusters = 4,
                                 .seed = 500062});
  const auto measured = measure(drawn, "corner.png");
  EXPECT_NEAR(100.0 * measured.porosity, 100.0 * drawn.porosity, 0.3);
}

TEST(Section, CountsPoresAndAreas) {
  const auto drawn = test::draw({.largest_radius = 12.0, .noise = 0.05, .blur = 0.8});
  const auto measured = measure(drawn, "counts.png");
  EXPECT_EQ(measured.pore_count, drawn.pore_count);
  const double bone = cv::sum(drawn.bone)[0] * pixel * pixel;
  EXPECT_NEAR(measured.bone_area, bone, 2e-3 * bone);
  EXPECT_NEAR(measured.pore_area, measured.porosity * measured.bone_area, 1e-9 * bone);
  EXPECT_GT(measured.threshold, 0.4);
  EXPECT_LT(measured.threshold, 0.6);
}

// A third of a ring's inside is marrow: were it taken for a pore, porosity would be a third.
TEST(Section, LeavesOutTheMarrowCavity) {
  const auto drawn = test::draw({.outline = Outline::ring, .blur = 1.0});
  const auto measured = measure(drawn, "marrow.png");
  const double bone = cv::sum(drawn.bone)[0] * pixel * pixel;
  EXPECT_NEAR(measured.bone_area, bone, 5e-3 * bone);
  EXPECT_NEAR(measured.porosity, drawn.porosity, 1e-3);
}

// A saw goes through pores; what is left of them is porosity, not outline.
TEST(Section, ClosesPoresThatTheSurfaceOfABarCuts) {
  auto drawn =
      test::draw({.porosity = 0.05, .smallest_radius = 15.0, .largest_radius = 15.0, .blur = 0.7});
  const double truth =
      drawn.porosity + 2.0 * 0.5 * std::numbers::pi * 20.0 * 20.0 / cv::sum(drawn.bone)[0];
  cv::circle(drawn.image, {200, 96}, 20, 51, cv::FILLED);
  cv::circle(drawn.image, {500, 504}, 20, 51, cv::FILLED);
  EXPECT_NEAR(100.0 * measure(drawn, "cut.png").porosity, 100.0 * truth, 0.15);
}

TEST(Section, IgnoresTextAndScaleBarsOutsideTheBone) {
  auto drawn = test::draw({.blur = 0.7});
  cv::rectangle(drawn.image, cv::Rect(520, 560, 150, 12), 255, cv::FILLED);
  cv::putText(drawn.image, "500 um", {30, 580}, cv::FONT_HERSHEY_SIMPLEX, 1.0, 255, 2);
  EXPECT_NEAR(100.0 * measure(drawn, "text.png").porosity, 100.0 * drawn.porosity, 0.1);
}

TEST(Section, ObeysAMask) {
  const auto drawn = test::draw({.porosity = 0.1, .blur = 0.7});
  cv::Mat mask = cv::Mat::zeros(drawn.image.size(), CV_8U);
  const cv::Rect part(200, 180, 250, 200);
  mask(part).setTo(255);
  const auto file = test::write(mask, "mask.png");
  const auto measured = measure(drawn, "masked.png", {.pixel_size = pixel, .mask = file});
  const double truth = cv::sum(drawn.pores(part))[0] / part.area();
  EXPECT_NEAR(100.0 * measured.porosity, 100.0 * truth, 0.2);
  EXPECT_NEAR(measured.bone_area, part.area() * pixel * pixel, 1e-18);

  // A layer painted white on transparent keeps colours where nothing is seen.
  cv::Mat layer;
  const cv::Mat white(mask.size(), CV_8U, cv::Scalar(255));
  cv::merge(std::vector<cv::Mat>{white, white, white, mask}, layer);
  EXPECT_EQ(measure(drawn, "layer.png", {.pixel_size = pixel, .mask = test::write(layer, "l.png")})
                .bone_area,
            measured.bone_area);
}

// As another program has segmented it: one grain of pore in the middle of a rock, or half of it.
TEST(Section, TakesAnImageOfTwoValuesAtItsWord) {
  const SectionOptions everywhere{
      .pixel_size = pixel, .fills_image = true, .pores = Pores::dark, .crack_slenderness = 0.0};
  for (const int radius : {15, 60, 110, 150}) {
    test::DrawnSection drawn{.image = cv::Mat(400, 300, CV_8U, cv::Scalar(1))};
    cv::circle(drawn.image, {120, 230}, radius, 0, cv::FILLED);
    const auto measured = measure(drawn, "segmented.png", everywhere);
    EXPECT_NEAR(measured.porosity, 1.0 - cv::sum(drawn.image)[0] / 120000.0, 1e-12) << radius;
  }
}

TEST(Section, TakesAGivenPolarity) {
  // Half dark, half bright: only the user knows which is bone.
  const auto drawn = test::draw({.outline = Outline::ring, .blur = 0.7});
  const auto options = [](Pores pores) {
    return SectionOptions{.pixel_size = pixel, .pores = pores};
  };
  EXPECT_NEAR(measure(drawn, "polarity.png", options(Pores::dark)).porosity, drawn.porosity, 2e-3);
  const double outside = (700.0 * 600.0 - std::numbers::pi * 270.0 * 270.0) * pixel * pixel;
  EXPECT_NEAR(measure(drawn, "polarity.png", options(Pores::bright)).bone_area, outside,
              0.02 * outside);
}

// The interval must hold the drawn porosity in nineteen of twenty sections.
TEST(Section, StandardErrorCoversTheTruth) {
  HAVERS_SLOW;
  int covered = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto drawn = test::draw({.width = 350,
                                   .height = 300,
                                   .largest_radius = 8.0,
                                   .noise = 0.1,
                                   .blur = 1.0,
                                   .seed = seed});
    const auto measured = measure(drawn, "covered.png");
    EXPECT_GT(measured.porosity_standard_error, 0.0);
    if (std::abs(measured.porosity - drawn.porosity) <= 1.96 * measured.porosity_standard_error)
      ++covered;
  }
  EXPECT_GE(covered, 18);
}

TEST(Section, MeasuresTheWindowSpreadOfTheDrawnPores) {
  const auto drawn = test::draw({.largest_radius = 15.0, .noise = 0.1, .blur = 1.0});
  const auto measured = measure(drawn, "windows.png");
  const auto truth = images::window_spread(drawn.bone >= 0.5, drawn.pores >= 0.5, 50.0, 5.0);
  EXPECT_NEAR(measured.window_sd, truth.sd, 0.03 * truth.sd);
  EXPECT_GT(measured.window_sd_standard_error, 0.0);
  EXPECT_LT(measured.window_sd_standard_error, 0.3 * measured.window_sd);
}

TEST(Section, TellsCracksFromPores) {
  auto drawn = test::draw({.porosity = 0.0, .blur = 0.7});
  const cv::Mat before = drawn.image.clone();
  cv::line(drawn.image, {150, 110}, {400, 135}, 51, 3);
  const double crack = cv::countNonZero(drawn.image != before) * pixel * pixel;
  const auto measured = measure(drawn, "cracked.png");
  EXPECT_EQ(measured.crack_count, 1);
  EXPECT_THAT(measured.warnings,
              testing::Contains(testing::AllOf(
                  testing::StartsWith("1 long and narrow object, "),
                  testing::EndsWith("was taken for a crack and does not count as a pore"))));
  EXPECT_NEAR(measured.crack_area, crack, 0.1 * crack);
  EXPECT_EQ(measured.porosity, 0.0);
  const auto counted =
      measure(drawn, "counted.png", {.pixel_size = pixel, .crack_slenderness = 0.0});
  EXPECT_EQ(counted.crack_count, 0);
  EXPECT_GT(counted.porosity, 2e-3);
}

// Rules of the trade, behind the same test for a second level.
TEST(Section, CutsByOtsuAndSauvolaWhereAsked) {
  const auto drawn = test::draw({.porosity = 0.1, .largest_radius = 15.0, .blur = 0.7});
  const auto empty = test::draw({.porosity = 0.0, .noise = 0.1, .blur = 1.0});
  for (const Threshold threshold : {Threshold::otsu, Threshold::sauvola}) {
    const SectionOptions options{.pixel_size = pixel, .threshold = threshold};
    EXPECT_NEAR(measure(drawn, "rule.png", options).porosity, drawn.porosity, 0.02);
    EXPECT_EQ(measure(empty, "no_rule.png", options).porosity, 0.0);
  }
}

}  // namespace
}  // namespace havers::io
