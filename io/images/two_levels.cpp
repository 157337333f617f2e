#include "io/images/two_levels.hpp"

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "io/images/surface.hpp"

namespace havers::images {
namespace {

cv::Mat values_of(const Surface& surface) {
  cv::Mat values(surface.size, CV_32F);
  for (int y = 0; y < values.rows; ++y) surface.evaluate_row(y, values.ptr<float>(y));
  return values;
}

Surface fit_where(const cv::Mat& image, const cv::Mat& mask) {
  return fit_surface(sample(image, mask, 4000), image.size(), 2);
}

cv::Mat otsu(const cv::Mat& image) {
  cv::Mat bytes;
  cv::normalize(image, bytes, 0, 255, cv::NORM_MINMAX, CV_8U);
  cv::threshold(bytes, bytes, 0, 255, cv::THRESH_OTSU);
  return bytes;
}

struct Split {
  TwoLevels levels;
  double deviation = std::numeric_limits<double>::infinity();
};

// Each level's surface from its pixels, each pixel to the nearer surface, until hardly any moves.
Split refine(const cv::Mat& image, cv::Mat bright) {
  Split split;
  const int fewest = static_cast<int>(image.total() / 200), few = fewest / 10;
  for (int round = 0; round < 20; ++round) {
    const int count = cv::countNonZero(bright);
    if (count < fewest || static_cast<int>(image.total()) - count < fewest) return split;
    const cv::Mat upper = values_of(fit_where(image, bright));
    const cv::Mat lower = values_of(fit_where(image, ~bright));
    const cv::Mat to_upper = cv::abs(image - upper), to_lower = cv::abs(image - lower);
    const cv::Mat next = to_upper < to_lower;
    const bool settled = cv::countNonZero(next != bright) <= few;
    bright = next;
    split.deviation =
        cv::norm(cv::min(to_upper, to_lower)) / std::sqrt(static_cast<double>(image.total()));
    split.levels.separation = cv::mean(cv::abs(upper - lower))[0] / std::max(split.deviation, 1e-6);
    if (settled) break;
  }
  split.levels.bright = bright;
  return split;
}

}  // namespace

TwoLevels split_levels(const cv::Mat& image) {
  const cv::Mat everywhere(image.size(), CV_8U, cv::Scalar(255));
  const Split as_seen = refine(image, otsu(image));
  const Split flattened = refine(image, otsu(image - values_of(fit_where(image, everywhere))));
  return as_seen.deviation <= flattened.deviation ? as_seen.levels : flattened.levels;
}

// Noise cut in halves has a separation of 2.65; a shade cut along a contour has no jump across it.
bool is_a_step(const TwoLevels& levels, const cv::Mat& image) {
  if (levels.bright.empty() || levels.separation < 4.5) return false;
  cv::Mat grown, shrunk, grown_far, shrunk_far;
  const cv::Mat near = cv::Mat::ones(3, 3, CV_8U), far = cv::Mat::ones(7, 7, CV_8U);
  cv::dilate(levels.bright, grown, near);
  cv::dilate(levels.bright, grown_far, far);
  cv::erode(levels.bright, shrunk, near);
  cv::erode(levels.bright, shrunk_far, far);
  const cv::Mat inside = shrunk & ~shrunk_far, outside = grown_far & ~grown;
  if (cv::countNonZero(inside) == 0 || cv::countNonZero(outside) == 0) return false;
  const double jump = cv::mean(image, inside)[0] - cv::mean(image, outside)[0];
  const double whole = cv::mean(image, levels.bright)[0] - cv::mean(image, ~levels.bright)[0];
  return jump > 0.4 * whole;
}

}  // namespace havers::images
