// Local porosity in windows, and what its variation says of the mean. Private to io/images.
#pragma once

#include <opencv2/core.hpp>

namespace havers::images {

/// Local porosity: how far it varies.
struct WindowSpread {
  double sd = 0.0;              ///< [-]
  double standard_error = 0.0;  ///< Of the SD. [-]
};

/// SD of porosity over windows of length × height pixels (fractions count), lying and standing,
/// wholly inside the bone (I9). NaN where none fits.
WindowSpread window_spread(const cv::Mat& bone, const cv::Mat& pores, double length, double height);

/// Standard error of the porosity from how it differs between the parts of a 4 × 4 grid (I10). [-]
double porosity_standard_error(const cv::Mat& bone, const cv::Mat& pores);

}  // namespace havers::images
