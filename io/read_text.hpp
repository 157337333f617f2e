// A small file as a whole; test files are read in blocks (io/machine).
#pragma once

#include <filesystem>
#include <string>

namespace havers::io {

/// All of a file. @throws InputError when it is not there or a folder, with the hint of what is
/// expected there, and when it cannot be read.
std::string read_text(const std::filesystem::path& file, const std::string& hint);

}  // namespace havers::io
