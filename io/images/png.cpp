// A PNG is a list of chunks. Its pixels are one compressed stream of rows, and each byte is stored
// as its difference from a guess by the bytes before it. That is undone here for the common kinds
// of PNG; what is rare or damaged is left to OpenCV.
#include "io/images/png.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace havers::images {
namespace {

using ByteSpan = std::span<const std::uint8_t>;

struct PngFile {
  cv::Size size;
  int type = -1;                     // OpenCV's; −1: of a kind that is left to OpenCV.
  std::vector<std::uint8_t> packed;  // The data of all its chunks.
};

// The number of four bytes, the highest first.
std::uint32_t number_at(const std::uint8_t* place) {
  return (std::uint32_t{place[0]} << 24U) | (std::uint32_t{place[1]} << 16U) |
         (std::uint32_t{place[2]} << 8U) | place[3];
}

// Width, height, bits, kind of colour (0 grey, 2 colours, 6 with alpha), compression, filters,
// interlacing.
void read_header(const std::uint8_t* header, PngFile& png) {
  constexpr std::uint32_t longest = 1U << 20U;  // [px]
  const std::uint32_t width = number_at(header), height = number_at(header + 4);
  const int bits = header[8], colour = header[9];
  const bool interlaced = header[12] != 0;
  if (interlaced || std::min(width, height) == 0 || std::max(width, height) > longest) return;
  png.size = {static_cast<int>(width), static_cast<int>(height)};
  if (colour == 0 && bits == 16) png.type = CV_16UC1;
  if (colour == 0 && bits == 8) png.type = CV_8UC1;
  if (colour == 2 && bits == 8) png.type = CV_8UC3;
  if (colour == 6 && bits == 8) png.type = CV_8UC4;
}

// A chunk is its length, its name, its data and a check sum, which is not asked: what is packed has
// one of its own.
PngFile chunks_of(ByteSpan file) {
  static constexpr std::array<std::uint8_t, 8> signature{137, 'P', 'N', 'G', 13, 10, 26, 10};
  PngFile png;
  if (file.size() < 8 || !std::ranges::equal(file.first(8), signature)) return png;
  png.packed.reserve(file.size());
  for (std::size_t at = 8; at + 12 <= file.size();) {
    const std::size_t length = number_at(&file[at]);
    const std::string_view name(reinterpret_cast<const char*>(&file[at + 4]), 4);
    // Left to OpenCV: a file that is cut off, and one that makes a level transparent (tRNS).
    if (file.size() - at - 12 < length || name == "tRNS") return {};
    const ByteSpan data = file.subspan(at + 8, length);
    if (name == "IHDR" && length == 13) read_header(data.data(), png);
    if (name == "IDAT") png.packed.insert(png.packed.end(), data.begin(), data.end());
    at += length + 12;
  }
  return png;
}

// Rows of a byte that names the filter and the row itself; empty when damaged.
cv::Mat unpacked(const PngFile& png) {
  const std::size_t length =
      static_cast<std::size_t>(CV_ELEM_SIZE(png.type)) * static_cast<std::size_t>(png.size.width) +
      1;
  const std::size_t size = length * static_cast<std::size_t>(png.size.height);
  // A header may be wrong: no more is allocated than the data can fill.
  if (size / 1032 > png.packed.size()) return {};  // No data can be packed closer.
  cv::Mat rows(png.size.height, static_cast<int>(length), CV_8U);
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  // As the last argument is null, any other length than `size` is an error.
  const libdeflate_result result = libdeflate_zlib_decompress(
      reader.get(), png.packed.data(), png.packed.size(), rows.data, size, nullptr);
  return result == LIBDEFLATE_SUCCESS ? rows : cv::Mat();
}

// What is stored is the difference, modulo 256, from a guess by the neighbours: those `step` bytes,
// that is, one pixel to the left, and a row up. Beyond the left edge neighbours are zero.
template <std::size_t step, class Guess>
void add_guess(ByteSpan stored, const std::uint8_t* above, std::uint8_t* row, Guess guess) {
  std::array<int, step> left{}, corner{};
  for (std::size_t x = 0; x < stored.size(); x += step)
    for (std::size_t c = 0; c < step; ++c) {
      const int up = above[x + c];
      left[c] = (stored[x + c] + guess(left[c], up, corner[c])) & 255;
      corner[c] = up;
      row[x + c] = static_cast<std::uint8_t>(left[c]);
    }
}

// Paeth's guess: of left, up and corner the one nearest to left + up − corner. Of equally near ones
// it is the first in this order, as the standard demands.
int nearest(int left, int up, int corner) {
  const int to_left = std::abs(up - corner), to_up = std::abs(left - corner);
  const int to_corner = std::abs(left + up - 2 * corner);
  const int up_or_corner = to_up <= to_corner ? up : corner;
  return to_left <= std::min(to_up, to_corner) ? left : up_or_corner;
}

template <std::size_t step>
bool restore_row(int filter, ByteSpan stored, const std::uint8_t* above, std::uint8_t* row) {
  const auto with = [&](auto guess) { add_guess<step>(stored, above, row, guess); };
  if (filter == 0) with([](int, int, int) { return 0; });
  if (filter == 1) with([](int left, int, int) { return left; });
  if (filter == 2) with([](int, int up, int) { return up; });
  if (filter == 3) with([](int left, int up, int) { return (left + up) / 2; });
  if (filter == 4) with(nearest);
  // The standard has no filter beyond 4: such data are damaged.
  return filter <= 4;
}

template <std::size_t step>
bool restore(const cv::Mat& rows, cv::Mat& image) {
  // The neighbours above the first row are zero.
  const std::vector<std::uint8_t> nothing(static_cast<std::size_t>(rows.cols));
  const std::uint8_t* above = nothing.data();
  for (int y = 0; y < image.rows; ++y) {
    const ByteSpan stored(rows.ptr<std::uint8_t>(y), static_cast<std::size_t>(rows.cols));
    auto* row = image.ptr<std::uint8_t>(y);
    if (!restore_row<step>(stored[0], stored.subspan(1), above, row)) return false;
    above = row;
  }
  return true;
}

// At most as many bytes as a matrix can have; a longer file fails to decode and is left to OpenCV.
cv::Mat bytes_of(const std::filesystem::path& file) {
  constexpr std::uintmax_t most = std::numeric_limits<int>::max();
  cv::Mat bytes(1, static_cast<int>(std::min(std::filesystem::file_size(file), most)), CV_8U);
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.ptr<char>(), bytes.cols);
  return bytes.colRange(0, static_cast<int>(in.gcount()));
}

// Channels come as red, green, blue; 16 bits high byte first.
void to_own_order(cv::Mat& image) {
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_RGB2BGR);
  if (image.channels() == 4) cv::cvtColor(image, image, cv::COLOR_RGBA2BGRA);
  if (image.depth() != CV_16U) return;
  for (auto& value : cv::Mat_<std::uint16_t>(image)) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    value = static_cast<std::uint16_t>(bytes[0] << 8U | bytes[1]);
  }
}

}  // namespace

cv::Mat read_png(const std::filesystem::path& file) {
  const cv::Mat bytes = bytes_of(file);
  const PngFile png = chunks_of({bytes.data, bytes.total()});
  if (png.type < 0) return {};
  const cv::Mat rows = unpacked(png);
  if (rows.empty()) return {};
  // Bytes a pixel are a template's argument, so that the compiler can unroll loops over them.
  static constexpr std::array<decltype(&restore<1>), 4> restore_by_step{restore<1>, restore<2>,
                                                                        restore<3>, restore<4>};
  cv::Mat image(png.size, png.type);
  if (!restore_by_step[image.elemSize() - 1](rows, image)) return {};
  to_own_order(image);
  return image;
}

}  // namespace havers::images
