// The depth image: 0 in bone, 1 in pores. Private to io/images.
#pragma once

#include "io/images/pores.hpp"

namespace havers::images {

/// Sets `levels`' contrast from pixels known to be pores or background.
void fit_contrast(const cv::Mat& grey, const cv::Mat& pores, Levels& levels);

/// Depth (I6) of every pixel, float, smoothed by `sigma` [px].
void make_depth(const cv::Mat& grey, const Levels& levels, double sigma, cv::Mat& depth);

/// Gaussian smoothing in place; 0 is none. [px]
void smooth(cv::Mat& depth, double sigma);

}  // namespace havers::images
