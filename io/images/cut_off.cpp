#include "io/images/cut_off.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "io/images/file_bytes.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

// A tag of a TIFF: its name, its values' type, their count, and a value or the place of several.
struct Tag {
  Offset place = 0;
  std::size_t width = 4;  // Of counts and places: 8 in a BigTIFF.

  [[nodiscard]] Offset last_value(FileBytes& bytes) const {
    const Offset type = bytes.number(place + 2, 2), count = bytes.number(place + 4, width);
    const std::size_t size = type == 3 ? 2 : (type == 4 ? 4 : 8);
    const Offset values = place + 4 + width, last = (count - 1) * size;
    if (count == 0) return 0;
    return bytes.number((count * size <= width ? values : bytes.number(values, width)) + last,
                        size);
  }
};

// A TIFF's directories, each of which leads to the next; one beyond the file's end counts.
struct Chain {
  std::size_t pages = 0;
  Offset end = 0;  // Of them and of the pixels they speak of.
};

// Where the pixels of a page end, by its last strip or tile.
Offset end_of_pixels(FileBytes& bytes, Tag tag, Offset tags) {
  Offset start = 0, length = 0;
  for (Offset i = 0; i < tags; ++i, tag.place += 4 + 2 * tag.width) {
    const Offset name = bytes.number(tag.place, 2);
    if (name == 273 || name == 324) start = tag.last_value(bytes);
    if (name == 279 || name == 325) length = tag.last_value(bytes);
  }
  return start + length;
}

// Directories: how many tags, the tags, and the place of the next directory.
Chain follow(const std::filesystem::path& file) {
  FileBytes bytes(file);
  Chain chain;
  const std::string order = bytes.text(0, 2);
  bytes.set_big_endian(order == "MM");
  const Offset version = bytes.number(2, 2);
  if ((order != "MM" && order != "II") || (version != 42 && version != 43)) return chain;
  const std::size_t width = version == 43 ? 8 : 4, count = version == 43 ? 8 : 2;
  std::set<Offset> passed{0};
  for (Offset at = bytes.number(width, width); passed.insert(at).second; ++chain.pages) {
    const Offset tags = std::min<Offset>(bytes.number(at, count), 65535);
    const Offset end = at + count + tags * (4 + 2 * width);
    chain.end = std::max({chain.end, end + width, end_of_pixels(bytes, {at + count, width}, tags)});
    at = bytes.number(end, width);
  }
  return chain;
}

// The last scan ends with the marker of the image's end; a thumbnail has one of its own, before.
bool is_cut_off_jpeg(const std::filesystem::path& file) {
  if (FileBytes(file).text(0, 3) != "\xFF\xD8\xFF") return false;
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto scan = bytes.rfind("\xFF\xDA"), end = bytes.rfind("\xFF\xD9");
  return scan == std::string::npos || end == std::string::npos || end < scan;
}

}  // namespace

void check_all_was_read(const std::filesystem::path& file, std::size_t pages_read) {
  const Chain chain = follow(file);
  if (chain.end > std::filesystem::file_size(file) || is_cut_off_jpeg(file))
    throw io::InputError(file.string(), "is cut off: its end is missing",
                         "copy or export it again");
  if (pages_read < chain.pages)
    throw io::InputError(
        file.string(), fmt::format("only {} of its {} pages can be read", pages_read, chain.pages),
        "export each page as an image of its own");
}

}  // namespace havers::images
