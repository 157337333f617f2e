// (I15) Tags are read byte by byte. Numbers of a damaged file may be anything; a size that comes
// out as 0 or as not finite means that it is unknown.
#include "io/images/pixel_size_tag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/images/file_bytes.hpp"
#include "io/images/tiff_pages.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

constexpr double inch = 25.4e-3;

// (I15) Sizes that are accepted without `any_pixel_size`. [m]
bool plausible(double size) {
  return size >= 0.1e-6 && size <= 200e-6;
}

// As a double, so that a division by zero is infinite and no crash.
double real(FileBytes& bytes, Offset at) {
  return static_cast<double>(bytes.number(at, 4));
}

// A whole number of dots an inch in steps of a dozen or of fifty is a printer's or screen's.
bool is_for_paper(double pixel) {
  const double dots = std::round(inch / pixel);
  const bool whole = std::abs(inch / pixel - dots) < 0.02;
  return whole && dots <= 2400.0 && (std::fmod(dots, 12.0) == 0.0 || std::fmod(dots, 50.0) == 0.0);
}

// Of pixels that are not square, none.
double square(double x, double y) {
  return std::abs(x - y) <= 0.01 * x ? x : 0.0;
}

// Chunks of a PNG: length, name, data, checksum. pHYs: pixels a unit in x and y, unit 1 is a metre.
double png_pixel(FileBytes& bytes) {
  for (Offset at = 8; bytes.text(at + 4, 4).size() == 4;) {
    const std::string name = bytes.text(at + 4, 4);
    if (name == "IDAT") break;
    if (name == "pHYs")
      return bytes.number(at + 16, 1) == 1
                 ? square(1.0 / real(bytes, at + 8), 1.0 / real(bytes, at + 12))
                 : 0.0;
    at += 12 + bytes.number(at, 4);
  }
  return 0.0;
}

// ImageJ writes pixels a unit as the resolution and the unit into the description, on a line of its
// own: one of depth (zunit) or of values (vunit) is none of pixels.
double unit_of(const std::string& description) {
  constexpr std::string_view key = "\nunit=";
  const std::string lines = '\n' + description;
  const auto start = lines.find(key);
  if (start == std::string::npos) return 0.0;
  // Six characters, as long as the longest name below.
  const std::string unit = lines.substr(start + key.size(), 6);
  for (const auto& [name, metres] : {std::pair{"micron", 1e-6},
                                     {"um", 1e-6},
                                     {"\\u00B5", 1e-6},  // µ as ImageJ escapes it.
                                     {"mm", 1e-3},
                                     {"nm", 1e-9},
                                     {"cm", 1e-2},
                                     {"inch", inch}})
    if (unit.starts_with(name)) return metres;
  return 0.0;
}

// A directory of a TIFF: entries of tag, type, count, value or its place.
double tiff_pixel(FileBytes& bytes, Offset directory) {
  const Offset entries = bytes.number(directory, 2);
  // Where the last entry is cut off, a resolution may lack its unit.
  if (bytes.text(directory + 1 + 12 * entries, 1).empty()) return 0.0;
  double across = 0.0, down = 0.0, unit = inch, described = 0.0;  // pixels a unit
  for (Offset i = 0; i < entries; ++i) {
    const Offset entry = directory + 2 + 12 * i, place = bytes.number(entry + 8, 4);
    switch (bytes.number(entry, 2)) {
      case 270:  // ImageDescription
        described = unit_of(bytes.text(place, bytes.number(entry + 4, 4)));
        break;
      case 282:  // XResolution, a fraction
      case 283:  // YResolution
        (bytes.number(entry, 2) == 282 ? across : down) =
            real(bytes, place) / real(bytes, place + 4);
        break;
      case 296: {  // ResolutionUnit: none, inch, centimetre
        const auto code = bytes.number(entry + 8, 2);
        unit = code == 3 ? 1e-2 : (code == 2 ? inch : 0.0);
        break;
      }
      default:
        break;
    }
  }
  const double resolution = square(across, down > 0.0 ? down : across);
  // If ImageJ describes a unit, the resolution is in that one, whatever ResolutionUnit says.
  return resolution > 0.0 ? (described > 0.0 ? described : unit) / resolution : 0.0;
}

// Of a text "rows\columns", or of one number; the text is in mm, the result in metres. [m]
double spacing_in(const std::string& text) {
  char* end = nullptr;
  const double rows = 1e-3 * std::strtod(text.c_str(), &end);
  return *end == '\\' ? square(rows, 1e-3 * std::strtod(end + 1, nullptr)) : rows;
}

