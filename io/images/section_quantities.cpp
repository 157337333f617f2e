#include "io/images/section_quantities.hpp"

#include <cmath>
#include <limits>

#include "io/images/windows.hpp"

namespace havers::images {

calib::SectionPorosity section_quantities(const PoreMap& map, const io::SectionOptions& options) {
  const double pixel = options.pixel_size.value_or(std::numeric_limits<double>::quiet_NaN());
  const double bone = cv::countNonZero(map.bone), pixel_area = pixel * pixel;
  calib::SectionPorosity section;
  section.pixel_size = pixel;
  section.porosity = map.area / bone;
  // (I10): how the parts of the section differ, and how the two ways to measure a pore's area do.
  section.porosity_standard_error = std::hypot(porosity_standard_error(map.bone, map.pores),
                                               0.5 * (map.area - map.area_by_grey) / bone);
  section.pore_count = map.count;
  section.pore_area = map.area * pixel_area;
  section.bone_area = bone * pixel_area;
  section.pore_area_ratio = map.area > 0.0 ? map.area_squared / map.area * pixel_area : 0.0;
  WindowSpread spread{.sd = pixel, .standard_error = pixel};
  if (options.pixel_size)
    spread = window_spread(map.bone, map.pores, options.window_length / pixel,
                           options.window_height / pixel);
  section.window_sd = spread.sd;
  section.window_sd_standard_error = spread.standard_error;
  return section;
}

}  // namespace havers::images
