// (I2) Two-means clustering in which each mean is a smooth surface instead of a number: pixels are
// assigned and surfaces fitted in turns. That finds only a minimum near its start, so it runs from
// two starts: Otsu's split of the image as it is, and of the flattened image.
#include "io/images/two_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "io/images/masks.hpp"
#include "io/images/surface.hpp"

namespace havers::images {
namespace {

cv::Mat values_of(const Surface& surface) {
  cv::Mat values(surface.size, CV_32F);
  for (int y = 0; y < values.rows; ++y) surface.evaluate_row(y, values.ptr<float>(y));
  return values;
}

// What covers less than a tenth says nothing of a shade elsewhere.
Surface fit_where(const cv::Mat& image, const cv::Mat& mask) {
  const bool wide = cv::countNonZero(mask) > 0.1 * static_cast<double>(image.total());
  return fit_surface(sample(image, mask, 4000), image.size(), wide ? 2 : 0);
}

// Otsu's split, the start of a search. Pixels outside the mask are set to the mean inside it, so
// that they do not widen the range of grey levels.
cv::Mat otsu(const cv::Mat& image, const cv::Mat& mask) {
  cv::Mat bytes = image.clone();
  bytes.setTo(cv::mean(image, mask), ~mask);
  cv::normalize(bytes, bytes, 0, 255, cv::NORM_MINMAX, CV_8U);
  cv::threshold(bytes, bytes, 0, 255, cv::THRESH_OTSU);
  return bytes;
}

// Deviation by the median, which pores of a third level hardly move.
double usual(const cv::Mat& distance, const cv::Mat& mask) {
  std::vector<float> values;
  for (int y = 0; y < mask.rows; ++y)
    for_each_set(mask, y, [&](int x) { values.push_back(distance.at<float>(y, x)); });
  return 1.4826 * quantile(values, 0.5);
}

struct Split {
  TwoLevels levels;
  double deviation = std::numeric_limits<double>::infinity();
};

// Each level's surface from its pixels, each pixel to the nearer surface, until hardly any moves.
Split refine(const cv::Mat& image, const cv::Mat& mask, cv::Mat bright) {
  Split split;
  // A level of fewer than `fewest` pixels has died out; moves of up to `few` pixels are ignored.
  const int all = cv::countNonZero(mask), fewest = all / 200, few = fewest / 10;
  for (int round = 0; round < 20; ++round) {
    const int count = cv::countNonZero(bright & mask);
    if (count < fewest || all - count < fewest) return {};
    const cv::Mat upper = values_of(fit_where(image, bright & mask));
    const cv::Mat lower = values_of(fit_where(image, ~bright & mask));
    const cv::Mat to_upper = cv::abs(image - upper), to_lower = cv::abs(image - lower);
    const cv::Mat next = to_upper < to_lower;
    const bool settled = cv::countNonZero(next != bright) <= few;
    bright = next;
    split.deviation = cv::norm(cv::min(to_upper, to_lower), cv::NORM_L2, mask) / std::sqrt(all);
    // If most pixels have exactly their level's value the median is 0: 0.6 of the RMS is the least.
    const double most = std::max(split.deviation, 1e-6);
    split.levels.separation =
        cv::mean(cv::abs(upper - lower), mask)[0] /
        std::clamp(usual(cv::min(to_upper, to_lower), mask), 0.6 * most, most);
    if (settled) break;
  }
  split.levels.bright = bright;
  return split;
}

}  // namespace

TwoLevels split_levels(const cv::Mat& image, const cv::Mat& mask) {
  const cv::Mat flat = image - values_of(fit_where(image, mask));
  const Split as_seen = refine(image, mask, otsu(image, mask));
  const Split flattened = refine(image, mask, otsu(flat, mask));
  return as_seen.deviation <= flattened.deviation ? as_seen.levels : flattened.levels;
}

// Noise cut in halves has a separation of 2.65; a shade cut along a contour has no jump across it.
bool is_a_step(const TwoLevels& levels, const cv::Mat& image, const cv::Mat& mask) {
  if (levels.bright.empty() || levels.separation < 4.5) return false;
  // Sides of squares [px]: the second and third pixel on either side of the border are compared.
  constexpr int near = 3, far = 7;
  const cv::Mat inside = eroded(levels.bright, near) & ~eroded(levels.bright, far) & mask;
  const cv::Mat outside = dilated(levels.bright, far) & ~dilated(levels.bright, near) & mask;
  if (cv::countNonZero(inside) == 0 || cv::countNonZero(outside) == 0) return false;
  const double jump = cv::mean(image, inside)[0] - cv::mean(image, outside)[0];
  const double whole =
      cv::mean(image, levels.bright & mask)[0] - cv::mean(image, ~levels.bright & mask)[0];
  return jump > 0.4 * whole;
}

}  // namespace havers::images
