#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "io/images/grey_image.hpp"
#include "io/images/image_library.hpp"
#include "io/images/overlay.hpp"
#include "io/images/pores.hpp"
#include "io/images/section_quantities.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

void check(const std::filesystem::path& image, const io::SectionOptions& options) {
  if (!options.pixel_size) return;
  const double size = *options.pixel_size;
  if (!(size >= 0.1e-6 && size <= 200e-6))
    throw io::InputError(
        image.string(), fmt::format("a pixel size of {:g} µm is outside 0.1 to 200 µm", size * 1e6),
        "pixel_size_um is the side of one pixel in µm");
}

void warn(const PoreMap& map, const io::SectionOptions& options, calib::SectionPorosity& section) {
  const double bone = cv::countNonZero(map.bone);
  if (!options.pixel_size)
    section.warnings.emplace_back(
        "no pixel size is given: areas and the spread between windows stay unknown");
  else if (*options.pixel_size > options.window_height)
    section.warnings.push_back(
        fmt::format("a pixel ({:g} µm) is larger than the fibre's height ({:g} µm): "
                    "the spread between windows is that of the pixels",
                    *options.pixel_size * 1e6, options.window_height * 1e6));
  if (map.specks > 0)
    section.warnings.push_back(
        fmt::format("{} objects below {} pixels were left out as too small to tell "
                    "from noise",
                    map.specks, smallest_pore));
  if (map.largest > 0.05 * bone)
    section.warnings.push_back(
        fmt::format("one pore takes {:.1f} % of the bone: if it is the marrow cavity "
                    "or a crack, give a mask without it",
                    100.0 * map.largest / bone));
  if (std::abs(map.area - map.area_by_grey) > 0.01 * bone)
    section.warnings.push_back(
        fmt::format("the porosity by grey levels, {:.2f} %, differs by more than one "
                    "point from the one by threshold, {:.2f} %",
                    100.0 * map.area_by_grey / bone, 100.0 * map.area / bone));
}

}  // namespace

io::SectionMeasurement measure_section(const std::filesystem::path& image,
                                       const io::SectionOptions& options) {
  check(image, options);
  const cv::Mat grey = read_grey(image);
  const Regions regions = options.mask
                              ? divide(grey, read_mask(*options.mask, grey.size()), options.pores)
                              : divide(grey, options.pores);
  const Levels levels = bone_levels(grey, regions);
  const cv::Mat bone = find_bone(grey, regions, levels);
  if (bone.empty())
    throw io::InputError(image.string(), "no bone was found",
                         "give a mask that is white where the bone is");
  const PoreMap map = find_pores(grey, bone, regions.outlined, levels);

  io::SectionMeasurement measured;
  measured.porosity = section_quantities(map, options);
  measured.porosity.file = image.string();
  measured.porosity.method = "half-maximum after flat field, corrected for blur";
  measured.porosity.threshold = 1.0 - map.threshold;
  warn(map, options, measured.porosity);
  measured.overlay_png = draw_overlay(grey, map);
  return measured;
}

}  // namespace havers::images
