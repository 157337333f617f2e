// Pores inside the bone: grey levels, threshold, areas. Private to io/images.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "io/images/depth.hpp"
#include "io/images/regions.hpp"

namespace havers::images {

/// The pores of one section. Areas in pixels.
struct PoreMap {
  cv::Mat bone, pores;        ///< 255 on bone (pores included), on pores.
  cv::Mat cracks;             ///< 255 on cracks, which are no pores; empty without any.
  double threshold = 0.5;     ///< Of the depth (I7).
  std::vector<double> areas;  ///< Of the pores.
  double area = 0.0;          ///< Of all of them.
  double perimeter = 0.0;     ///< Of all of them. [px]
  double area_by_grey = 0.0;  ///< Without a threshold: the integral of depth about the pores (I8).
  int crack_count = 0;
  double crack_area = 0.0;
  int specks = 0;           ///< Objects below `smallest_pore`, left out.
  bool dark = true;         ///< Whether pores are darker than bone.
  double other_side = 0.0;  ///< Share of bone as far to the other side of its level as pores are.
  double half_deep = 0.0;   ///< Bone away from pores, more than half as deep as the threshold.
  double full_depth = 1.0;  ///< Depth of pores without the blur.
  /// Of pores to bone, without the blur, over that of the background to bone; 1 without one.
  double contrast = 1.0;
};
constexpr int smallest_pore = 4;  // [px]

/// How pores are told from bone.
struct PoreOptions {
  io::Threshold threshold = io::Threshold::half_maximum;
  double crack_slenderness = 10.0;  ///< Length over width from which on it is a crack; 0: none is.
  io::Pores pores = io::Pores::found;
  bool rim = false;  ///< Bone fades into background at its surface.
};

/// Levels of bone and noise, from the coarse division.
Levels bone_levels(const cv::Mat& grey, const Regions& regions);

/// The bone on the full image; empty when there is none. Takes the masks of `regions`, which nobody
/// needs after this. `depth`, whose levels of bone are known, becomes that against the background.
cv::Mat find_bone(const cv::Mat& grey, Regions& regions, Depth& depth);

/// The pores in `bone`; `depth` becomes the one they were cut at. Where it is not known on which
/// side of the bone's level they are, that to which its grey levels have a tail is tried, and the
/// other if there are none (I3). An image without a second level has none.
PoreMap find_pores(const cv::Mat& grey, const cv::Mat& bone, const PoreOptions& options,
                   Depth& depth);

/// Sorts the objects of `map.pores` into pores, cracks and specks.
void sort_objects(double crack_slenderness, PoreMap& map);

}  // namespace havers::images
