// Porosity as it is commonly measured, to compare with: by the middle of the grey scale and by
// Otsu's threshold, both over the whole image, and by Otsu's inside the outline of find_bone.
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "io/images/image_library.hpp"
#include "io/images/pores.hpp"
#include "sim/stopwatch.hpp"

namespace havers::images {
namespace {

// Share of pixels that are not above the threshold: dark ones are pores.
double share_of_dark(const cv::Mat& grey, double threshold) {
  return static_cast<double>(cv::countNonZero(grey <= threshold)) /
         static_cast<double>(grey.total());
}

double above_the_middle(const cv::Mat& grey) {
  return share_of_dark(grey, 127.0);
}

double by_otsu(const cv::Mat& grey) {
  cv::Mat ignored;
  return share_of_dark(grey, cv::threshold(grey, ignored, 0.0, 255.0, cv::THRESH_OTSU));
}

double by_otsu_in_bone(const cv::Mat& grey) {
  Regions regions = divide(grey, io::Pores::dark);
  const cv::Mat part = grey(regions.box);
  Depth depth{.levels = bone_levels(part, regions)};
  const cv::Mat bone = find_bone(part, regions, depth);
  std::vector<std::uint8_t> inside;
  inside.reserve(part.total());
  for (int y = 0; y < bone.rows; ++y) {
    const auto *wanted = bone.ptr<std::uint8_t>(y), *values = part.ptr<std::uint8_t>(y);
    for (int x = 0; x < bone.cols; ++x)
      if (wanted[x] != 0) inside.push_back(values[x]);
  }
  return by_otsu(cv::Mat(inside));
}

// The CPU time includes reading the file, as that of measure_sections does.
calib::PorosityReading timed(const std::filesystem::path& image,
                             double (*measure)(const cv::Mat&)) {
  const sim::Stopwatch stopwatch;
  const double porosity = measure(cv::imread(image.string(), cv::IMREAD_GRAYSCALE));
  return {porosity, stopwatch.cpu_seconds()};
}

}  // namespace

std::array<calib::PorosityReading, 3> measure_by_common_practice(
    const std::filesystem::path& image) {
  return {timed(image, above_the_middle), timed(image, by_otsu), timed(image, by_otsu_in_bone)};
}

}  // namespace havers::images
