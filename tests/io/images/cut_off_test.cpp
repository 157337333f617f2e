// Files that end too soon: refused, with their name, never measured in part.
#include "io/images/cut_off.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <map>

#include "io/images/measure_section.hpp"
#include "io/input_error.hpp"
#include "tests/support/sections.hpp"

namespace havers::io {
namespace {

// What is said of the file's first `share`; empty when it is measured.
std::string said_of_the_first(double share, const std::filesystem::path& file) {
  const auto part = file.parent_path() / ("cut_" + file.filename().string());
  std::filesystem::copy_file(file, part, std::filesystem::copy_options::overwrite_existing);
  const auto size = static_cast<double>(std::filesystem::file_size(file));
  std::filesystem::resize_file(part, static_cast<std::uintmax_t>(share * size));
  try {
    measure_sections(part, {});
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1U);
    EXPECT_NE(std::string(error.what()).find(part.string()), std::string::npos);
    return error.what();
  }
  return "";
}

std::string little_endian(std::uint64_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
  return bytes;
}

// A page's directory as far as the place of the next one; `large` has places of 64 bits.
std::string directory_of(const cv::Mat& image, std::size_t pixels, bool large) {
  const std::size_t width = large ? 8 : 4;
  std::string bytes = little_endian(9, large ? 8 : 2);
  for (const auto& [tag, value] : std::map<int, std::size_t>{{256, image.cols},
                                                             {257, image.rows},
                                                             {258, 8},
                                                             {259, 1},
                                                             {262, 1},
                                                             {273, pixels},
                                                             {277, 1},
                                                             {278, image.rows},
                                                             {279, image.total()}})
    bytes += little_endian(static_cast<std::uint64_t>(tag), 2) + little_endian(large ? 16 : 4, 2) +
             little_endian(1, width) + little_endian(value, width);
  return bytes;
}

std::filesystem::path made_of(const std::string& bytes, const cv::Mat& image) {
  const auto file = test::write(image, "made.tif");
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

// A TIFF as ImageJ writes it, its directory before its pixels; or a large one of 64-bit places.
std::filesystem::path directory_first(const cv::Mat& image, bool large) {
  const std::size_t width = large ? 8 : 4, begin = large ? 16 : 8;
  const std::size_t pixels = begin + directory_of(image, 0, large).size() + width;
  return made_of((large ? "II" + little_endian(43, 2) + little_endian(8, 2) + little_endian(0, 2)
                        : "II" + little_endian(42, 2)) +
                     little_endian(begin, width) + directory_of(image, pixels, large) +
                     little_endian(0, width) + std::string(image.ptr<char>(), image.total()),
                 image);
}

class CutOff : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, CutOff, testing::Values("png", "tif", "jpg", "bmp"),
                         [](const auto& ending) { return ending.param; });

TEST_P(CutOff, AFileIsRefused) {
  const auto drawn = test::draw({.width = 300, .height = 260, .noise = 0.05, .blur = 0.7});
  const auto file = test::write(drawn.image, std::string("whole.") + GetParam());
  EXPECT_EQ(said_of_the_first(1.0, file), "");
  testing::internal::CaptureStderr();
  for (const double share : {0.02, 0.3, 0.6, 0.9, 0.99})
    EXPECT_NE(said_of_the_first(share, file), "") << share;
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "libraries have no word of their own";
}

TEST(CutOffPng, ThatIsDamagedIsNamedInOneSentence) {
  const auto drawn = test::draw({.width = 300, .height = 260, .noise = 0.05, .blur = 0.7});
  const auto file = test::write(drawn.image, "damaged.png");
  std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
  bytes.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file) / 2));
  bytes << "not what was there";
  bytes.close();
  testing::internal::CaptureStderr();
  EXPECT_THAT(said_of_the_first(1.0, file),
              testing::EndsWith("is cut off or damaged (copy or export it again)"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(CutOffTiff, OfSeveralPagesIsRefused) {
  for (const int compression : {1, 5}) {  // None, LZW.
    for (const int bits : {8, 16}) {
      const auto drawn =
          test::draw({.width = 300, .height = 260, .noise = 0.05, .blur = 0.7, .bits = bits});
      const auto file = test::write(drawn.image, "pages.tif");
      cv::imwrite(file.string(), std::vector<cv::Mat>(3, drawn.image),
                  {cv::IMWRITE_TIFF_COMPRESSION, compression});
      EXPECT_EQ(said_of_the_first(1.0, file), "");
      for (const double share : {0.1, 0.3, 0.34, 0.5, 0.67, 0.8, 0.95, 0.999})
        EXPECT_NE(said_of_the_first(share, file), "") << share;
      EXPECT_NE(said_of_the_first(0.8, file).find("only 2 of at least 3 pages can be read"),
                std::string::npos);
    }
  }
}

TEST(CutOffTiff, WhosePixelsAreBehindItsDirectoryIsRefused) {
  const auto drawn = test::draw({.width = 300, .height = 260, .noise = 0.05, .blur = 0.7});
  for (const bool large : {false, true}) {
    const auto file = directory_first(drawn.image, large);
    const double porosity = measure_sections(file, {}).front().porosity.porosity;
    EXPECT_NEAR(porosity, drawn.porosity, 5e-3);
    for (const double share : {0.01, 0.3, 0.6, 0.9, 0.999})
      EXPECT_NE(said_of_the_first(share, file), "") << share << large;
  }
}

// The first page is whole: what tells of the second is the place of its directory.
TEST(CutOffTiff, WithinThePlaceOfTheNextDirectoryIsRefused) {
  const auto drawn = test::draw({.width = 300, .height = 260, .noise = 0.05, .blur = 0.7});
  const cv::Mat& image = drawn.image;
  const std::string pixels(image.ptr<char>(), image.total());
  const std::size_t directory = 8 + pixels.size();
  const std::string first = directory_of(image, 8, false);
  const std::size_t next = directory + first.size(), second = next + 4;
  const auto file = made_of("II" + little_endian(42, 2) + little_endian(directory, 4) + pixels +
                                first + little_endian(second + pixels.size(), 4) + pixels +
                                directory_of(image, second, false) + little_endian(0, 4),
                            image);
  EXPECT_EQ(measure_sections(file, {}).size(), 2U);
  const auto size = static_cast<double>(std::filesystem::file_size(file));
  for (const double kept : {0.5, 1.5, 2.5, 3.5})  // bytes of four, and the rounding
    EXPECT_NE(said_of_the_first((static_cast<double>(next) + kept) / size, file)
                  .find("only 1 of at least 2 pages can be read"),
              std::string::npos)
        << kept;
}

}  // namespace
}  // namespace havers::io
