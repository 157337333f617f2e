#include "io/read_text.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "io/input_error.hpp"

namespace havers::io {

std::string read_text(const std::filesystem::path& file, const std::string& hint) {
  // Only a missing file and a folder are refused beforehand; anything else, as a pipe, is read.
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(file, error).type();
  if (type == std::filesystem::file_type::not_found)
    throw InputError(file.string(), "is not there", hint);
  if (type == std::filesystem::file_type::directory)
    throw InputError(file.string(), "is a folder", hint);
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InputError(file.string(), std::string("cannot be read: ") + std::strerror(errno));
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace havers::io
