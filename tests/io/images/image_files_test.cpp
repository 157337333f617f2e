// Formats, and every way an image file can be wrong.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "io/images/grey_image.hpp"
#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"
#include "tests/support/sections.hpp"

namespace havers::io {
namespace {

std::string complaint(const std::filesystem::path& file, const SectionOptions& options = {}) {
  try {
    measure_sections(file, options);
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1U);
    return error.what();
  }
  return "nothing was thrown";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

std::filesystem::path write_text(const std::string& name, const std::string& text) {
  auto file = test::write(cv::Mat::zeros(1, 1, CV_8U), "folder.png").parent_path() / name;
  std::ofstream(file) << text;
  return file;
}

TEST(ImageFile, OfEveryFormatGivesTheSame) {
  EXPECT_TRUE(images_available());
  const auto drawn = test::draw({.largest_radius = 10.0, .blur = 1.0});
  for (const char* name : {"a.png", "a.tif", "a.tiff", "a.bmp", "a.jpg"}) {
    const auto measured = measure_sections(test::write(drawn.image, name), {}).front().porosity;
    EXPECT_NEAR(100.0 * measured.porosity, 100.0 * drawn.porosity, 0.1) << name;
    EXPECT_EQ(std::filesystem::path(measured.file).filename(), name);
  }
}

TEST(ImageFile, OfSixteenBitsKeepsThem) {
  // All within one step of 8 bits.
  const auto drawn = test::draw(
      {.bone = 0.502, .pore = 0.4995, .background = 0.4995, .noise = 0.1, .blur = 1.0, .bits = 16});
  for (const char* name : {"deep.png", "deep.tif"}) {
    const auto measured = measure_sections(test::write(drawn.image, name), {}).front().porosity;
    EXPECT_NEAR(100.0 * measured.porosity, 100.0 * drawn.porosity, 0.3) << name;
  }
}

TEST(ImageFile, ThatNoLibraryReadsIsRefusedInOurWordsAlone) {
  const std::string png_of_width_0(
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\0\0\0\0\x0a\x08\0\0\0\0\xbf\x7b\x00\xa8"
      "\0\0\0\0IEND\xae\x42\x60\x82",
      45);
  testing::internal::CaptureStderr();
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"width_0.png", png_of_width_0},
        {"cut_off.pgm", "P5\n100 100\n255\nabc"},
        {"no_size.pgm", "P5\n100 x\n255\nabc"},
        {"no_header.bmp", "BM" + std::string(60, 'a')}})
    expect_contains(complaint(write_text(name, text)), "is not a readable image");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ImageFile, OfFloatsMustHoldNumbers) {
  const auto drawn = test::draw({.blur = 1.0});
  cv::Mat floats;
  drawn.image.convertTo(floats, CV_32F);
  floats.at<float>(0, 0) = std::numeric_limits<float>::quiet_NaN();
  expect_contains(complaint(test::write(floats, "nan.tif")), "no finite numbers");
}

TEST(ImageFile, WithTransparentBackgroundHasNoBoneThere) {
  const auto drawn = test::draw({.background = 0.8, .blur = 0.7});  // Invisible but for its alpha.
  cv::Mat alpha, colour;
  drawn.bone.convertTo(alpha, CV_8U, 255.0);
  cv::merge(std::vector<cv::Mat>{drawn.image, drawn.image, drawn.image, alpha}, colour);
  const auto measured =
      measure_sections(test::write(colour, "alpha.png"), {.pixel_size = 1e-6}).front().porosity;
  EXPECT_NEAR(100.0 * measured.porosity, 100.0 * drawn.porosity, 0.2);
  EXPECT_NEAR(measured.bone_area * 1e12, cv::sum(drawn.bone)[0], 0.01 * cv::sum(drawn.bone)[0]);
}

