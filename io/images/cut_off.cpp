// No pixel is decoded to tell whether a file is whole: a JPEG must have its end marker, a BMP the
// length that its header asks for, a PNG its check sums, a TIFF no more pages than were read.
#include "io/images/cut_off.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "io/images/file_bytes.hpp"
#include "io/images/tiff_pages.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

// A page counts even where the file ends before its directory, or within the place of that.
std::size_t pages_of_tiff(const std::filesystem::path& file) {
  FileBytes bytes(file);
  const TiffPages found = tiff_pages(bytes);
  return found.pages.size() + (found.cut_off ? 1 : 0);
}

// The last scan ends with the marker of the image's end; a thumbnail has one of its own, before.
bool is_cut_off_jpeg(const std::filesystem::path& file) {
  if (FileBytes(file).text(0, 3) != "\xFF\xD8\xFF") return false;
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto scan = bytes.rfind("\xFF\xDA"), end = bytes.rfind("\xFF\xD9");
  return scan == std::string::npos || end == std::string::npos || end < scan;
}

// Without compression its size follows from its header: rows of whole words, behind the place that
// is named; a negative height counts from the top.
bool is_cut_off_bmp(const std::filesystem::path& file) {
  FileBytes bytes(file);
  if (bytes.text(0, 2) != "BM") return false;
  bytes.set_big_endian(false);
  // Headers shorter than 40 bytes, of older versions, do not state a compression.
  if (bytes.number(14, 4) < 40 || bytes.number(30, 4) != 0) return false;
  const Offset row = (bytes.number(18, 4) * bytes.number(28, 2) + 31) / 32 * 4;
  const std::int64_t height = static_cast<std::int32_t>(bytes.number(22, 4));
  const auto rows = static_cast<Offset>(std::abs(height));
  return std::filesystem::file_size(file) < bytes.number(10, 4) + row * rows;
}

// A chunk is its length, its name, its data and a check sum; one whose name starts with a capital
// cannot be done without, and the last is IEND.
bool is_damaged_png(const std::filesystem::path& file) {
  if (FileBytes(file).text(0, 8) != "\x89PNG\r\n\x1a\n") return false;
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto number_at = [&](std::size_t at) {
    std::size_t number = 0;
    for (const char byte : bytes.substr(at, 4))
      number = number << 8U | static_cast<unsigned char>(byte);
    return number;
  };
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = number_at(at), sum = at + 8 + length;
    if (sum + 4 > bytes.size()) return true;
    // Bit 5 of an ASCII letter is set in a small letter and not in a capital.
    const bool needed = (static_cast<unsigned char>(bytes[at + 4]) & 0x20U) == 0;
    if (needed && libdeflate_crc32(0, &bytes[at + 4], length + 4) != number_at(sum)) return true;
    if (bytes.compare(at + 4, 4, "IEND") == 0) return false;
    at = sum + 4;
  }
  return true;
}

}  // namespace

void check_is_whole(const std::filesystem::path& file) {
  if (is_cut_off_jpeg(file) || is_cut_off_bmp(file))
    throw io::InputError(file.string(), "is cut off: its end is missing",
                         "copy or export it again");
  if (is_damaged_png(file))
    throw io::InputError(file.string(), "is cut off or damaged", "copy or export it again");
}

void check_all_was_read(const std::filesystem::path& file, std::size_t pages_read) {
  if (const std::size_t pages = pages_of_tiff(file); pages_read < pages)
    throw io::InputError(
        file.string(),
        fmt::format("only {} of at least {} pages can be read: it is cut off or damaged",
                    pages_read, pages),
        "copy or export it again");
}

}  // namespace havers::images
