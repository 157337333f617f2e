// The pixel size that an image file states of itself. Private to io/images.
#pragma once

#include <filesystem>
#include <optional>

namespace havers::images {

/// From PNG (pHYs), TIFF (resolution; ImageJ's unit) or DICOM (pixel spacing). Resolutions that
/// programs write for printers and screens, 72 dots an inch and the like, say nothing of bone and
/// count as none, as do pixels that are not square. [m]
std::optional<double> tagged_pixel_size(const std::filesystem::path& file);

}  // namespace havers::images
