// The pixel size of an image, given or stated by the file. Private to io/images.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/images/measure_section.hpp"

namespace havers::images {

/// From PNG (pHYs), TIFF (resolution; ImageJ's unit) or DICOM (pixel spacing). Resolutions that
/// programs write for printers and screens, 72 dots an inch and the like, say nothing of bone and
/// count as none, as do pixels that are not square. [m]
std::optional<double> tagged_pixel_size(const std::filesystem::path& file);

/// The given size, otherwise the file's own; nullopt where there is neither, or the file's own is
/// not plausible. Adds a warning where the file's own is used, not plausible, or unlike the given
/// one. [m]
/// @throws io::InputError when the given one is not plausible and `any_pixel_size` is not set.
std::optional<double> pixel_size_of(const std::filesystem::path& image,
                                    const io::SectionOptions& options,
                                    std::vector<std::string>& warnings);

}  // namespace havers::images
