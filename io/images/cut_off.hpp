// Files that are not whole, which decoders read in part without a word, or refuse in words of their
// own. Private to io/images.
#pragma once

#include <cstddef>
#include <filesystem>

namespace havers::images {

/// Call it before decoding. Files of other formats pass unchecked.
/// @throws io::InputError when a JPEG or BMP has no end, or a PNG is cut off or damaged.
void check_is_whole(const std::filesystem::path& file);

/// @throws io::InputError when a TIFF has more pages than were read.
void check_all_was_read(const std::filesystem::path& file, std::size_t pages_read);

}  // namespace havers::images
