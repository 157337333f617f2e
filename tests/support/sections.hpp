// Synthetic sections of known porosity, drawn apart from the program's own: ellipses of which every
// pixel takes its share, under blur, shade, texture and noise, in any file format.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

#include "io/images/measure_section.hpp"

namespace havers::test {

enum class Outline { filled, bar, tilted_bar, ring };

struct SectionTruth {
  Outline outline = Outline::bar;
  int width = 700, height = 600;
  double bar_height = 0.68;  ///< Of a bar, over that of the image.
  double porosity = 0.05;
  double smallest_radius = 4.0, largest_radius = 4.0;  ///< [px]
  double elongation = 1.0;                             ///< Largest ratio of an ellipse's axes.
  int clusters = 0;                                    ///< Pores gather about so many places.
  double bone = 0.8, pore = 0.2, background = 0.2;     ///< Grey levels of 0 to 1, before the shade.
  double texture = 0.0;       ///< SD of the bone's own level over bone − pore, 10 px wide.
  double noise = 0.0;         ///< SD over bone − pore.
  double blur = 0.0;          ///< [px]
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

struct Ellipse {
  double x = 0.0, y = 0.0, long_axis = 0.0, short_axis = 0.0, angle = 0.0;

  /// Below 1 inside.
  [[nodiscard]] double at(double px, double py) const {
    const double c = std::cos(angle), s = std::sin(angle), u = px - x, v = py - y;
    return std::hypot((c * u + s * v) / long_axis, (c * v - s * u) / short_axis);
  }
};

/// Depth of a point inside the outline. [px]
inline double depth_inside(const SectionTruth& c, double x, double y) {
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
      return std::min(0.4 * c.width - std::abs(along),
                      0.5 * c.bar_height * c.height - std::abs(across));
  }
}

/// Smooth random field of mean 0 and SD 1.
inline cv::Mat random_texture(cv::Size size, cv::RNG& random) {
  cv::Mat field(size, CV_32F);
  random.fill(field, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(field, field, {}, 10.0);
  cv::Scalar mean, deviation;
  cv::meanStdDev(field, mean, deviation);
  return (field - mean[0]) / deviation[0];
}

inline cv::Mat photograph(const SectionTruth& c, const cv::Mat& bone, const cv::Mat& pores) {
  cv::RNG random(0x9e3779b97f4a7c15ULL * (c.seed + 1));
  const double contrast = std::abs(c.bone - c.pore);
  cv::Mat solid = bone - pores, level(bone.size(), CV_32F, cv::Scalar(c.bone)), noise;
  if (c.texture > 0.0) level += c.texture * contrast * random_texture(bone.size(), random);
  cv::Mat image = c.background * (1.0 - bone) + c.pore * pores + level.mul(solid);
  if (c.blur > 0.0) cv::GaussianBlur(image, image, {}, c.blur, c.blur, cv::BORDER_REFLECT_101);
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const double u = 2.0 * x / c.width - 1.0, v = 2.0 * y / c.height - 1.0;
      image.at<float>(y, x) *= static_cast<float>(1.0 - 0.5 * c.cupping * (u * u + v * v));
    }
  noise.create(bone.size(), CV_32F);
  random.fill(noise, cv::RNG::NORMAL, 0.0, c.noise * contrast + 1e-9);
  image += noise;
  if (c.bright_pores) image = 1.0 - image;
  return image;
}

/// Largest first, each where it keeps three pixels from the others and from the surface.
inline std::vector<Ellipse> place_pores(const SectionTruth& c, double bone_area) {
  std::mt19937 random(c.seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<Ellipse> placed, wanted;
  for (double area = 0.0; area < c.porosity * bone_area && c.porosity > 0.0;) {
    const double r =
        c.smallest_radius * std::pow(c.largest_radius / c.smallest_radius, uniform(random));
    const double stretch = std::sqrt(1.0 + (c.elongation - 1.0) * uniform(random));
    wanted.push_back({0.0, 0.0, r * stretch, r / stretch, std::numbers::pi * uniform(random)});
    area += std::numbers::pi * r * r;
  }
  std::sort(wanted.begin(), wanted.end(),
            [](const Ellipse& a, const Ellipse& b) { return a.long_axis > b.long_axis; });
  std::vector<cv::Point2d> middles;
  for (int i = 0; i < c.clusters; ++i)
    middles.emplace_back(c.width * uniform(random), c.height * uniform(random));
  for (Ellipse pore : wanted)
    for (int attempt = 0; attempt < 3000; ++attempt) {
      pore.x = c.width * uniform(random), pore.y = c.height * uniform(random);
      if (c.clusters > 0) {
        const cv::Point2d& middle = middles[random() % middles.size()];
        pore.x = middle.x + 0.15 * (pore.x - middle.x),
        pore.y = middle.y + 0.15 * (pore.y - middle.y);
      }
      if (depth_inside(c, pore.x, pore.y) < pore.long_axis + 3.0) continue;
      if (std::any_of(placed.begin(), placed.end(), [&](const Ellipse& o) {
            return std::hypot(pore.x - o.x, pore.y - o.y) < pore.long_axis + o.long_axis + 3.0;
          }))
        continue;
      placed.push_back(pore);
      break;
    }
  return placed;
}

/// Adds to every pixel the share that a pore takes of it, counted on 8 × 8 points.
inline void draw_pore(const Ellipse& pore, cv::Mat& shares) {
  const double reach = pore.long_axis + 1.0;
  const cv::Rect box(
      cv::Point2i(static_cast<int>(pore.x - reach), static_cast<int>(pore.y - reach)),
      cv::Point2i(static_cast<int>(pore.x + reach) + 1, static_cast<int>(pore.y + reach) + 1));
  const cv::Rect inside = box & cv::Rect(cv::Point(), shares.size());
  for (int y = inside.y; y < inside.br().y; ++y)
    for (int x = inside.x; x < inside.br().x; ++x) {
      const double middle = pore.at(x + 0.5, y + 0.5), margin = 0.75 / pore.short_axis;
      int covered = middle < 1.0 - margin ? 64 : 0;
      for (int i = 0; i < 64 && std::abs(middle - 1.0) <= margin; ++i)
        covered += pore.at(x + (i % 8 + 0.5) / 8.0, y + (i / 8 + 0.5) / 8.0) < 1.0 ? 1 : 0;
      shares.at<float>(y, x) += static_cast<float>(covered / 64.0);
    }
}

inline DrawnSection draw(const SectionTruth& c) {
  DrawnSection drawn{
      {}, cv::Mat(c.height, c.width, CV_32F), cv::Mat::zeros(c.height, c.width, CV_32F)};
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x)
      drawn.bone.at<float>(y, x) =
          static_cast<float>(std::clamp(depth_inside(c, x + 0.5, y + 0.5) + 0.5, 0.0, 1.0));
  const double bone_area = cv::sum(drawn.bone)[0];
  const std::vector<Ellipse> pores = place_pores(c, bone_area);
  for (const Ellipse& pore : pores) draw_pore(pore, drawn.pores);
  drawn.porosity = cv::sum(drawn.pores)[0] / bone_area;
  drawn.pore_count = static_cast<int>(pores.size());

  const double full = c.bits == 16 ? 65535.0 : 255.0;
  photograph(c, drawn.bone, drawn.pores)
      .convertTo(drawn.image, c.bits == 16 ? CV_16U : CV_8U, full);
  if (c.colour) {
    cv::Mat half;
    drawn.image.convertTo(half, -1, 0.5, 0.2 * full);
    cv::merge(std::vector<cv::Mat>{half, half, drawn.image}, drawn.image);
  }
  return drawn;
}

/// The image in a file of the running test's own folder; the ending gives the format.
inline std::filesystem::path write(const cv::Mat& image, const std::string& name) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = std::filesystem::temp_directory_path() / "havers_sections" /
                      test.test_suite_name() / test.name();
  std::filesystem::create_directories(folder);
  cv::imwrite((folder / name).string(), image);
  return folder / name;
}

inline constexpr double pixel = 2e-6;  ///< Side of a drawn section's. [m]

/// What is measured on a drawn section in a file of that name.
inline calib::SectionPorosity measure(const DrawnSection& section, const std::string& name,
                                      const io::SectionOptions& options = {.pixel_size = pixel}) {
  return measure_sections(write(section.image, name), options).front().porosity;
}

}  // namespace havers::test