TEST(ImageFile, OfGreyAndAlphaIsThatOfColoursAndAlpha) {
  const auto drawn = test::draw({.background = 0.8, .blur = 0.7});
  cv::Mat alpha, two, four;
  drawn.bone.convertTo(alpha, CV_8U, 255.0);
  cv::merge(std::vector<cv::Mat>{drawn.image, alpha}, two);
  cv::merge(std::vector<cv::Mat>{drawn.image, drawn.image, drawn.image, alpha}, four);
  EXPECT_EQ(cv::norm(images::to_grey(two, ""), images::to_grey(four, ""), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(images::to_grey(two, ""), drawn.image, cv::NORM_INF), 0.0);  // what is hidden
}

TEST(ImageFile, OfSeveralPagesIsASectionAPage) {
  const auto first = test::draw({.porosity = 0.02, .blur = 1.0});
  const auto second = test::draw({.porosity = 0.1, .blur = 1.0, .seed = 2});
  const auto file = test::write(first.image, "pages.tif");
  cv::imwritemulti(file.string(), std::vector<cv::Mat>{first.image, second.image});
  const auto measured = measure_sections(file, {});
  ASSERT_EQ(measured.size(), 2U);
  EXPECT_NEAR(measured[0].porosity.porosity, first.porosity, 2e-3);
  EXPECT_NEAR(measured[1].porosity.porosity, second.porosity, 2e-3);
  EXPECT_TRUE(measured[1].porosity.file.ends_with("pages.tif page 2"));
}

TEST(Mask, OfAsManyPagesAsTheImageIsOneForEach) {
  const auto drawn = test::draw({.blur = 1.0});
  const cv::Mat left = cv::Mat::zeros(drawn.image.size(), CV_8U), right = left.clone();
  left(cv::Rect(100, 150, 200, 300)).setTo(255);
  right(cv::Rect(350, 150, 200, 150)).setTo(255);
  const auto file = test::write(drawn.image, "pages.tif"), masks = test::write(left, "masks.tif");
  cv::imwritemulti(file.string(), std::vector<cv::Mat>{drawn.image, drawn.image});
  cv::imwritemulti(masks.string(), std::vector<cv::Mat>{left, right});
  const auto area_of = [&](const std::filesystem::path& mask) {
    const auto all = measure_sections(file, {.pixel_size = 1e-6, .mask = mask});
    return std::pair(1e12 * all[0].porosity.bone_area, 1e12 * all[1].porosity.bone_area);
  };
  const auto [first, second] = area_of(masks);
  EXPECT_NEAR(first, 60000.0, 1e-3);
  EXPECT_NEAR(second, 30000.0, 1e-3);
  EXPECT_NEAR(area_of(test::write(left, "one.png")).second, 60000.0, 1e-3);  // one for all
  cv::imwritemulti(masks.string(), std::vector<cv::Mat>{left, right, left});
  expect_contains(complaint(file, {.mask = masks}), "the mask has 3 pages, its image 2 pages");
}

TEST(ImageFile, WithAnImplausiblePixelSizeIsMeasuredIfThatIsMeant) {
  const auto file = test::write(test::draw({.blur = 1.0}).image, "coarse.png");
  const SectionOptions options{.pixel_size = 300e-6, .any_pixel_size = true};
  EXPECT_EQ(measure_sections(file, options).front().porosity.pixel_size, 300e-6);
}

TEST(ImageFile, ThatIsMissingIsNamed) {
  expect_contains(
      complaint("nowhere/section.png"),
      "nowhere/section.png: there is no such file (check the path; a study's are relative to "
      "its folder)");
}

// As one is without the right to read it, which root always has.
TEST(ImageFile, ThatCannotBeOpenedIsNamed) {
  const auto file = write_text("loop.png", "");
  std::filesystem::remove(file);
  std::filesystem::create_symlink("loop.png", file);
  expect_contains(complaint(file), "loop.png: cannot be read: ");
}

TEST(ImageFile, ThatIsAFolderIsNamed) {
  expect_contains(complaint(std::filesystem::temp_directory_path()), "is a folder, not an image");
}

TEST(ImageFile, ThatIsADeviceIsNamed) {
  expect_contains(complaint("/dev/null"), "/dev/null: is a device, not an image");
}

TEST(ImageFile, ThatIsEmptyIsNamed) {
  expect_contains(complaint(write_text("nothing.png", "")), "is an empty file");
}

TEST(ImageFile, ThatIsNoImageIsNamed) {
  expect_contains(complaint(write_text("words.png", "this is text")),
                  "is not a readable image (use PNG, TIFF, JPEG, BMP or DICOM)");
}

TEST(ImageFile, OfOneGreyLevelIsNamed) {
  const auto file = test::write(cv::Mat(50, 50, CV_8U, cv::Scalar(9)), "flat.png");
  expect_contains(complaint(file), "every pixel has the same value (9)");
}

TEST(ImageFile, WithAnImplausiblePixelSizeIsNamed) {
  for (const double size : {0.05e-6, 201e-6, -1e-6, 0.0})
    expect_contains(complaint("unread.png", {.pixel_size = size}), "is outside 0.1 to 200 µm");
}

// As when the section itself is given for its mask.
TEST(Mask, ThatIsGreyIsDoubted) {
  const cv::Mat section = test::draw({}).image;
  const auto image = test::write(section, "whole.png");
  const cv::Mat sharp = section > 128;
  cv::Mat blurred;
  cv::GaussianBlur(sharp, blurred, {}, 1.0);
  for (const auto& [mask, doubted] : {std::pair(section, true), std::pair(blurred, false)}) {
    const auto warnings =
        measure_sections(image, {.mask = test::write(mask, "mask.png")}).front().porosity.warnings;
    EXPECT_EQ(std::ranges::any_of(warnings,
                                  [](const std::string& warning) {
                                    return warning.find("neither black nor white") !=
                                           std::string::npos;
                                  }),
              doubted);
  }
}

TEST(Mask, ThatIsWrongIsNamed) {
  const auto image = test::write(test::draw({}).image, "whole.png");
  const auto other = test::write(cv::Mat(10, 20, CV_8U, cv::Scalar(255)), "small_mask.png");
  expect_contains(complaint(image, {.mask = other}),
                  "the mask is 20 × 10 pixels, its image 700 × 600");
  const auto black = test::write(cv::Mat::zeros(600, 700, CV_8U), "black_mask.png");
  expect_contains(complaint(image, {.mask = black}), "the mask marks nothing");
  expect_contains(complaint(image, {.mask = "no_mask.png"}), "no_mask.png: there is no such file");
}

// Nothing to measure, but nothing to fall over either.
TEST(ImageFile, OfAFewPixelsIsMeasuredOrRefused) {
  for (const cv::Size size : {cv::Size(2, 1), cv::Size(3, 3), cv::Size(1, 400), cv::Size(9, 7)}) {
    cv::Mat image = cv::Mat::zeros(size, CV_8U);
    image.at<std::uint8_t>(0, 0) = 200;
    const auto file = test::write(image, "tiny.png");
    try {
      const double porosity =
          measure_sections(file, {.pixel_size = 1e-6}).front().porosity.porosity;
      EXPECT_TRUE(porosity >= 0.0 && porosity < 1.0);
    } catch (const InputError& error) {
      expect_contains(error.what(), "tiny.png");
    }
  }
}

}  // namespace
}  // namespace havers::io
