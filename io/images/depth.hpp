// The depth image: 0 in bone, 1 in pores. Private to io/images.
#pragma once

#include "io/images/pores.hpp"

namespace havers::images {

/// Sets `levels`' contrast from pixels known to be pores or background.
void fit_contrast(const cv::Mat& grey, const cv::Mat& pores, Levels& levels);

/// What a depth image (I6) is made of.
struct DepthSource {
  const cv::Mat& grey;
  const Levels& levels;
  double sigma = 0.0;   ///< Of the smoothing. [px]
  cv::Mat within = {};  ///< Where not set, depth is 0 before it is smoothed; empty: set everywhere.
};

/// Depth of every pixel, float.
void make_depth(const DepthSource& source, cv::Mat& depth);

/// Clears `mask` where depth is not less than `threshold`, without a depth image.
void keep_shallower(const DepthSource& source, double threshold, cv::Mat& mask);

}  // namespace havers::images
