// What a file says of its pixels: tags of PNG, TIFF and DICOM, byte by byte.
#include "io/images/pixel_size_tag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "io/images/measure_section.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/sections.hpp"

namespace havers::images {
namespace {

enum class Order { big, little };

std::string number(std::uint32_t value, int size, Order order) {
  std::string bytes;
  for (int i = 0; i < size; ++i) {
    const int shift = 8 * (order == Order::big ? size - 1 - i : i);
    bytes += static_cast<char>((value >> static_cast<unsigned>(shift)) & 0xFFU);
  }
  return bytes;
}

// A PNG as far as its pHYs chunk.
std::string png(std::uint32_t per_unit, int unit, std::uint32_t down = 0) {
  const auto big = [](std::uint32_t value, int size) { return number(value, size, Order::big); };
  const std::string header = "\x89PNG\r\n\x1a\n" + big(13, 4) + "IHDR" + std::string(17, '\0');
  return header + big(9, 4) + "pHYs" + big(per_unit, 4) + big(down > 0 ? down : per_unit, 4) +
         static_cast<char>(unit) + big(0, 4);
}

// A TIFF's first directory: resolution, its unit, and a description behind it.
std::string tiff(Order order, double resolution, int unit, const std::string& description) {
  const auto n = [order](std::uint32_t value, int size) { return number(value, size, order); };
  const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t count,
                         const std::string& value) {
    return n(tag, 2) + n(type, 2) + n(count, 4) + value;
  };
  const std::uint32_t behind = 8 + 2 + 3 * 12 + 4;
  const auto length = static_cast<std::uint32_t>(description.size());
  return (order == Order::big ? std::string("MM\0*", 4) : std::string("II*\0", 4)) + n(8, 4) +
         n(3, 2) + entry(270, 2, length, n(behind + 8, 4)) + entry(282, 5, 1, n(behind, 4)) +
         entry(296, 3, 1, n(static_cast<std::uint32_t>(unit), 2) + n(0, 2)) + n(0, 4) +
         n(static_cast<std::uint32_t>(std::lround(1000.0 * resolution)), 4) + n(1000, 4) +
         description;
}

std::string dicom_element(std::uint32_t group, std::uint32_t element, const std::string& type,
                          std::string data) {
  const auto n = [](std::size_t value, int size) {
    return number(static_cast<std::uint32_t>(value), size, Order::little);
  };
  if (data.size() % 2 == 1) data += type == "UI" ? '\0' : ' ';
  const std::string length = type == "OW" ? n(0, 2) + n(data.size(), 4) : n(data.size(), 2);
  return n(group, 2) + n(element, 2) + type + length + data;
}

// A whole slice, explicit little endian, 8-bit levels spread over 16.
std::string dicom(const std::string& spacing, const cv::Mat& image,
                  const std::string& at_the_detector = {}) {
  const auto word = [](int value) {
    return number(static_cast<std::uint32_t>(value), 2, Order::little);
  };
  const std::string slice = "1.2.840.10008.5.1.4.1.1.2";
  const std::string meta = dicom_element(2, 2, "UI", slice) + dicom_element(2, 3, "UI", "1.2.3") +
                           dicom_element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
  std::string pixels;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) pixels += word(100 * image.at<std::uint8_t>(y, x));
  const auto size = number(static_cast<std::uint32_t>(meta.size()), 4, Order::little);
  return std::string(128, '\0') + "DICM" + dicom_element(2, 0, "UL", size) + meta +
         dicom_element(8, 0x16, "UI", slice) + dicom_element(8, 0x18, "UI", "1.2.3") +
         (at_the_detector.empty() ? "" : dicom_element(0x18, 0x1164, "DS", at_the_detector)) +
         dicom_element(0x28, 2, "US", word(1)) + dicom_element(0x28, 4, "CS", "MONOCHROME2") +
         dicom_element(0x28, 0x10, "US", word(image.rows)) +
         dicom_element(0x28, 0x11, "US", word(image.cols)) +
         (spacing.empty() ? "" : dicom_element(0x28, 0x30, "DS", spacing)) +
         dicom_element(0x28, 0x100, "US", word(16)) + dicom_element(0x28, 0x101, "US", word(16)) +
         dicom_element(0x28, 0x102, "US", word(15)) + dicom_element(0x28, 0x103, "US", word(0)) +
         dicom_element(0x7FE0, 0x10, "OW", pixels);
}

