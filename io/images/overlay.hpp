// What was found, to be looked at. Private to io/images.
#pragma once

#include <cstdint>
#include <vector>

#include "io/images/pores.hpp"

namespace havers::images {

/// PNG of at most 640 pixels a side: the section in few grey levels, pores red, cracks yellow, the
/// bone's outline blue. `box` is the part of it that the map covers.
std::vector<std::uint8_t> draw_overlay(const cv::Mat& grey, const PoreMap& map,
                                       const cv::Rect& box);

/// Depths of the bone's pixels, pores included.
calib::DepthHistogram histogram_of(const Depth& depth, const PoreMap& map);

}  // namespace havers::images
