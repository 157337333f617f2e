// Pixels become SI units here. An unknown pixel size is NaN, and so is all that is computed from
// it.
#include "io/images/section_quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/images/masks.hpp"
#include "io/images/windows.hpp"
#include "io/images/zones.hpp"

namespace havers::images {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

struct Moments {
  double mean = not_known, sd = not_known;
};

Moments moments_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  cv::Scalar mean, deviation;
  cv::meanStdDev(values, mean, deviation);
  return {mean[0], deviation[0]};
}

// Lacunae of cells, canals of vessels, and what resorption or a fault has left [I14].
std::vector<calib::PoreClass> classes_of(const std::vector<double>& areas, double pixel) {
  constexpr double none = std::numeric_limits<double>::infinity();
  struct Limit {
    const char* name;
    double diameter;  // [m]
  };
  static constexpr std::array<Limit, 3> limits{
      {{"lacunae", 15e-6}, {"canals", 150e-6}, {"cavities", none}}};
  std::vector<calib::PoreClass> classes;
  double least = 0.0;
  for (const auto& [name, diameter] : limits) {
    calib::PoreClass one{.name = name};
    for (const double area : areas) {
      const double of_pore = pixel * diameter_of(area);
      if (of_pore < least || of_pore >= diameter) continue;
      ++one.count;
      one.area += area * pixel * pixel;
    }
    classes.push_back(one);
    least = diameter;
  }
  return classes;
}

void add_sizes(const PoreMap& map, double pixel, calib::SectionPorosity& section) {
  double squares = 0.0;
  std::vector<double> diameters;
  for (const double area : map.areas) {
    squares += area * area;
    diameters.push_back(diameter_of(area));
  }
  const Moments area = moments_of(map.areas), diameter = moments_of(diameters);
  section.mean_pore_area = area.mean * pixel * pixel;
  section.pore_area_sd = area.sd * pixel * pixel;
  section.mean_pore_diameter = diameter.mean * pixel;
  section.pore_diameter_sd = diameter.sd * pixel;
  // a* = Σ a²/Σ a (K2); without pores it is zero, not NaN.
  section.pore_area_ratio = map.area > 0.0 ? squares / map.area * pixel * pixel : 0.0;
  if (std::isfinite(pixel)) section.classes = classes_of(map.areas, pixel);
}

// Area inside the outer borders, holes included. [px]
double filled_area(const cv::Mat& mask) {
  double area = 0.0;
  for (const Contour& border : outer_contours(mask)) area += enclosed_area(border);
  return area;
}

}  // namespace

calib::SectionPorosity section_quantities(const PoreMap& map, bool outlined,
                                          const io::SectionOptions& options) {
  const double pixel = options.pixel_size.value_or(not_known);
  const double bone = cv::countNonZero(map.bone), pixel_area = pixel * pixel;
  calib::SectionPorosity section;
  section.pixel_size = pixel;
  section.threshold = map.threshold;
  section.porosity = map.area / bone;
  section.porosity_by_grey = map.area_by_grey / bone;
  // (I10): how the parts of the section differ, and how the two ways to measure a pore's area do.
  section.porosity_standard_error = std::hypot(porosity_standard_error(map.bone, map.pores),
                                               0.5 * (section.porosity - section.porosity_by_grey));
  section.pore_count = static_cast<int>(map.areas.size());
  section.pore_area = map.area * pixel_area;
  section.bone_area = bone * pixel_area;
  section.pore_density = section.pore_count / section.bone_area;
  section.total_area = filled_area(map.bone) * pixel_area;
  section.marrow_area = section.total_area - section.bone_area;
  add_sizes(map, pixel, section);
  section.crack_count = map.crack_count;
  section.crack_area = map.crack_area * pixel_area;
  section.speck_count = map.specks;
  section.zones = zones_of(map.bone, map.pores, outlined);
  for (calib::Zone& zone : section.zones) zone.bone_area *= pixel_area;
  // Stays NaN if the pixel size is unknown.
  WindowSpread spread{.sd = pixel, .standard_error = pixel};
  if (options.pixel_size)
    spread = window_spread(map.bone, map.pores, options.window_length / pixel,
                           options.window_height / pixel);
  section.window_area = options.window_length * options.window_height;
  section.window_sd = spread.sd;
  section.window_sd_standard_error = spread.standard_error;
  return section;
}

}  // namespace havers::images