class PixelSizeTag : public testing::Test {
 protected:
  std::filesystem::path file_of(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
    return folder_.path() / name;
  }
  // NaN where the file says nothing. [µm]
  double size_of(const std::string& bytes) {
    return 1e6 * tagged_pixel_size(file_of("tagged", bytes)).value_or(NAN);
  }

 private:
  test::ScratchFolder folder_;
};

TEST_F(PixelSizeTag, OfAPngIsInPixelsAMetre) {
  EXPECT_NEAR(size_of(png(200000, 1)), 5.0, 1e-9);
  EXPECT_TRUE(std::isnan(size_of(png(200000, 0))));  // a ratio of sides, not a size
  EXPECT_TRUE(std::isnan(size_of(png(0, 1))));
  EXPECT_TRUE(std::isnan(size_of(png(200000, 1, 100000))));  // no square
}

TEST_F(PixelSizeTag, OfATiffIsInItsUnitInEitherOrderOfBytes) {
  for (const Order order : {Order::big, Order::little}) {
    EXPECT_NEAR(size_of(tiff(order, 2500.0, 3, "")), 4.0, 1e-9);
    EXPECT_NEAR(size_of(tiff(order, 10160.0, 2, "")), 2.5, 1e-9);
    EXPECT_TRUE(std::isnan(size_of(tiff(order, 2500.0, 1, ""))));
  }
}

TEST_F(PixelSizeTag, OfImageJIsInTheUnitOfItsDescription) {
  struct Unit {
    const char* name;
    double per_unit, size;
  };
  for (const auto& [name, per_unit, size] : {Unit{"micron", 0.5, 2.0},
                                             {"um", 0.5, 2.0},
                                             {"\\u00B5m", 0.5, 2.0},
                                             {"nm", 0.5, 0.002},
                                             {"mm", 250.0, 4.0},
                                             {"cm", 2500.0, 4.0},
                                             {"inch", 5080.0, 5.0}})
    EXPECT_NEAR(
        size_of(tiff(Order::little, per_unit, 1, "ImageJ=1.53\nunit=" + std::string(name) + "\n")),
        size, 1e-9)
        << name;
  EXPECT_TRUE(std::isnan(size_of(tiff(Order::little, 0.5, 1, "ImageJ=1.53\nunit=pixel\n"))));
  // Depth, values and a microscope's own words have other units.
  for (const char* other : {"zunit=mm\nunit=micron\n", "unit=micron\nvunit=nm\n"})
    EXPECT_NEAR(size_of(tiff(Order::little, 0.5, 1, std::string("ImageJ=1.53\n") + other)), 2.0,
                1e-9)
        << other;
  EXPECT_NEAR(size_of(tiff(Order::little, 5000.0, 3, "stage 3.2, unit=mm")), 2.0, 1e-9);
}

TEST_F(PixelSizeTag, OfAPrinterOrScreenIsNone) {
  for (const double dots : {72.0, 96.0, 150.0, 300.0, 600.0, 2400.0})
    EXPECT_TRUE(std::isnan(size_of(tiff(Order::little, dots, 2, "")))) << dots;
  EXPECT_TRUE(std::isnan(size_of(png(2835, 1))));  // 72 dots an inch
  EXPECT_NEAR(size_of(tiff(Order::little, 2540.0, 2, "")), 10.0, 1e-9);
  EXPECT_NEAR(size_of(tiff(Order::little, 4800.0, 2, "")), 25400.0 / 4800.0, 1e-9);
}

// The resolution itself lies behind the directory.
TEST_F(PixelSizeTag, OfAFileCutShortIsNoneOrTheSame) {
  constexpr std::size_t end = 58;
  for (const Order order : {Order::big, Order::little}) {
    const std::string whole = tiff(order, 2500.0, 3, "behind");
    for (std::size_t length = 0; length < end; ++length)
      EXPECT_TRUE(std::isnan(size_of(whole.substr(0, length)))) << length;
    for (std::size_t length = end; length <= whole.size(); ++length)
      EXPECT_NEAR(size_of(whole.substr(0, length)), 4.0, 1e-9) << length;
  }
}

