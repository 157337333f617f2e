// Depth: 0 in bone, 1 in pores (I6). No image of depths is kept; they are read where they are asked
// for. Private to io/images.
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "io/images/masks.hpp"
#include "io/images/surface.hpp"

namespace havers::images {

/// Grey levels of bone and pores, wherever the shade is.
struct Levels {
  Surface bone;                      ///< B.
  double sign = 1.0;                 ///< −1 where pores are brighter than bone.
  double offset = 1.0, slope = 0.0;  ///< The contrast is offset + slope B,
  double least = 0.0;                ///< but not less than this.
  double usual = 1.0;                ///< Contrast in the median, where it was fitted.
  double noise = 0.0;                ///< SD of a pixel. [grey levels]

  /// C. After fit_contrast it is at least `least`, so that no depth is infinite.
  [[nodiscard]] double contrast(double bone_level) const {
    return std::max(offset + slope * bone_level, least);
  }
  /// (I6) 0 at the level of bone and 1 at that of pores, be they darker or brighter than bone.
  [[nodiscard]] double depth(double bone_level, double grey) const {
    return sign * (bone_level - grey) / contrast(bone_level);
  }
};

/// Sets `levels`' contrast from pixels known to be pores or background; without such pixels it
/// stays as it is. It becomes negative if they lie on the other side of bone than `levels.sign`
/// says.
void fit_contrast(const cv::Mat& grey, const cv::Mat& pores, Levels& levels);

/// What depths are read from.
struct Depth {
  cv::Mat grey;        ///< The image under less noise: 8 bit become 16, 16 become float.
  double unit = 1.0;   ///< A grey level in steps of `grey`.
  double sigma = 0.0;  ///< Of the smoothing. [px]
  Levels levels;       ///< In grey levels, not in steps of `grey`.
};

/// Makes `depth.grey` of the image, unless it is not empty and was made with the same `sigma`;
/// image and `within` are not compared. Outside `within` the image is taken to be at the bone's
/// level. With a `sigma` of 0 `depth.grey` shares the image's memory.
void smooth(const cv::Mat& image, double sigma, Depth& depth, const cv::Mat& within = {});

/// 255 in `within` where depth is more, or less, than `threshold`.
cv::Mat deeper(const Depth& depth, double threshold, const cv::Mat& within);
cv::Mat shallower(const Depth& depth, double threshold, const cv::Mat& within);

/// Calls `use(x, y, depth)` for every set pixel.
template <class Use>
void for_each_depth(const Depth& depth, const cv::Mat& mask, Use use) {
  cv::Mat row;
  for (int y = 0; y < mask.rows; ++y) {
    depth.grey.row(y).convertTo(row, CV_32F, 1.0 / depth.unit);
    const auto* grey = row.ptr<float>();
    const SurfaceRow bone = depth.levels.bone.row(y);
    for_each_set(mask, y, [&](int x) {
      use(x, y, depth.levels.depth(bone.at(static_cast<float>(x)), grey[x]));
    });
  }
}

/// Depths of about `count` pixels where `mask` is set, on a square grid.
std::vector<float> sample_depths(const Depth& depth, const cv::Mat& mask, int count);

}  // namespace havers::images
