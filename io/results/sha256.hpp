// SHA-256 digests, hexadecimal (libmd inside).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace havers::io {

/// Of a file. @throws InputError when it is a folder or cannot be read.
std::string sha256(const std::filesystem::path& file);

/// Of the bytes of a text.
std::string sha256_of_text(std::string_view text);

}  // namespace havers::io
