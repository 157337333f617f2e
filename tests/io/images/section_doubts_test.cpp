// What is said of a section beside its porosity, and what is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "io/images/measure_section.hpp"
#include "tests/io/complaints.hpp"
#include "tests/support/sections.hpp"
#include "tests/support/slow.hpp"

namespace havers::io {
namespace {

using test::measure;
using test::Outline;
using test::pixel;
bool warns(const calib::SectionPorosity& section, const std::string& words) {
  return std::ranges::any_of(section.warnings, [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

// The outline that is found ends where the mask goes on.
TEST(SectionDoubt, AMaskThatTakesInBackgroundIsDoubted) {
  const auto drawn = test::draw({.porosity = 0.1, .blur = 0.7});
  const auto doubt = "looks like background around a bone";
  const cv::Mat all(drawn.image.size(), CV_8U, cv::Scalar(255));
  cv::Mat inside = cv::Mat::zeros(drawn.image.size(), CV_8U);
  inside(cv::Rect(200, 180, 250, 200)).setTo(255);
  const auto file = test::write(all, "all.png"), part = test::write(inside, "inside.png");
  EXPECT_TRUE(warns(measure(drawn, "a.png", {.pixel_size = pixel, .mask = file}), doubt));
  EXPECT_TRUE(warns(measure(drawn, "a.png", {.pixel_size = pixel, .fills_image = true}), doubt));
  EXPECT_FALSE(warns(measure(drawn, "a.png", {.pixel_size = pixel, .mask = part}), doubt));
}

// Noise about one level: bone, paper, or a lens with its cap on.
TEST(SectionDoubt, AnImageOfNothingIsRefusedUnlessBoneIsSaidToFillIt) {
  const auto nothing =
      test::draw({.outline = Outline::filled, .porosity = 0.0, .noise = 0.1, .cupping = 0.2});
  EXPECT_THAT(test::refusal_of([&] { measure(nothing, "nothing.png"); }),
              testing::HasSubstr("neither a background nor pores"));
  const auto meant = measure(nothing, "meant.png", {.pixel_size = pixel, .fills_image = true});
  EXPECT_EQ(meant.porosity, 0.0);
  EXPECT_TRUE(meant.doubtful);
  EXPECT_TRUE(std::isnan(meant.mean_pore_diameter));
}

TEST(SectionDoubt, IsOfThePorosityAndNotOfItsScale) {
  const auto drawn = test::draw({.noise = 0.05, .blur = 0.8});
  EXPECT_FALSE(measure(drawn, "sound.png").doubtful);
  EXPECT_FALSE(measure(drawn, "unscaled.png", {}).doubtful);
  const auto filled = test::draw({.outline = Outline::filled, .noise = 0.05, .blur = 0.8});
  EXPECT_TRUE(measure(filled, "filled.png").doubtful);
  EXPECT_FALSE(measure(filled, "said.png", {.pixel_size = pixel, .fills_image = true}).doubtful);
}

// Of three pixels, that is; four make a pore.
TEST(SectionDoubt, LeavesOutSpecksAndSaysSo) {
  auto drawn = test::draw({.width = 400, .height = 350, .porosity = 0.0});
  cv::circle(drawn.image, {200, 175}, 12, 51, cv::FILLED);
  const auto without = measure(drawn, "no_specks.png");
  EXPECT_EQ(without.pore_count, 1);
  for (int i = 0; i < 7; ++i) drawn.image(cv::Rect(60 + 40 * i, 90, 3, 1)).setTo(51);
  const auto specks = measure(drawn, "specks.png");
  EXPECT_EQ(specks.pore_count, 1);
  EXPECT_EQ(specks.speck_count, 7);
  EXPECT_EQ(specks.porosity, without.porosity);
  EXPECT_TRUE(warns(specks, "7 objects below 4 pixels were left out"));
  drawn.image(cv::Rect(250, 250, 2, 2)).setTo(51);
  const auto pore = measure(drawn, "pore.png");
  EXPECT_EQ(pore.pore_count, 2);
  EXPECT_NEAR(pore.pore_area - without.pore_area, 4.0 * pixel * pixel, 1e-6 * pixel * pixel);
}

TEST(SectionDoubt, WithoutAPixelSizeHasPorosityButNoWindows) {
  const auto measured = measure(test::draw({}), "unscaled.png", {});
  EXPECT_GT(measured.porosity, 0.04);
  EXPECT_TRUE(std::isnan(measured.window_sd));
  EXPECT_TRUE(std::isnan(measured.bone_area));
  EXPECT_TRUE(warns(measured, "no pixel size is known"));
}

TEST(SectionDoubt, WarnsWhereItsPixelsAreCoarserThanTheFibre) {
  const auto measured = measure(test::draw({}), "coarse.png", {.pixel_size = 30e-6});
  EXPECT_TRUE(warns(measured, "larger than the fibre's height"));
}

TEST(SectionDoubt, WarnsOfPoresThatNoCanalHas) {
  const auto drawn = test::draw({.largest_radius = 20.0});
  EXPECT_FALSE(warns(measure(drawn, "sound.png", {.pixel_size = 2e-6}), "unlike canals"));
  for (const double wrong : {0.1e-6, 40e-6}) {
    const auto measured = measure(drawn, "scaled.png", {.pixel_size = wrong});
    EXPECT_TRUE(warns(measured, "unlike canals in bone (10 to 500 µm): is the pixel size"))
        << wrong;
    EXPECT_FALSE(measured.doubtful);
  }
}

// Above a twentieth of the bone.
TEST(SectionDoubt, WarnsOfAPoreThatMayBeMarrow) {
  for (const bool large : {false, true}) {
    auto drawn = test::draw({.width = 350, .height = 300, .porosity = 0.0});
    const int radius = large ? 32 : 29;  // 5.6 and 4.6 %
    cv::circle(drawn.image, {175, 150}, radius, 51, cv::FILLED);
    EXPECT_EQ(warns(measure(drawn, "big_pore.png"), "marrow cavity"), large);
  }
}

// In the straight side of a bar they are notches, as pores are that the saw went through.
TEST(SectionDoubt, WarnsOfChipsAndSawCuts) {
  HAVERS_SLOW;
  const auto bar = [](unsigned seed) {
    return test::draw(
        {.porosity = 0.08, .largest_radius = 12.0, .noise = 0.04, .blur = 0.8, .seed = seed});
  };
  for (unsigned seed = 1; seed <= 10; ++seed)
    EXPECT_FALSE(warns(measure(bar(seed), "whole.png"), "the largest notch")) << seed;
  for (const cv::Rect notch : {cv::Rect(300, 90, 60, 30), cv::Rect(300, 90, 12, 90)}) {
    auto drawn = bar(1);
    drawn.image(notch).setTo(51);
    const auto measured = measure(drawn, "chipped.png");
    EXPECT_TRUE(warns(measured, "the largest notch in the bone's outline")) << notch;
    EXPECT_TRUE(measured.doubtful);
  }
}

// A microscope's data bar, white as the bone is.
TEST(SectionDoubt, WarnsOfAStripAlongTheEdge) {
  auto drawn = test::draw({.blur = 0.8});
  EXPECT_FALSE(warns(measure(drawn, "plain.png"), "strip along an edge"));
  drawn.image.rowRange(drawn.image.rows - 60, drawn.image.rows).setTo(204);
  const auto labelled = measure(drawn, "label.png");
  EXPECT_TRUE(warns(labelled, "strip along an edge of the image"));
  EXPECT_TRUE(labelled.doubtful);
}

// Where bone fills the rest, the bar is what a background leaves.
TEST(SectionDoubt, WarnsOfADataBarThatPassesForTheBone) {
  cv::Mat image(600, 800, CV_8U, cv::Scalar(170));
  for (int i = 0; i < 40; ++i)
    cv::circle(image, {40 + 97 * (i % 8), 40 + 95 * (i / 8)}, 12, 30, cv::FILLED);
  image.rowRange(520, 600).setTo(0);
  cv::putText(image, "20 kV  100 um", {40, 575}, cv::FONT_HERSHEY_SIMPLEX, 1.4, 255, 3);
  const auto measured = measure({.image = image}, "data_bar.png");
  EXPECT_TRUE(warns(measured, "all that is taken for bone is a strip along an edge"));
  image.rowRange(520, 560).setTo(170);
  const auto narrow = measure({.image = image}, "narrow_bar.png");
  EXPECT_TRUE(warns(narrow, "all that is taken for bone is a strip along an edge"));
  EXPECT_FALSE(warns(narrow, "--fills-image"));
  EXPECT_TRUE(measured.doubtful);
}

TEST(SectionDoubt, WarnsOfLinesDrawnIntoTheBoneAndOfNoStain) {
  const auto stained = test::draw({.blur = 0.8, .colour = true});
  EXPECT_FALSE(warns(measure(stained, "stain.png"), "is coloured"));
  auto drawn = test::draw({.blur = 0.8});
  cv::cvtColor(drawn.image, drawn.image, cv::COLOR_GRAY2BGR);
  cv::line(drawn.image, {20, 20}, {500, 20}, cv::Scalar(0, 0, 255), 3);
  EXPECT_FALSE(warns(measure(drawn, "outside.png"), "is coloured"));
  cv::line(drawn.image, {150, 300}, {500, 320}, cv::Scalar(0, 0, 255), 3);
  EXPECT_TRUE(warns(measure(drawn, "inside.png"), "is coloured, and the rest is grey"));
}

// Bright fringes, as phase contrast leaves them, weigh against the pores in the grey levels only.
TEST(SectionDoubt, WarnsWhereGreyLevelsAndThresholdDisagree) {
  auto drawn = test::draw({.porosity = 0.0});
  for (int i = 0; i < 24; ++i) {
    const cv::Point middle(120 + 80 * (i % 6), 130 + 90 * (i / 6));
    cv::circle(drawn.image, middle, 19, 250, cv::FILLED);
    cv::circle(drawn.image, middle, 16, 51, cv::FILLED);
  }
  const auto measured = measure(drawn, "disagree.png");
  EXPECT_TRUE(warns(measured, "differs by more than one point"));
}

// Osteons of darker bone, with a few pores and with none.
TEST(SectionDoubt, IsOfPoresFarFainterThanTheBackground) {
  for (const double porosity : {0.003, 0.0}) {
    auto drawn = test::draw({.porosity = porosity, .noise = 0.03});
    EXPECT_FALSE(warns(measure(drawn, "plain.png"), "of what the background does"));
    cv::Mat osteons = cv::Mat::zeros(drawn.image.size(), CV_8U);
    for (int i = 0; i < 24; ++i)
      cv::circle(osteons, {130 + 85 * (i % 6), 150 + 95 * (i / 6)}, 30, 60, cv::FILLED);
    osteons.setTo(0, drawn.image < 150);
    drawn.image -= osteons;
    const auto measured = measure(drawn, "osteons.png");
    EXPECT_GT(measured.porosity, 0.2);
    EXPECT_TRUE(warns(measured, "of what the background does: if that is darker bone"));
    EXPECT_TRUE(measured.doubtful);
  }
}

TEST(SectionDoubt, IsOfPoresFilledInPart) {
  auto drawn = test::draw({.smallest_radius = 9.0, .largest_radius = 9.0, .noise = 0.03});
  EXPECT_FALSE(measure(drawn, "empty.png").doubtful);
  const cv::Mat left = drawn.image.colRange(0, drawn.image.cols / 2);
  cv::Mat in_pores = drawn.pores.colRange(0, left.cols) > 0.5;
  cv::add(left, 100, left, in_pores);
  const auto measured = measure(drawn, "filled.png");
  EXPECT_LT(measured.porosity, 0.75 * drawn.porosity);
  EXPECT_TRUE(warns(measured, "more than half way to the threshold"));
  EXPECT_TRUE(measured.doubtful);
}

// One pore is as large as a region, and all have less of the frame than what is between them.
TEST(SectionDoubt, WarnsOfABoneInManyParts) {
  cv::Mat image(600, 800, CV_8U, cv::Scalar(180));
  cv::circle(image, {400, 300}, 135, 30, cv::FILLED);
  for (int i = 0; i < 15; ++i)
    if (i / 5 != 1 || i % 5 == 0 || i % 5 == 4)
      cv::circle(image, {80 + 160 * (i % 5), 80 + 220 * (i / 5)}, 55, 30, cv::FILLED);
  const auto measured = measure({.image = image}, "parts.png");
  EXPECT_TRUE(warns(measured, "in 13 parts: if that is pores in bone that fills the image"));
  EXPECT_TRUE(measured.doubtful);
}

// Canals cut lengthwise.
TEST(SectionDoubt, IsOfAPorosityThatCracksOutweigh) {
  auto drawn = test::draw({.porosity = 0.02, .largest_radius = 8.0, .blur = 0.7});
  for (int y = 150; y < 460; y += 60) cv::line(drawn.image, {200, y}, {280, y}, 51, 2);
  const auto few = measure(drawn, "crack.png");
  EXPECT_GT(few.crack_count, 0);
  EXPECT_FALSE(few.doubtful);
  for (int y = 150; y < 460; y += 12) cv::line(drawn.image, {100, y}, {600, y}, 51, 3);
  const auto many = measure(drawn, "canals.png");
  EXPECT_GT(many.crack_count, few.crack_count);
  EXPECT_TRUE(many.doubtful);
}

}  // namespace
}  // namespace havers::io
