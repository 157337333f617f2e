// Two levels under a smooth shade, on a small image. Private to io/images.
#pragma once

#include <opencv2/core.hpp>

namespace havers::images {

/// How a small grey image splits.
struct TwoLevels {
  cv::Mat bright;           ///< 255 on the brighter level.
  double separation = 0.0;  ///< Distance of the levels over the deviation about them. [-]
};

/// Splits a float image into two levels, each a smooth surface through pixels where `mask` is set
/// (I2). `bright` is empty if from both starts a level dies out, that is, keeps less than half a
/// percent of the pixels.
TwoLevels split_levels(const cv::Mat& image, const cv::Mat& mask);

/// Whether the levels differ by a step and not by a slope of the shade or by noise.
bool is_a_step(const TwoLevels& levels, const cv::Mat& image, const cv::Mat& mask);

}  // namespace havers::images
