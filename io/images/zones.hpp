// Porosity by place in the section. Private to io/images.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "calib/porosity/section_porosity.hpp"

namespace havers::images {

/// The four quarters by angle about the bone's centre and, where the bone has an outline, three
/// layers from its surface to the marrow, or to its middle (I12). Areas in pixels.
std::vector<calib::Zone> zones_of(const cv::Mat& bone, const cv::Mat& pores, bool outlined);

}  // namespace havers::images
