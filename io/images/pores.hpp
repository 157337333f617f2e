// Pores inside the bone: grey levels, threshold, areas. Private to io/images.
#pragma once

#include <opencv2/core.hpp>

#include "io/images/regions.hpp"
#include "io/images/surface.hpp"

namespace havers::images {

/// Grey levels of bone and pores. Depth is 0 in bone and 1 in pores wherever the shade is (I6):
/// sign (B − I) / (offset + slope B).
struct Levels {
  Surface bone;       ///< B.
  double sign = 1.0;  ///< −1 where pores are brighter than bone.
  double offset = 1.0, slope = 0.0;
  double noise = 0.0;  ///< SD of a pixel. [grey levels]

  [[nodiscard]] double contrast(double bone_level) const { return offset + slope * bone_level; }
};

/// The pores of one section. Areas in pixels.
struct PoreMap {
  cv::Mat bone, pores;     ///< 255 on bone (pores included), on pores.
  double threshold = 0.5;  ///< Of the depth (I7).
  double area = 0.0;
  double area_squared = 0.0;  ///< Sum of squares over pores.
  double area_by_grey = 0.0;  ///< Without a threshold: the integral of depth about the pores (I8).
  double largest = 0.0;
  int count = 0;
  int specks = 0;  ///< Objects below `smallest_pore`, left out.
};
constexpr int smallest_pore = 4;  // [px]

/// Levels of bone and noise, from the coarse division.
Levels bone_levels(const cv::Mat& grey, const Regions& regions);

/// The bone on the full image; empty when there is none.
cv::Mat find_bone(const cv::Mat& grey, const Regions& regions, Levels levels);

/// The pores in `bone`. An image without a second level has none.
PoreMap find_pores(const cv::Mat& grey, const cv::Mat& bone, bool outlined, Levels levels);

/// Count, areas and specks of a pore image; specks are wiped from it.
void count_pores(PoreMap& map);

}  // namespace havers::images
