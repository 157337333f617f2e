// PNG files byte by byte: every kind of pixel under every filter, and what is left to OpenCV.
#include "io/images/png.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace havers::images {
namespace {

std::string big_endian(std::size_t value) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(value >> shift & 255U);
  return bytes;
}

std::string chunk(const std::string& name, const std::string& data) {
  return big_endian(data.size()) + name + data + std::string(4, '\0');
}

// In one block that is not packed, with its check sum.
std::string zlib_of(const std::string& data) {
  std::size_t a = 1, b = 0;
  for (const char c : data) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521U;
    b = (b + a) % 65521U;
  }
  const auto low = static_cast<char>(data.size() & 255U),
             high = static_cast<char>(data.size() >> 8U);
  return std::string{0x78, 0x01, 0x01, low, high} + static_cast<char>(~low) +
         static_cast<char>(~high) + data + big_endian(b << 16U | a);
}

// The standard's guess: of left, up and left up, the first that is nearest to left + up − left up.
int paeth(int left, int up, int corner) {
  const int p = left + up - corner;
  int best = left;
  for (const int one : {up, corner})
    if (std::abs(p - one) < std::abs(p - best)) best = one;
  return best;
}

struct Picture {
  int width = 0, height = 0, bits = 8, colour = 0, interlace = 0;
  int step = 1;       // Bytes a pixel.
  std::string bytes;  // Row by row.

  [[nodiscard]] int at(int y, int i) const {
    const int place = y * width * step + i;
    return y < 0 || i < 0 ? 0 : static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(place)]);
  }
};

Picture picture_of(int bits, int colour, int step) {
  Picture picture{.width = 23, .height = 17, .bits = bits, .colour = colour, .step = step};
  for (int i = 0; i < picture.width * picture.height * step; ++i)
    picture.bytes += static_cast<char>(i * i / 7 + i % 5 * 40);
  return picture;
}

// Row y under filter y modulo 5.
std::string png_of(const Picture& picture) {
  std::string rows;
  for (int y = 0; y < picture.height; ++y) {
    rows += static_cast<char>(y % 5);
    for (int i = 0; i < picture.width * picture.step; ++i) {
      const int left = i < picture.step ? 0 : picture.at(y, i - picture.step);
      const int up = picture.at(y - 1, i);
      const int corner = i < picture.step ? 0 : picture.at(y - 1, i - picture.step);
      const std::array<int, 5> guess{0, left, up, (left + up) / 2, paeth(left, up, corner)};
      rows += static_cast<char>(picture.at(y, i) - guess[static_cast<std::size_t>(y % 5)]);
    }
  }
  const std::string packed = zlib_of(rows);
  const std::string header = big_endian(static_cast<std::size_t>(picture.width)) +
                             big_endian(static_cast<std::size_t>(picture.height)) +
                             static_cast<char>(picture.bits) + static_cast<char>(picture.colour) +
                             std::string(2, '\0') + static_cast<char>(picture.interlace);
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", packed.substr(0, 100)) +
         chunk("IDAT", packed.substr(100)) + chunk("IEND", "");
}

class Png : public testing::Test {
 protected:
  [[nodiscard]] cv::Mat read(const std::string& bytes) const {
    return read_png(folder_.write("image.png", bytes));
  }

 private:
  test::ScratchFolder folder_;
};

TEST_F(Png, IsReadUnderEveryFilter) {
  const Picture grey = picture_of(8, 0, 1);
  const cv::Mat image = read(png_of(grey));
  ASSERT_EQ(image.type(), CV_8UC1);
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x) ASSERT_EQ(image.at<std::uint8_t>(y, x), grey.at(y, x));
}

TEST_F(Png, Of16BitsHasItsHighByteFirst) {
  const Picture grey = picture_of(16, 0, 2);
  const cv::Mat image = read(png_of(grey));
  ASSERT_EQ(image.type(), CV_16UC1);
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x)
      ASSERT_EQ(image.at<std::uint16_t>(y, x), 256 * grey.at(y, 2 * x) + grey.at(y, 2 * x + 1));
}

TEST_F(Png, OfColoursIsInTheOrderOfOpenCv) {
  for (const int step : {3, 4}) {
    const Picture colours = picture_of(8, step == 3 ? 2 : 6, step);
    const cv::Mat image = read(png_of(colours));
    ASSERT_EQ(image.type(), CV_MAKETYPE(CV_8U, step));
    for (int y = 0; y < colours.height; ++y)
      for (int x = 0; x < colours.width; ++x) {
        const auto* pixel = image.ptr<std::uint8_t>(y, x);
        for (int c = 0; c < step; ++c)
          ASSERT_EQ(pixel[c < 3 ? 2 - c : 3], colours.at(y, step * x + c));
      }
  }
}

TEST_F(Png, OfOtherKindsIsLeftToOpenCv) {
  EXPECT_TRUE(read(png_of(picture_of(8, 3, 1))).empty());   // of a palette
  EXPECT_TRUE(read(png_of(picture_of(8, 4, 2))).empty());   // grey and transparent
  EXPECT_TRUE(read(png_of(picture_of(16, 2, 6))).empty());  // colours of 16 bits
  Picture interlaced = picture_of(8, 0, 1);
  interlaced.interlace = 1;
  EXPECT_TRUE(read(png_of(interlaced)).empty());
  std::string transparent = png_of(picture_of(8, 0, 1));
  transparent.insert(33, chunk("tRNS", std::string(2, '\0')));
  EXPECT_TRUE(read(transparent).empty());
}

TEST_F(Png, ThatIsDamagedIsLeftToOpenCv) {
  const std::string whole = png_of(picture_of(8, 0, 1)), end = chunk("IEND", "");
  for (std::size_t length = 0; length < whole.size() - end.size(); ++length)
    ASSERT_TRUE(read(whole.substr(0, length)).empty()) << length;
  EXPECT_FALSE(read(whole.substr(0, whole.size() - end.size())).empty());
  for (const std::size_t place : {20U, 48U, 60U, 300U}) {  // height, first filter, rows
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] + 5);
    EXPECT_TRUE(read(damaged).empty()) << place;
  }
}

}  // namespace
}  // namespace havers::images
