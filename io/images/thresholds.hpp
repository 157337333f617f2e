// What a threshold is found from. Private to io/images.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "io/images/depth.hpp"

namespace havers::images {

/// How many pixels are how deep, where a mask is set. Counting is O(pixels); after that every
/// question is answered from the counts.
class DepthCount {
 public:
  DepthCount(const Depth& depth, const cv::Mat& mask);
  /// Pixels deeper than `depth`, a multiple of 0.01.
  [[nodiscard]] double above(double depth) const;
  /// Pixels where the mask is set.
  [[nodiscard]] double all() const { return above(-1.0); }
  /// Sum of depths over all.
  [[nodiscard]] double sum() const { return sum_; }

 private:
  /// From −1 to 2; what lies outside is in the last ones.
  std::array<std::uint32_t, 300> counts_{};
  double sum_ = 0.0;
};

/// Otsu's threshold of the depths where `mask` is set (I11); from a sample of them. [-]
double otsu_threshold(const Depth& depth, const cv::Mat& mask);

/// 255 in `within` where depth is beyond Sauvola's local threshold (I11). Its
/// windows include what lies outside `within`.
cv::Mat below_sauvola(const Depth& source, const cv::Mat& within);

}  // namespace havers::images
