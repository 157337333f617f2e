#include "io/read_text.hpp"

#include <fstream>
#include <iterator>

#include "io/input_error.hpp"

namespace havers::io {

std::string read_text(const std::filesystem::path& file, const std::string& hint) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError(file.string(), "cannot be read", hint);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace havers::io
