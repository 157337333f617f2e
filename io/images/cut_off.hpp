// Files whose end is missing, which decoders read in part without a word. Private to io/images.
#pragma once

#include <cstddef>
#include <filesystem>

namespace havers::images {

/// @throws io::InputError when a TIFF has more pages than were read, or a JPEG no end marker.
void check_all_was_read(const std::filesystem::path& file, std::size_t pages_read);

}  // namespace havers::images
