// Pages of a TIFF that are no sections of their own, and pages of different pixels.
#include "io/images/tiff_pages.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <map>

#include "io/images/measure_section.hpp"
#include "tests/io/complaints.hpp"
#include "tests/support/sections.hpp"

namespace havers::io {
namespace {

struct Page {
  cv::Mat image;
  bool reduced = false;
  std::uint64_t per_cm = 0;  // pixels; none is written where it is 0
};

// The fewest tags, each page's directory, resolution and pixels in this order; little endian.
std::filesystem::path tiff_of(const std::vector<Page>& pages, bool large = false) {
  const auto n = [](std::uint64_t value, std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
    return bytes;
  };
  const std::size_t width = large ? 8 : 4, count = large ? 8 : 2;
  std::string bytes = large ? "II" + n(43, 2) + n(8, 2) + n(0, 2) : "II" + n(42, 2);
  bytes += n(bytes.size() + width, width);
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const auto& [image, reduced, per_cm] = pages[i];
    const std::size_t tags = per_cm > 0 ? 12 : 10;
    const std::size_t resolution = bytes.size() + count + tags * (4 + 2 * width) + width;
    std::map<int, std::uint64_t> entries{{254, reduced ? 1 : 0},
                                         {256, image.cols},
                                         {257, image.rows},
                                         {258, 8},
                                         {259, 1},
                                         {262, 1},
                                         {273, resolution + 8},
                                         {277, 1},
                                         {278, image.rows},
                                         {279, image.total()}};
    if (per_cm > 0) entries.insert({{282, resolution}, {296, 3}});
    bytes += n(tags, count);
    for (const auto& [tag, value] : entries)
      bytes += n(static_cast<std::uint64_t>(tag), 2) +
               n(tag == 282 ? 5
                 : large    ? 16
                            : 4,
                 2) +
               n(1, width) + n(value, width);
    const std::size_t end = resolution + 8 + image.total();
    bytes += n(i + 1 < pages.size() ? end : 0, width) + n(per_cm, 4) + n(1, 4) +
             std::string(image.ptr<char>(), image.total());
  }
  const auto file = test::write(pages.front().image, "pages.tif");
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

cv::Mat shrunk(const cv::Mat& image, int times) {
  cv::Mat small;
  cv::resize(image, small, image.size() / times, 0.0, 0.0, cv::INTER_AREA);
  return small;
}

class TiffPagesOf : public testing::Test {
 protected:
  const test::DrawnSection drawn_ =
      test::draw({.width = 300, .height = 260, .noise = 0.05, .blur = 0.7});
  const cv::Mat& image_ = drawn_.image;
};

TEST_F(TiffPagesOf, APyramidAreOneSection) {
  for (const bool large : {false, true}) {
    const auto file =
        tiff_of({{image_}, {shrunk(image_, 2), true}, {shrunk(image_, 4), true}}, large);
    const auto measured = measure_sections(file, {});
    ASSERT_EQ(measured.size(), 1U) << large;
    const calib::SectionPorosity& section = measured.front().porosity;
    EXPECT_NEAR(section.porosity, drawn_.porosity, 5e-3);
    EXPECT_EQ(section.file, file.string());
    EXPECT_THAT(section.warnings,
                testing::Contains("2 pages left out: reduced copies of others, by the file's own "
                                  "words"));
  }
}

// The pixel size is that of a page that is measured, and pages keep their numbers.
TEST_F(TiffPagesOf, TwoSectionsBehindAThumbnailKeepTheirSizeAndNumbers) {
  const auto file =
      tiff_of({{shrunk(image_, 4), true, 1250}, {image_, false, 5000}, {image_, false, 5000}});
  const auto measured = measure_sections(file, {});
  ASSERT_EQ(measured.size(), 2U);
  EXPECT_NEAR(measured[0].porosity.pixel_size, 2e-6, 1e-12);
  EXPECT_THAT(measured[0].porosity.file, testing::EndsWith(" page 2"));
  EXPECT_THAT(measured[1].porosity.file, testing::EndsWith(" page 3"));
  EXPECT_THAT(measured[1].porosity.warnings,
              testing::Contains(testing::StartsWith("1 page left out")));
}

TEST_F(TiffPagesOf, ReducedCopiesAloneAreSections) {
  EXPECT_EQ(measure_sections(tiff_of({{image_, true}, {image_, true}}), {}).size(), 2U);
}

TEST_F(TiffPagesOf, DifferentPixelsAreRefusedUnlessOneSizeIsGiven) {
  const auto file = tiff_of({{image_, false, 5000}, {image_, false, 2500}});
  const Problem problem = test::first_problem_of([&] { measure_sections(file, {}); });
  EXPECT_EQ(problem.what, "its pages state different pixels, of 2 and 4 µm");
  EXPECT_EQ(problem.hint,
            "save them as files of their own, or give one size for all with --pixel-size-um (in a "
            "study pixel_size_um)");
  const auto measured = measure_sections(file, {.pixel_size = 2e-6});
  ASSERT_EQ(measured.size(), 2U);
  EXPECT_THAT(measured[1].porosity.warnings,
              testing::Contains("the file states pixels of 4 µm; 2 µm are used, as given"));
  // What a page does not say is as on the first.
  EXPECT_EQ(measure_sections(tiff_of({{image_, false, 5000}, {image_}}), {}).size(), 2U);
}

}  // namespace
}  // namespace havers::io
