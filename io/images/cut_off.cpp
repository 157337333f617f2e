// No pixel is decoded to tell whether a file is whole: a JPEG must have its end marker, a BMP the
// length that its header asks for, a PNG its check sums, a TIFF no more pages than were read.
#include "io/images/cut_off.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "io/images/file_bytes.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

// Each page has a directory: how many tags, the tags, and the place of the next one, which counts
// even where the file ends before it, or within its place.
std::size_t pages_of_tiff(const std::filesystem::path& file) {
  FileBytes bytes(file);
  const std::string order = bytes.text(0, 2);
  bytes.set_big_endian(order == "MM");
  const Offset version = bytes.number(2, 2);
  if ((order != "MM" && order != "II") || (version != 42 && version != 43)) return 0;
  const bool large = version == 43;  // BigTIFF
  // Bytes of an offset, of the number of tags, and of one tag.
  const std::size_t place = large ? 8 : 4, count = large ? 8 : 2, tag = large ? 20 : 12;
  // Offset 0 ends the list. So does a directory met before: in a damaged file they may form a loop.
  std::set<Offset> passed{0};
  for (Offset at = bytes.number(place, place); passed.insert(at).second;) {
    const Offset next = at + count + tag * bytes.number(at, count);
    if (bytes.text(next, place).size() < place) return passed.size();
    at = bytes.number(next, place);
  }
  return passed.size() - 1;
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