// Elements of a DICOM file: group, element, [type,] length, data. Sequences of unknown length are
// walked through, as spacing may lie inside. That at the detector (0018,1164), which is magnified,
// comes before that in the body (0028,0030), and counts where there is no other.
double dicom_pixel(FileBytes& bytes) {
  bytes.set_big_endian(false);
  bool typed = true;
  double at_the_detector = 0.0;
  // Elements begin behind a preamble of 128 bytes and the four letters "DICM".
  for (Offset at = 132; bytes.text(at, 8).size() == 8;) {
    const Offset group = bytes.number(at, 2), element = bytes.number(at + 2, 2);
    if (group == 0x7FE0) break;  // the pixels
    const std::string type = bytes.text(at + 4, 2);
    Offset data = at + 8;
    Offset length = bytes.number(at + 4, 4);
    // Elements of the file's head (group 2) have types in every syntax, marks of items (FFFE) in
    // none.
    if ((typed || group == 2) && group != 0xFFFE) {
      constexpr std::string_view long_types = "OB OW OF OD OL OV SQ UC UR UT UN";
      const bool is_long = long_types.find(type) != std::string_view::npos;
      length = is_long ? bytes.number(at + 8, 4) : bytes.number(at + 6, 2);
      data += is_long ? 4 : 0;
    }
    const std::string text = group == 2 || group == 0x28 || group == 0x18
                                 ? bytes.text(data, std::min<Offset>(length, 64))
                                 : "";
    if (group == 2 && element == 0x10)  // transfer syntax
      // This is implicit little endian, the only syntax without types. Texts may end in a zero.
      typed = text.substr(0, text.find('\0')) != "1.2.840.10008.1.2";
    if (group == 0x28 && element == 0x30) return spacing_in(text);
    if (group == 0x18 && element == 0x1164) at_the_detector = spacing_in(text);
    // Items, and whatever has an unknown length, are entered; all else is passed over.
    const bool inside = length == 0xFFFFFFFFU || (group == 0xFFFE && element == 0xE000);
    at = inside ? data : data + length;
  }
  return at_the_detector;
}

// Of each page of a TIFF that is no reduced copy (of a BigTIFF none), of any other file's image; a
// size that is none is 0. [m]
std::vector<double> stated_sizes(const std::filesystem::path& file) {
  FileBytes bytes(file);
  // As far as the end of "DICM", the mark that lies farthest from the start.
  const std::string head = bytes.text(0, 132);
  std::vector<double> sizes;
  if (head.starts_with("\x89PNG")) {
    sizes = {png_pixel(bytes)};
  } else if (head.ends_with("DICM")) {
    sizes = {dicom_pixel(bytes)};
  } else if (const TiffPages tiff = tiff_pages(bytes); !tiff.large) {
    for (const std::size_t i : full_pages(tiff))
      sizes.push_back(tiff_pixel(bytes, tiff.pages[i].directory));
  }
  for (double& size : sizes)
    if (!(size > 0.0) || !std::isfinite(size) || is_for_paper(size)) size = 0.0;
  return sizes;
}

// The first size that is another one; a page that states none has that of the others.
std::optional<double> unlike(double size, const std::vector<double>& stated) {
  const auto found = std::ranges::find_if(
      stated, [&](double other) { return other > 0.0 && std::abs(size / other - 1.0) > 0.01; });
  return found == stated.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

std::optional<double> tagged_pixel_size(const std::filesystem::path& file) {
  const std::vector<double> stated = stated_sizes(file);
  return stated.empty() || stated.front() == 0.0 ? std::nullopt : std::optional(stated.front());
}

std::optional<double> pixel_size_of(const std::filesystem::path& image,
                                    const io::SectionOptions& options,
                                    std::vector<std::string>& warnings) {
  const std::optional<double> given = options.pixel_size;
  if (given && !(options.any_pixel_size ? *given > 0.0 : plausible(*given)))
    throw io::InputError(
        image.string(),
        fmt::format("a pixel size of {:g} µm is outside 0.1 to 200 µm", *given * 1e6),
        "pixel_size_um is the side of one pixel in µm; if it is meant, add --any-pixel-size (in a "
        "study any_pixel_size = true in [sections])");
  const std::vector<double> stated = stated_sizes(image);
  // If both are known and differ, one is wrong, and only the user can tell which.
  if (const auto other = given ? unlike(*given, stated) : std::nullopt)
    warnings.push_back(
        fmt::format("the file states pixels of {:.4g} µm; {:.4g} µm are used, as given",
                    *other * 1e6, *given * 1e6));
  const std::optional<double> own = tagged_pixel_size(image);
  if (given || !own) return given;
  const bool usable = options.any_pixel_size || plausible(*own);
  if (const auto other = usable ? unlike(*own, stated) : std::nullopt)
    throw io::InputError(
        image.string(),
        fmt::format("its pages state different pixels, of {:.4g} and {:.4g} µm", *own * 1e6,
                    *other * 1e6),
        "save them as files of their own, or give one size for all with --pixel-size-um (in a "
        "study pixel_size_um)");
  warnings.push_back(fmt::format("the file states pixels of {:.4g} µm: {}", *own * 1e6,
                                 usable ? "used" : "not used, as it is outside 0.1 to 200 µm"));
  return usable ? own : std::nullopt;
}

}  // namespace havers::images
