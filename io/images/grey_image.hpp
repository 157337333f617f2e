// An image file as one grey channel. Private to io/images.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace havers::images {

/// Reads PNG, TIFF, JPEG, BMP or DICOM, a TIFF with all its pages. Pages keep their 8 or 16 bits;
/// anything else is float, and finite.
/// @throws io::InputError when it is missing or not an image.
std::vector<cv::Mat> read_pages(const std::filesystem::path& file);

/// One channel: of a grey image its own 8 bit, 16 bit or float, of a coloured one 16 bit along the
/// main axis of colour (I1). What is transparent becomes background. `name` is for complaints.
/// @throws io::InputError when it is of one grey level only.
cv::Mat to_grey(const cv::Mat& image, const std::string& name);

/// Whether it has one channel, or colours of equal channels: then levels are those of the file.
bool is_grey(const cv::Mat& image);

/// How far apart a pixel's channels are, in 255ths of what is full; empty for a grey image.
cv::Mat colourfulness(const cv::Mat& image);

/// A page as a mask of the given size: 255 where it is brighter than half its own range.
/// Much grey in it is a warning. `name` is for complaints.
/// @throws io::InputError when it is of another size, or marks nothing.
cv::Mat to_mask(cv::Mat mask, const std::string& name, cv::Size size,
                std::vector<std::string>& warnings);

/// Size of a copy whose longer side is at most `side` pixels.
cv::Size fitted(cv::Size size, int side);

}  // namespace havers::images
