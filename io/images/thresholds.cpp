// Thresholds are found from depths, not from grey levels, so that a shade does not affect them.
#include "io/images/thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace havers::images {

DepthCount::DepthCount(const Depth& depth, const cv::Mat& mask) {
  constexpr double last = 299.0;
  for_each_depth(depth, mask, [&](int, int, double value) {
    ++counts_[static_cast<std::size_t>(std::clamp(100.0 * (value + 1.0), 0.0, last))];
    sum_ += value;
  });
}

double DepthCount::above(double depth) const {
  double found = 0.0;
  for (auto bin = static_cast<std::size_t>(std::lround(100.0 * (depth + 1.0)));
       bin < counts_.size(); ++bin)
    found += counts_[bin];
  return found;
}

// OpenCV's Otsu works on bytes: 85 steps are a depth of 1. It returns the last byte below the
// threshold; as depths are rounded to bytes, the threshold is half a step above that.
double otsu_threshold(const Depth& depth, const cv::Mat& mask) {
  std::vector<std::uint8_t> bytes;  // from −1 to 2
  for (const float value : sample_depths(depth, mask, 200000))
    bytes.push_back(cv::saturate_cast<std::uint8_t>(85.0F * (value + 1.0F)));
  cv::Mat ignored;
  return (cv::threshold(bytes, ignored, 0.0, 255.0, cv::THRESH_OTSU) + 0.5) / 85.0 - 1.0;
}

// T = m (1 + k (s/R − 1)) for brightness 1 − depth, of mean m and deviation s in a window.
cv::Mat below_sauvola(const Depth& source, const cv::Mat& within) {
  constexpr double k = 0.2, range = 0.5;
  constexpr int window = 101;
  cv::Mat depth(within.size(), CV_32F), mean, squares;
  for_each_depth(
      source, cv::Mat(within.size(), CV_8U, cv::Scalar(255)),
      [&](int x, int y, double value) { depth.at<float>(y, x) = static_cast<float>(value); });
  cv::boxFilter(depth, mean, CV_32F, {window, window}, {-1, -1}, true, cv::BORDER_REFLECT_101);
  cv::sqrBoxFilter(depth, squares, CV_32F, {window, window}, {-1, -1}, true,
                   cv::BORDER_REFLECT_101);
  cv::Mat below(depth.size(), CV_8U);
  for (int y = 0; y < depth.rows; ++y) {
    const auto *d = depth.ptr<float>(y), *m = mean.ptr<float>(y), *q = squares.ptr<float>(y);
    auto* out = below.ptr<std::uint8_t>(y);
    for (int x = 0; x < depth.cols; ++x) {
      // By rounding, the difference may be below zero.
      const double deviation = std::sqrt(std::max(0.0F, q[x] - m[x] * m[x]));
      const double threshold = (1.0 - m[x]) * (1.0 + k * (deviation / range - 1.0));
      out[x] = 1.0 - d[x] < threshold ? 255 : 0;
    }
  }
  return below & within;
}

}  // namespace havers::images
