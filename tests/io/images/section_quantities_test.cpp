// What is told of a section beside its porosity: areas, sizes, zones, rim, density.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "io/images/measure_section.hpp"
#include "io/images/windows.hpp"
#include "io/input_error.hpp"
#include "tests/support/sections.hpp"

namespace havers::io {
namespace {

using test::measure;
using test::pixel;

const std::vector<DensityReference> two_materials{{.grey = 51.0, .density = 0.0},
                                                  {.grey = 204.0, .density = 1900.0}};

TEST(SectionQuantities, NamesItsAreasSizesAndZones) {
  const auto drawn =
      test::draw({.outline = test::Outline::ring, .largest_radius = 12.0, .blur = 0.8});
  const auto measured = measure(drawn, "areas.png");
  const double side = 600.0 * pixel, total = std::numbers::pi * std::pow(0.45 * side, 2);
  EXPECT_NEAR(measured.total_area, total, 0.01 * total);
  EXPECT_NEAR(measured.marrow_area, std::numbers::pi * std::pow(0.22 * side, 2), 0.01 * total);
  EXPECT_NEAR(measured.pore_density * measured.bone_area, measured.pore_count, 1e-6);
  EXPECT_NEAR(measured.mean_pore_area * measured.pore_count, measured.pore_area,
              1e-6 * measured.pore_area);
  int classed = 0;
  for (const calib::PoreClass& one : measured.classes) classed += one.count;
  EXPECT_EQ(classed, measured.pore_count);
  ASSERT_EQ(measured.zones.size(), 7U);
  double quarters = 0.0;
  for (int i = 0; i < 4; ++i) quarters += measured.zones[static_cast<std::size_t>(i)].bone_area;
  EXPECT_NEAR(quarters, measured.bone_area, 0.01 * measured.bone_area);
}

// A pore of another size in each quarter. Around a marrow cavity of radius 132 px a third of the
// bone's depth are 46 px.
TEST(SectionQuantities, FindsThePoresOfEachZone) {
  auto drawn = test::draw({.outline = test::Outline::ring, .porosity = 0.0, .blur = 0.8});
  const int left = 12, right = 10, top = 8, bottom = 14;  // radii [px]
  cv::circle(drawn.image, {150, 300}, left, 51, cv::FILLED);
  cv::circle(drawn.image, {505, 300}, right, 51, cv::FILLED);
  cv::circle(drawn.image, {350, 145}, top, 51, cv::FILLED);
  cv::circle(drawn.image, {350, 547}, bottom, 51, cv::FILLED);
  const std::map<std::string, double> squares{{"left", left * left},
                                              {"right", right * right},
                                              {"top", top * top},
                                              {"bottom", bottom * bottom},
                                              {"inner third", right * right + top * top},
                                              {"middle third", left * left},
                                              {"outer third", bottom * bottom}};
  const auto measured = measure(drawn, "zoned.png");
  ASSERT_EQ(measured.zones.size(), squares.size());
  for (const calib::Zone& zone : measured.zones) {
    const double pores = std::numbers::pi * squares.at(zone.name) * pixel * pixel;
    EXPECT_NEAR(zone.porosity * zone.bone_area, pores, 0.15 * pores) << zone.name;
  }
}

// Pores cut by the image's edge left holes of a few pixels beside them, which passed for marrow.
TEST(SectionQuantities, KnowNoMarrowBesidePoresThatTheImageCuts) {
  cv::Mat image(120, 120, CV_8U, cv::Scalar(40));
  image(cv::Rect(0, 0, 72, 120)).setTo(200);
  const std::vector<cv::Point> cut{{12, 1}, {25, -1}, {50, 1}}, whole{{30, 60}, {20, 90}, {55, 40}};
  for (const cv::Point& at : cut) cv::circle(image, at, 7, 40, cv::FILLED);
  const auto edge = measure({.image = image}, "edge.png");
  for (const cv::Point& at : cut) cv::circle(image, at, 7, 200, cv::FILLED);
  for (const cv::Point& at : whole) cv::circle(image, at, 7, 40, cv::FILLED);
  const auto inside = measure({.image = image}, "inside.png");
  EXPECT_NEAR(edge.marrow_area, 0.0, 1e-18);
  EXPECT_NEAR(edge.bone_area, 72.0 * 120.0 * pixel * pixel, 1e-15);
  ASSERT_EQ(edge.zones.size(), inside.zones.size());
  for (std::size_t i = 0; i < edge.zones.size(); ++i)
    EXPECT_NEAR(edge.zones[i].bone_area / inside.zones[i].bone_area, 1.0, 1e-9)
        << edge.zones[i].name;
}

// Nor all of the dents, about which the image's edge is a surface: a tenth of the bone was lost.
TEST(SectionQuantities, LeaveLittleRimOutAboutPoresThatTheImageCuts) {
  cv::Mat image(300, 300, CV_8U, cv::Scalar(40));
  image(cv::Rect(0, 0, 180, 300)).setTo(200);
  for (int i = 0; i < 5; ++i) {
    cv::circle(image, {20 + 25 * i, -6 + 2 * i}, 11, 40, cv::FILLED);
    cv::circle(image, {20 + 25 * i, 305 - 2 * i}, 9, 40, cv::FILLED);
  }
  const auto rimmed =
      measure({.image = image}, "rim.png", {.pixel_size = pixel, .rim = 20.0 * pixel});
  EXPECT_NEAR(rimmed.bone_area / (160.0 * 300.0 * pixel * pixel), 1.0,
              0.06);  // acute corners of dents stay
}

// Five pores and three, all as they were drawn: what is said of them is known to the pixel.
TEST(SectionQuantities, TellTheSizesOfPores) {
  auto drawn = test::draw({.porosity = 0.0});
  cv::Mat small = cv::Mat::zeros(drawn.image.size(), CV_8U), large = small.clone();
  for (int i = 0; i < 5; ++i) cv::circle(small, {150 + 80 * i, 200}, 8, 255, cv::FILLED);
  for (int i = 0; i < 3; ++i) cv::circle(large, {150 + 80 * i, 400}, 16, 255, cv::FILLED);
  drawn.image.setTo(51, small | large);
  const double a = cv::countNonZero(small) / 5.0, b = cv::countNonZero(large) / 3.0;
  const double da = 2.0 * std::sqrt(a / std::numbers::pi), db = da * std::sqrt(b / a);
  // Of a share 3/8 of the larger: the SD is √(15)/8 of the difference.
  const double sd = std::sqrt(15.0) / 8.0;
  // Radii of 8 and 16 px: at 0.7 µm lacunae and canals, at 7 µm canals and cavities.
  for (const double side : {0.7e-6, 7e-6}) {
    const auto measured = measure(drawn, "sizes.png", {.pixel_size = side});
    const double area = side * side;
    EXPECT_NEAR(measured.mean_pore_area, (5.0 * a + 3.0 * b) / 8.0 * area, 1e-6 * area);
    EXPECT_NEAR(measured.pore_area_sd, sd * (b - a) * area, 1e-6 * area);
    EXPECT_NEAR(measured.mean_pore_diameter, (5.0 * da + 3.0 * db) / 8.0 * side, 1e-6 * side);
    EXPECT_NEAR(measured.pore_diameter_sd, sd * (db - da) * side, 1e-6 * side);
    EXPECT_NEAR(measured.pore_area_ratio, (5.0 * a * a + 3.0 * b * b) / (5.0 * a + 3.0 * b) * area,
                1e-6 * area);
    ASSERT_EQ(measured.classes.size(), 3U);
    const std::size_t first = side < 1e-6 ? 0 : 1;
    EXPECT_EQ(measured.classes[first].count, 5);
    EXPECT_NEAR(measured.classes[first].area, 5.0 * a * area, 1e-6 * area);
    EXPECT_EQ(measured.classes[first + 1].count, 3);
    EXPECT_EQ(measured.classes[0].name, "lacunae");
    EXPECT_EQ(measured.classes[2].name, "cavities");
  }
}

// A slit of 9 pixels: 85 are less than ten times as long, 95 more.
TEST(SectionQuantities, TellCracksByTenTimesTheirWidth) {
  for (const int length : {85, 95}) {
    auto drawn = test::draw({.width = 400, .height = 300, .porosity = 0.0});
    drawn.image(cv::Rect(100, 150, length, 9)).setTo(51);
    const auto measured = measure(drawn, "slit.png");
    EXPECT_EQ(measured.crack_count, length > 90 ? 1 : 0);
    EXPECT_NEAR(measured.crack_area + measured.pore_area, 9.0 * length * pixel * pixel,
                1e-6 * pixel * pixel);
  }
}

// (I10) Bright fringes let the two ways to measure the pores differ.
TEST(SectionQuantities, HaveAnErrorOfBlocksAndOfTwoWaysToMeasurePores) {
  auto drawn = test::draw({.porosity = 0.0});
  const cv::Mat bone = drawn.image > 128;
  cv::Mat pores = cv::Mat::zeros(bone.size(), CV_8U);
  for (int i = 0; i < 24; ++i) {
    const cv::Point middle(120 + 80 * (i % 6), 130 + 90 * (i / 6));
    cv::circle(drawn.image, middle, 19, 250, cv::FILLED);
    cv::circle(pores, middle, 16, 255, cv::FILLED);
  }
  drawn.image.setTo(51, pores);
  const auto measured = measure(drawn, "fringes.png");
  const double half = 0.5 * std::abs(measured.porosity - measured.porosity_by_grey);
  const double blocks = images::porosity_standard_error(bone, pores);
  EXPECT_GT(half, 0.4 * blocks);
  EXPECT_NEAR(measured.porosity_standard_error, std::hypot(blocks, half), 0.01 * blocks);
}

TEST(SectionQuantities, LeavesOutTheRimOfTheBone) {
  const auto drawn = test::draw({.porosity = 0.0, .blur = 0.7});
  const auto whole = measure(drawn, "whole.png");
  const auto inner = measure(drawn, "inner.png", {.pixel_size = pixel, .rim = 10.0 * pixel});
  const double length = 560.0, height = 408.0;  // of the drawn bar. [px]
  EXPECT_NEAR(whole.bone_area / (length * height * pixel * pixel), 1.0, 0.005);
  EXPECT_NEAR(inner.bone_area / ((length - 20.0) * (height - 20.0) * pixel * pixel), 1.0, 0.005);
  EXPECT_THROW(measure(drawn, "unscaled_rim.png", {.rim = 1e-5}), InputError);
  for (const double pixels : {300.0, 1e10})  // more than whole numbers hold
    EXPECT_THROW(measure(drawn, "all_rim.png", {.pixel_size = pixel, .rim = pixels * pixel}),
                 InputError);
}

TEST(SectionQuantities, ReadsDensityFromMaterialsOfKnownOne) {
  const auto drawn = test::draw({.blur = 0.7});  // bone 204, background 51
  const DensityReference air{.grey = 51.0, .density = 0.0};
  const DensityReference phantom{.x = 5, .y = 5, .width = 40, .height = 40, .density = 0.0};
  const DensityReference bone{.grey = 204.0, .density = 1900.0};
  for (const DensityReference& zero : {air, phantom}) {
    const auto measured =
        measure(drawn, "density.png", {.pixel_size = pixel, .density = {zero, bone}});
    EXPECT_NEAR(measured.density, 1900.0, 10.0);
    EXPECT_TRUE(std::isnan(measured.density_residual)) << "two points lie on their line";
  }
  // A third one 30 above the line lifts it by 10: two residuals of 10, one of 20.
  const DensityReference between{.grey = 127.5, .density = 980.0};
  const auto measured = measure(drawn, "residual.png", {.density = {air, bone, between}});
  EXPECT_NEAR(measured.density_residual, std::sqrt(200.0), 1e-6);
  const DensityReference light{.grey = 204.0, .density = 0.0}, heavy{.grey = 255.0, .density = 9.0};
  EXPECT_THROW(measure(drawn, "reversed.png", {.density = {heavy, light}}), InputError);
  const auto without = measure(drawn, "no_reference.png", {});
  EXPECT_TRUE(std::isnan(without.density) && std::isnan(without.density_residual));
}

// Nothing of so narrow a bone is two pixels from its surface.
TEST(SectionQuantities, HaveNoDensityWhereNoBoneIsSolid) {
  const test::DrawnSection drawn{
      .image = cv::Mat(120, 300, CV_8U, cv::Scalar(51)), .bone = {}, .pores = {}};
  drawn.image(cv::Rect(20, 58, 260, 4)).setTo(204);
  const auto measured = measure(drawn, "narrow.png",
                                {.pixel_size = pixel,
                                 .mask = test::write(drawn.image > 100, "mask.png"),
                                 .density = two_materials});
  EXPECT_TRUE(std::isnan(measured.density)) << measured.density;
  ASSERT_FALSE(measured.warnings.empty());
  EXPECT_EQ(measured.warnings.back(),
            "density stays unknown: nowhere is bone two pixels from its surface, pores and cracks");
}

TEST(SectionQuantities, ReadDensityBesideCracks) {
  auto drawn = test::draw({.blur = 0.7});
  const SectionOptions options{.pixel_size = pixel, .density = two_materials};
  const double sound = measure(drawn, "sound.png", options).density;
  for (int y = 130; y < 480; y += 15) cv::line(drawn.image, {100, y}, {600, y}, 51, 2);
  EXPECT_GT(measure(drawn, "cracked.png", options).crack_count, 5);
  EXPECT_NEAR(measure(drawn, "cracked.png", options).density, sound, 2.0);
}

// Saved in colours, a grey image is the same; levels along a colour's own axis are none of a
// file's.
TEST(SectionQuantities, HaveNoDensityByGreyLevelsOfAColour) {
  auto drawn = test::draw({.blur = 0.7});
  const SectionOptions options{.pixel_size = pixel, .density = two_materials};
  const double grey = measure(drawn, "grey.png", options).density;
  cv::cvtColor(drawn.image, drawn.image, cv::COLOR_GRAY2BGR);
  EXPECT_EQ(measure(drawn, "colours.png", options).density, grey);
  cv::Mat floats;
  drawn.image.convertTo(floats, CV_32F);
  const auto file = test::write(drawn.image, "floats.tif");
  cv::imwrite(file.string(), floats, {cv::IMWRITE_TIFF_COMPRESSION, 1});
  EXPECT_NEAR(measure_sections(file, options).front().porosity.density, grey, 1e-4 * grey);
  cv::multiply(drawn.image, cv::Scalar(1.0, 0.8, 0.9), drawn.image);
  EXPECT_THROW(measure(drawn, "tinted.png", options), InputError);
}

}  // namespace
}  // namespace havers::io
