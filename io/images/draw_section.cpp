// Synthetic sections of known porosity: circles in a bar or a ring. Their area is measured before
// blur, shade and noise are added.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "io/images/image_library.hpp"
#include "io/images/section_quantities.hpp"
#include "io/input_error.hpp"

namespace havers::images {
namespace {

// Grey levels of the drawing; the distance leaves room for shading and noise.
constexpr double bone_grey = 210.0, pore_grey = 50.0;
constexpr double radius_variation = 0.3;  // SD over mean.
constexpr double rim = 3.0;               // Least bone between a pore and what is next to it. [px]

// The standard's generators are the same everywhere, its distributions are not.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1p-53;
}

// Standard normal, by the method of Box and Muller.
double normal(std::mt19937_64& random) {
  const double r = std::sqrt(-2.0 * std::log(1.0 - uniform(random)));
  return r * std::cos(2.0 * std::numbers::pi * uniform(random));
}

struct Circle {
  double x = 0.0, y = 0.0, r = 0.0;
};

struct Shape {
  double middle = 0.0, half_width = 0.0, half_height = 0.0;  // Of the bar.
  double outer = 0.0, inner = 0.0;                           // Of the ring, when outer > 0.

  // How far inside the bone a point is. [px]
  [[nodiscard]] double depth(double x, double y) const {
    if (outer > 0.0) {
      const double r = std::hypot(x - middle, y - middle);
      return std::min(outer - r, r - inner);
    }
    return std::min(half_width - std::abs(x - middle), half_height - std::abs(y - middle));
  }
};

Shape shape_of(const io::SectionDrawing& drawing) {
  const double side = drawing.pixels;
  Shape shape{.middle = 0.5 * side, .half_width = 0.44 * side, .half_height = 0.36 * side};
  if (drawing.ring) shape.outer = 0.45 * side, shape.inner = 0.22 * side;
  return shape;
}

// Log-normal radii up to the wanted area, the last one what is left of it; largest first, so that
// they fit.
std::vector<double> radii(const io::SectionDrawing& drawing, double area, std::mt19937_64& random) {
  const double mean = drawing.pore_radius / drawing.pixel_size;
  const double s = std::sqrt(std::log(1.0 + radius_variation * radius_variation));
  std::vector<double> drawn;
  double left = area / std::numbers::pi;
  // An area that is at most a quarter of a pore of mean radius is not drawn.
  while (left > 0.25 * mean * mean) {
    const double r = mean * std::exp(s * normal(random) - 0.5 * s * s);
    drawn.push_back(std::min(r, std::sqrt(left)));
    left -= drawn.back() * drawn.back();
  }
  std::sort(drawn.rbegin(), drawn.rend());
  return drawn;
}

// Circles apart from each other and from the surface. Where no room is found for one, it is left
// out.
std::vector<Circle> place(const std::vector<double>& wanted, const Shape& shape,
                          std::mt19937_64& random) {
  std::vector<Circle> placed;
  for (const double r : wanted) {
    for (int attempt = 0; attempt < 2000; ++attempt) {
      const Circle pore{2.0 * shape.middle * uniform(random), 2.0 * shape.middle * uniform(random),
                        r};
      const auto touches = [&](const Circle& other) {
        return std::hypot(pore.x - other.x, pore.y - other.y) < pore.r + other.r + rim;
      };
      if (shape.depth(pore.x, pore.y) < r + rim) continue;
      if (std::any_of(placed.begin(), placed.end(), touches)) continue;
      placed.push_back(pore);
      break;
    }
  }
  return placed;
}

cv::Mat bone_mask(const Shape& shape, int side) {
  cv::Mat bone(side, side, CV_8U);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      bone.at<std::uint8_t>(y, x) = shape.depth(x + 0.5, y + 0.5) > 0.0 ? 255 : 0;
  return bone;
}

void draw_pores(const std::vector<Circle>& circles, cv::Mat& pores) {
  for (const Circle& c : circles)
    for (int y = static_cast<int>(c.y - c.r); y <= static_cast<int>(c.y + c.r); ++y)
      for (int x = static_cast<int>(c.x - c.r); x <= static_cast<int>(c.x + c.r); ++x)
        if (std::hypot(x + 0.5 - c.x, y + 0.5 - c.y) < c.r) pores.at<std::uint8_t>(y, x) = 255;
}

// Blurred, shaded from the centre, noisy, stained red.
cv::Mat photograph(const PoreMap& truth, const io::SectionDrawing& drawing,
                   std::mt19937_64& random) {
  const double contrast = drawing.contrast * (bone_grey - pore_grey);
  cv::Mat solid, image;
  cv::bitwise_and(truth.bone, ~truth.pores, solid);
  solid.convertTo(image, CV_64F, contrast / 255.0, bone_grey - contrast);
  cv::GaussianBlur(image, image, {}, drawing.blur, drawing.blur, cv::BORDER_REPLICATE);
  const double middle = 0.5 * drawing.pixels;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const double u = (x - middle) / middle, v = (y - middle) / middle;
      auto& value = image.at<double>(y, x);
      // In the corners u² + v² is 2: there the image is darker by the whole of `shading`.
      value *= 1.0 - 0.5 * drawing.shading * (u * u + v * v);
      value += drawing.noise * contrast * normal(random);
    }
  image.convertTo(image, CV_8U);
  if (!drawing.stain) return image;
  // OpenCV's order is blue, green, red: blue and green have half of red's contrast.
  const cv::Mat pale = 0.5 * image + 50.0;
  cv::merge(std::vector<cv::Mat>{pale, pale, image}, image);
  return image;
}

}  // namespace

calib::SectionPorosity draw_section(const std::filesystem::path& image,
                                    const io::SectionDrawing& drawing,
                                    const io::SectionOptions& options) {
  std::mt19937_64 random(drawing.seed);
  const Shape shape = shape_of(drawing);
  PoreMap truth;
  truth.bone = bone_mask(shape, drawing.pixels);
  const double area = drawing.porosity * cv::countNonZero(truth.bone);
  truth.pores = cv::Mat::zeros(truth.bone.size(), CV_8U);
  draw_pores(place(radii(drawing, area, random), shape, random), truth.pores);
  // A slenderness of 0: no circle is a crack.
  sort_objects(0.0, truth);
  // Nothing is blurred in the truth, so that (I7) and (I8) give the same area.
  truth.area_by_grey = truth.area;

  std::vector<std::uint8_t> png;
  cv::imencode(".png", photograph(truth, drawing, random), png, {cv::IMWRITE_PNG_COMPRESSION, 9});
  std::ofstream file(image, std::ios::binary);
  file.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  if (!file.flush())
    throw io::InputError(image.string(), "cannot be written", "check the folder and its space");

  io::SectionOptions scale = options;
  scale.pixel_size = drawing.pixel_size;
  calib::SectionPorosity section = section_quantities(truth, true, scale);
  section.file = image.string();
  section.method = "counted on the drawing";
  section.threshold = 0.5;
  return section;
}

}  // namespace havers::images
