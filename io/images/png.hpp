// PNG by libdeflate: three times as fast as by zlib, which OpenCV unpacks with. Private to
// io/images.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace havers::images {

/// The image in OpenCV's order of channels. Empty for what OpenCV reads, or refuses: anything but
/// a sound PNG of 8 or 16 bit grey or 8 bit colour, not interlaced, no level made transparent.
cv::Mat read_png(const std::filesystem::path& file);

}  // namespace havers::images
