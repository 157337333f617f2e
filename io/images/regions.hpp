// Where the bone is: found on a small copy of the image, outlined on the image itself. Private to
// io/images.
#pragma once

#include <opencv2/core.hpp>

#include "io/images/measure_section.hpp"
#include "io/images/surface.hpp"

namespace havers::images {

/// The image's coarse division.
struct Regions {
  bool outlined =
      false;  ///< Background surrounds the bone; otherwise bone fills the image or the user's mask.
  bool dark_pores = true;  ///< Darker than bone are the background and, until more is known, pores.
  bool either_is_bone = false;  ///< Neither frame nor pores tell bone from background.
  cv::Rect box;        ///< What of the image the masks below cover, and all that follows from them.
  cv::Mat bone;        ///< 255 on what is surely bone or pores in it.
  cv::Mat search;      ///< 255 where the outline may run: bone, holes and a rim around.
  cv::Mat background;  ///< 255 on background next to the bone; empty without an outline.
};

/// Divides the image into bone and background by two levels under one smooth shade (I2), and finds
/// which of the two is bone (I3).
Regions divide(const cv::Mat& grey, io::Pores pores);

/// The same where the user's mask says where the bone is.
Regions divide(const cv::Mat& grey, const cv::Mat& mask, io::Pores pores);

/// The bone, pores included, marrow cavity excluded (I4): `solid` (255) is what is brighter than
/// half way. Empty when there is none.
cv::Mat outline(const cv::Mat& solid);

}  // namespace havers::images
