// (I12) All is done on the coarse copy, whose cells hold shares of bone and pores. Sums of shares
// are as exact as sums of pixels; only the borders between zones are coarse.
#include "io/images/zones.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "io/images/masks.hpp"

namespace havers::images {
namespace {

struct ZoneSums {
  double bone = 0.0, pores = 0.0;
};

// From 0 at the outer surface to 1 at the marrow; without marrow, where it is deepest.
cv::Mat relative_depth(const cv::Mat& share) {
  const cv::Mat bone = share >= 0.5;
  cv::Mat filled = cv::Mat::zeros(bone.size(), CV_8U), from_outside, from_marrow;
  for (const Contour& border : outer_contours(bone)) fill(filled, border, 255);
  // A frame of unset cells: where the image cuts the bone off, its edge is the outer surface.
  cv::Mat padded;
  cv::copyMakeBorder(filled, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::distanceTransform(padded, from_outside, cv::DIST_L2, 3);
  from_outside = from_outside(cv::Rect({1, 1}, bone.size()));
  const cv::Mat marrow = filled & ~bone;
  if (cv::countNonZero(marrow) == 0) {
    double deepest = 0.0;
    cv::minMaxLoc(from_outside, nullptr, &deepest);
    return from_outside / std::max(1.0, deepest);
  }
  cv::distanceTransform(~marrow, from_marrow, cv::DIST_L2, 3);
  return from_outside / (from_outside + from_marrow);
}

calib::Zone zone(const char* name, const ZoneSums& sums) {
  return {name, sums.bone > 0.0 ? sums.pores / sums.bone : 0.0, sums.bone};
}

}  // namespace

std::vector<calib::Zone> zones_of(const cv::Mat& bone, const cv::Mat& pores, bool outlined) {
  const int factor = reduction(bone.size());
  const cv::Mat bones = averaged(bone, factor, cv::BORDER_CONSTANT) / 255.0;
  const cv::Mat holes = averaged(pores, factor, cv::BORDER_CONSTANT) / 255.0;
  const cv::Mat depth = outlined ? relative_depth(bones) : cv::Mat();
  const cv::Moments moments = cv::moments(bones);
  const double x0 = moments.m10 / moments.m00, y0 = moments.m01 / moments.m00;
  std::array<ZoneSums, 4> quarters;
  std::array<ZoneSums, 3> layers;
  const auto add = [](ZoneSums& sums, float b, float p) { sums.bone += b, sums.pores += p; };
  for (int y = 0; y < bones.rows; ++y)
    for (int x = 0; x < bones.cols; ++x) {
      const float b = bones.at<float>(y, x), p = holes.at<float>(y, x);
      const double right = x - x0, up = y0 - y;
      // The axes are in the middle of quarters: the right one reaches from −45° to 45°.
      const bool sideways = std::abs(right) > std::abs(up);
      add(quarters[sideways ? (right > 0.0 ? 0U : 2U) : (up > 0.0 ? 1U : 3U)], b, p);
      if (outlined)
        add(layers[static_cast<std::size_t>(std::min(2.0F, 3.0F * depth.at<float>(y, x)))], b, p);
    }
  const double pixels = static_cast<double>(factor) * factor;
  std::vector<calib::Zone> zones{zone("right", quarters[0]), zone("top", quarters[1]),
                                 zone("left", quarters[2]), zone("bottom", quarters[3])};
  if (outlined)
    zones.insert(zones.end(), {zone("outer third", layers[0]), zone("middle third", layers[1]),
                               zone("inner third", layers[2])});
  for (calib::Zone& one : zones) one.bone_area *= pixels;
  return zones;
}

}  // namespace havers::images
