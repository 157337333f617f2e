// Synthetic sections of known porosity, drawn apart from the program's own: circles of which every
// pixel takes its share, under blur, shade and noise, in any file format.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

namespace havers::test {

enum class Outline { filled, bar, tilted_bar, ring };

struct SectionCase {
  Outline outline = Outline::bar;
  int width = 700, height = 600;
  double porosity = 0.05;
  double smallest_radius = 4.0, largest_radius = 4.0;  ///< [px]
  double bone = 0.8, pore = 0.2, background = 0.2;     ///< Grey levels of 0 to 1, before the shade.
  double noise = 0.0;                                  ///< SD over bone − pore.
  double blur = 0.0;                                   ///< [px]
  double cupping = 0.0;       ///< Loss of brightness from centre to corner.
  bool bright_pores = false;  ///< The negative of it all.
  bool colour = false;        ///< Stained: red and blue differ.
  int bits = 8;
  unsigned seed = 1;
};

struct DrawnSection {
  cv::Mat image;
  cv::Mat bone, pores;  ///< Share of each pixel, float.
  double porosity = 0.0;
  int pore_count = 0;
};

/// Depth of a point inside the outline. [px]
inline double depth_inside(const SectionCase& c, double x, double y) {
  const double u = x - 0.5 * c.width, v = y - 0.5 * c.height;
  const double side = std::min(c.width, c.height);
  const double tilt = c.outline == Outline::tilted_bar ? 0.2 : 0.0;
  const double along = std::cos(tilt) * u + std::sin(tilt) * v;
  const double across = std::cos(tilt) * v - std::sin(tilt) * u;
  switch (c.outline) {
    case Outline::filled:
      return std::min(0.5 * c.width - std::abs(u), 0.5 * c.height - std::abs(v)) + 100.0;
    case Outline::ring:
      return std::min(0.45 * side - std::hypot(u, v), std::hypot(u, v) - 0.22 * side);
    default:
      return std::min(0.4 * c.width - std::abs(along), 0.34 * c.height - std::abs(across));
  }
}

inline cv::Mat photograph(const SectionCase& c, const cv::Mat& bone, const cv::Mat& pores,
                          std::mt19937& random) {
  cv::Mat image(bone.size(), CV_32F);
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const double b = bone.at<float>(y, x), p = pores.at<float>(y, x);
      image.at<float>(y, x) =
          static_cast<float>(c.background * (1.0 - b) + c.pore * p + c.bone * (b - p));
    }
  if (c.blur > 0.0) cv::GaussianBlur(image, image, {}, c.blur, c.blur, cv::BORDER_REFLECT_101);
  std::normal_distribution<double> noise(0.0, c.noise * std::abs(c.bone - c.pore) + 1e-9);
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const double u = 2.0 * x / c.width - 1.0, v = 2.0 * y / c.height - 1.0;
      const double shade = 1.0 - 0.5 * c.cupping * (u * u + v * v);
      const double value = image.at<float>(y, x) * shade + noise(random);
      image.at<float>(y, x) = static_cast<float>(c.bright_pores ? 1.0 - value : value);
    }
  return image;
}

inline DrawnSection draw(const SectionCase& c) {
  std::mt19937 random(c.seed);
  std::uniform_real_distribution<double> uniform;
  DrawnSection drawn{
      {}, cv::Mat(c.height, c.width, CV_32F), cv::Mat::zeros(c.height, c.width, CV_32F)};
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x)
      drawn.bone.at<float>(y, x) =
          static_cast<float>(std::clamp(depth_inside(c, x + 0.5, y + 0.5) + 0.5, 0.0, 1.0));
  const double bone_area = cv::sum(drawn.bone)[0];

  // Largest first, each where it keeps three pixels from the others and from the surface.
  std::vector<cv::Vec3d> circles;
  std::vector<double> radii;
  for (double area = 0.0; area < c.porosity * bone_area && c.porosity > 0.0;) {
    radii.push_back(c.smallest_radius *
                    std::pow(c.largest_radius / c.smallest_radius, uniform(random)));
    area += std::numbers::pi * radii.back() * radii.back();
  }
  std::sort(radii.rbegin(), radii.rend());
  for (const double r : radii)
    for (int attempt = 0; attempt < 3000; ++attempt) {
      const double x = c.width * uniform(random), y = c.height * uniform(random);
      if (depth_inside(c, x, y) < r + 3.0) continue;
      if (std::any_of(circles.begin(), circles.end(), [&](const cv::Vec3d& o) {
            return std::hypot(x - o[0], y - o[1]) < r + o[2] + 3.0;
          }))
        continue;
      circles.emplace_back(x, y, r);
      break;
    }
  for (const cv::Vec3d& o : circles)
    for (int y = static_cast<int>(o[1] - o[2]) - 2; y <= o[1] + o[2] + 2; ++y)
      for (int x = static_cast<int>(o[0] - o[2]) - 2; x <= o[0] + o[2] + 2; ++x) {
        if (x < 0 || y < 0 || x >= c.width || y >= c.height) continue;
        const double share =
            std::clamp(o[2] + 0.5 - std::hypot(x + 0.5 - o[0], y + 0.5 - o[1]), 0.0, 1.0);
        drawn.pores.at<float>(y, x) =
            std::max(drawn.pores.at<float>(y, x), static_cast<float>(share));
      }
  drawn.porosity = cv::sum(drawn.pores)[0] / bone_area;
  drawn.pore_count = static_cast<int>(circles.size());

  const double full = c.bits == 16 ? 65535.0 : 255.0;
  photograph(c, drawn.bone, drawn.pores, random)
      .convertTo(drawn.image, c.bits == 16 ? CV_16U : CV_8U, full);
  if (c.colour) {
    cv::Mat half;
    drawn.image.convertTo(half, -1, 0.5, 0.2 * full);
    cv::merge(std::vector<cv::Mat>{half, half, drawn.image}, drawn.image);
  }
  return drawn;
}

/// The image in a file of the tests' own folder; the ending gives the format.
inline std::filesystem::path write(const cv::Mat& image, const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / "havers_sections";
  std::filesystem::create_directories(folder);
  cv::imwrite((folder / name).string(), image);
  return folder / name;
}

}  // namespace havers::test
