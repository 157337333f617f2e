#include "io/images/overlay.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "io/images/grey_image.hpp"

namespace havers::images {

// Few grey levels and a little smoothing, or noise would make a report of many sections megabytes
// long.
std::vector<std::uint8_t> draw_overlay(const cv::Mat& grey, const PoreMap& map) {
  cv::Mat small, pores, bone, colour;
  cv::resize(grey, small, fitted(grey.size(), 640), 0.0, 0.0, cv::INTER_AREA);
  cv::normalize(small, small, 0, 15, cv::NORM_MINMAX, CV_8U);
  cv::medianBlur(small, small, 3);
  cv::cvtColor(small * 16, colour, cv::COLOR_GRAY2BGR);
  cv::resize(map.pores, pores, small.size(), 0.0, 0.0, cv::INTER_AREA);
  cv::resize(map.bone, bone, small.size(), 0.0, 0.0, cv::INTER_AREA);

  colour.setTo(cv::Scalar(48, 48, 224), pores > 127);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(bone > 127, outlines, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  cv::drawContours(colour, outlines, -1, cv::Scalar(224, 128, 0), 1);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", colour, png, {cv::IMWRITE_PNG_COMPRESSION, 6});
  return png;
}

}  // namespace havers::images
