#include "io/results/sha256.hpp"

#include <sha256.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "io/input_error.hpp"

namespace havers::io {

using Digest = std::array<char, SHA256_DIGEST_STRING_LENGTH>;  // 64 digits and a final zero

std::string sha256(const std::filesystem::path& file) {
  Digest digest{};
  if (std::filesystem::is_directory(file))
    throw InputError(file.string(), "is a folder, not a file");
  if (SHA256File(file.c_str(), digest.data()) == nullptr)
    throw InputError(file.string(), std::string("cannot be read: ") + std::strerror(errno));
  return digest.data();
}

std::string sha256_of_text(std::string_view text) {
  Digest digest{};
  const auto* bytes =
      reinterpret_cast<const std::uint8_t*>(text.data());  // NOLINT(*-reinterpret-cast)
  SHA256Data(bytes, text.size(), digest.data());
  return digest.data();
}

}  // namespace havers::io