// The resolution lies before the directory: where the entry of its unit is cut off, it would be
// taken as one an inch.
TEST_F(PixelSizeTag, OfATiffWithoutTheUnitThatItHadIsNone) {
  for (const Order order : {Order::big, Order::little}) {
    const auto n = [order](std::uint32_t value, int size) { return number(value, size, order); };
    const std::string whole = (order == Order::big ? std::string("MM\0*", 4) : "II*" + n(0, 1)) +
                              n(16, 4) + n(2500, 4) + n(1, 4) + n(2, 2) + n(282, 2) + n(5, 2) +
                              n(1, 4) + n(8, 4) + n(296, 2) + n(3, 2) + n(1, 4) + n(3, 2) + n(0, 2);
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_TRUE(std::isnan(size_of(whole.substr(0, length)))) << length;
    EXPECT_NEAR(size_of(whole), 4.0, 1e-9);
  }
}

TEST_F(PixelSizeTag, OfADicomSliceComesWithItsPixels) {
  const auto drawn = test::draw({.width = 300, .height = 260, .porosity = 0.1, .blur = 0.7});
  const auto file = file_of("slice.dcm", dicom("0.0082\\0.0082", drawn.image));
  EXPECT_NEAR(1e6 * tagged_pixel_size(file).value(), 8.2, 1e-9);
  const auto wide = file_of("wide.dcm", dicom("0.0082\\0.0164", drawn.image));
  EXPECT_EQ(tagged_pixel_size(wide), std::nullopt);
  const auto measured = io::measure_sections(file, {}).front().porosity;
  EXPECT_NEAR(measured.pixel_size, 8.2e-6, 1e-12);
  EXPECT_NEAR(measured.porosity, drawn.porosity, 3e-3);
}

// The spacing in the body counts, which comes behind that at the detector.
TEST_F(PixelSizeTag, OfADicomSliceIsTheOneThatIsCalibrated) {
  const cv::Mat image(4, 4, CV_8U, cv::Scalar(9));
  EXPECT_NEAR(size_of(dicom("0.0082\\0.0082", image, "0.01\\0.01")), 8.2, 1e-9);
  EXPECT_NEAR(size_of(dicom("", image, "0.01\\0.01")), 10.0, 1e-9);
}

// Without types, as the oldest syntax is; and inside a sequence whose length is not told.
TEST_F(PixelSizeTag, OfADicomSliceIsFoundInEverySyntax) {
  const auto n = [](std::uint32_t value, int size) { return number(value, size, Order::little); };
  const std::string start = std::string(128, '\0') + "DICM";
  const std::string spacing = "0.0082\\0.0082 ";
  const auto untyped = [&](std::uint32_t group, std::uint32_t element, const std::string& data) {
    return n(group, 2) + n(element, 2) + n(static_cast<std::uint32_t>(data.size()), 4) + data;
  };
  EXPECT_NEAR(size_of(start + dicom_element(2, 0x10, "UI", "1.2.840.10008.1.2") +
                      untyped(8, 0x70, "maker ") + untyped(0x28, 0x30, spacing)),
              8.2, 1e-9);
  const std::string endless = n(0xFFFFFFFFU, 4);
  EXPECT_NEAR(size_of(start + dicom_element(2, 0x10, "UI", "1.2.840.10008.1.2.1") + n(0x5200, 2) +
                      n(0x9229, 2) + "SQ" + n(0, 2) + endless + n(0xFFFE, 2) + n(0xE000, 2) +
                      endless + dicom_element(0x28, 0x30, "DS", spacing)),
              8.2, 1e-9);
}

// What is given counts; what the file says is compared with it.
TEST_F(PixelSizeTag, ThatDiffersFromTheGivenOneIsSaid) {
  const auto drawn = test::draw({.width = 300, .height = 260, .porosity = 0.1, .blur = 0.7});
  const auto file = file_of("slice.dcm", dicom("0.0082\\0.0082", drawn.image));
  const auto measured = io::measure_sections(file, {.pixel_size = 5e-6}).front().porosity;
  EXPECT_EQ(measured.pixel_size, 5e-6);
  ASSERT_FALSE(measured.warnings.empty());
  EXPECT_EQ(measured.warnings.front(), "the file states pixels of 8.2 µm; 5 µm are used, as given");
  const auto coarse = file_of("coarse.dcm", dicom("0.5\\0.5", drawn.image));
  const auto unsized = io::measure_sections(coarse, {}).front().porosity;
  EXPECT_TRUE(std::isnan(unsized.pixel_size));
  EXPECT_NE(unsized.warnings.front().find("not used, as it is outside 0.1 to 200 µm"),
            std::string::npos);
}

}  // namespace
}  // namespace havers::images
