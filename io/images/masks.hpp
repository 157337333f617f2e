// What several steps do with masks: 255 where set. Private to io/images.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <vector>

namespace havers::images {

/// The pixels of a border in their order: all of them if it was traced on a mask, only the corners
/// of a hull or a rectangle. [px]
using Contour = std::vector<cv::Point>;

/// Calls `use(x)` for every set pixel of a row. Most pixels of a mask are not set: eight at a time
/// are passed over.
template <class Use>
void for_each_set(const cv::Mat& mask, int y, Use use) {
  const auto* row = mask.ptr<std::uint8_t>(y);
  for (int x = 0; x < mask.cols;) {
    const int end = std::min(x + 8, mask.cols);
    std::uint64_t eight = 1;
    if (end == x + 8) std::memcpy(&eight, row + x, 8);
    if (eight == 0) x = end;
    for (; x < end; ++x)
      if (row[x] != 0) use(x);
  }
}

/// With a square of `side` pixels, odd: by (side − 1)/2 pixels all around. The image's edge neither
/// erodes nor dilates.
cv::Mat eroded(const cv::Mat& mask, int side);
cv::Mat dilated(const cv::Mat& mask, int side);

/// What is farther than `reach` pixels from what is not set; beyond the image all is set.
cv::Mat eroded_by(const cv::Mat& mask, int reach);

/// Outer borders of the connected parts.
std::vector<Contour> outer_contours(const cv::Mat& mask);

/// Copies on which bone and zones are found have at most about 128 × 128 pixels, as long and narrow
/// as the image is: how many pixels a side become one of them.
int reduction(cv::Size size);

/// Means over cells of `factor` × `factor` pixels, float. What lies beyond the edge is nothing
/// (BORDER_CONSTANT) or goes on (BORDER_REPLICATE).
cv::Mat averaged(const cv::Mat& image, int factor, cv::BorderTypes beyond);

/// Pixels inside a border and on it.
double enclosed_area(const Contour& border);

/// A connected part.
struct Blob {
  Contour border;
  std::vector<Contour> holes;
  double area = 0.0;   ///< Without its holes. [px]
  double edges = 0.0;  ///< Sides of pixels between it and what is around it or in it. [px]

  /// Smooth length of its borders [Cauchy-Crofton]. [px]
  [[nodiscard]] double perimeter() const;
};
/// The connected parts (of eight neighbours) with their holes. O(pixels).
std::vector<Blob> blobs_of(const cv::Mat& mask);

/// Length over greatest width of a blob; 1 when it is plainly no crack.
double slenderness(const Blob& blob);

/// Diameter of the circle of that area; from pixels in pixels, from m² in m.
double diameter_of(double area);

/// Sets what a border encloses to `value`.
void fill(cv::Mat& mask, const Contour& border, int value);

}  // namespace havers::images
