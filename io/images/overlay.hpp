// A section with what was found drawn in. Private to io/images.
#pragma once

#include <cstdint>
#include <vector>

#include "io/images/pores.hpp"

namespace havers::images {

/// PNG of at most 640 pixels a side: the section in few grey levels, pores red, outline blue.
std::vector<std::uint8_t> draw_overlay(const cv::Mat& grey, const PoreMap& map);

}  // namespace havers::images
