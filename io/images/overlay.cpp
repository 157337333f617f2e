#include "io/images/overlay.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "io/images/masks.hpp"

namespace havers::images {
namespace {

// 255 for cells of which at least half the pixels are set.
cv::Mat cells_of(const cv::Mat& mask, int factor) {
  return averaged(mask, factor, cv::BORDER_CONSTANT) > 127.0;
}

}  // namespace

// Few grey levels and a little smoothing, or noise would make a report of many sections megabytes
// long.
std::vector<std::uint8_t> draw_overlay(const cv::Mat& grey, const PoreMap& map,
                                       const cv::Rect& box) {
  constexpr int longest = 640;  // [px]
  const int factor = (std::max(grey.cols, grey.rows) + longest - 1) / longest;
  cv::Mat small = averaged(grey, factor, cv::BORDER_REPLICATE), colour;
  cv::normalize(small, small, 0, 15, cv::NORM_MINMAX, CV_8U);
  cv::medianBlur(small, small, 3);
  cv::cvtColor(small * 16, colour, cv::COLOR_GRAY2BGR);

  // The box need not begin where a cell does.
  const cv::Point shift(box.x % factor, box.y % factor);
  const auto aligned = [&](const cv::Mat& mask) {
    cv::Mat whole = cv::Mat::zeros(mask.size() + cv::Size(shift), CV_8U);
    mask.copyTo(whole(cv::Rect(shift, mask.size())));
    return cells_of(whole, factor);
  };
  const cv::Mat bone = aligned(map.bone);
  cv::Mat inside = colour(cv::Rect(box.tl() / factor, bone.size()));
  inside.setTo(cv::Scalar(48, 48, 224), aligned(map.pores));
  if (!map.cracks.empty()) inside.setTo(cv::Scalar(32, 208, 240), aligned(map.cracks));
  std::vector<Contour> outlines;
  // Holes included, so that the border of the marrow is drawn too.
  cv::findContours(bone, outlines, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  cv::drawContours(inside, outlines, -1, cv::Scalar(224, 128, 0), 1);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", colour, png, {cv::IMWRITE_PNG_COMPRESSION, 3});
  return png;
}

calib::DepthHistogram histogram_of(const Depth& depth, const PoreMap& map) {
  constexpr int bins = 80;
  // Depths from −0.5 to 1.5; what lies outside is in the first and the last bin.
  constexpr double from = -0.5, width = 2.0 / bins;
  calib::DepthHistogram histogram{.share = std::vector<double>(bins, 0.0),
                                  .threshold = map.threshold};
  const std::vector<float> samples = sample_depths(depth, map.bone, 100000);
  for (int bin = 0; bin < bins; ++bin) histogram.depth.push_back(from + width * (bin + 0.5));
  for (const float value : samples) {
    const auto bin = static_cast<int>((value - from) / width);
    histogram.share[static_cast<std::size_t>(std::clamp(bin, 0, bins - 1))] +=
        1.0 / static_cast<double>(samples.size());
  }
  return histogram;
}

}  // namespace havers::images
