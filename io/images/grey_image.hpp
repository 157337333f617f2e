// An image file as one grey channel. Private to io/images.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace havers::images {

/// Reads PNG, TIFF, JPEG or BMP as one channel: 8 bit, 16 bit (kept so) or, from colour, float
/// along the image's main axis of colour (I1). What is transparent becomes background.
/// @throws io::InputError when it is missing, not an image, or of one grey level only.
cv::Mat read_grey(const std::filesystem::path& file);

/// Reads a mask of the given size: 255 where the file is brighter than half its own range.
/// @throws io::InputError when it cannot be read, is of another size, or marks nothing.
cv::Mat read_mask(const std::filesystem::path& file, cv::Size size);

/// Size of a copy whose longer side is at most `side` pixels.
cv::Size fitted(cv::Size size, int side);

}  // namespace havers::images
