// Numbers and text at places of a file. Private to io/images.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace havers::images {

/// A place in a file, counted from its start. [byte]
using Offset = std::uint64_t;

/// Of what the file's end cuts off a number is zero and a text is what is left, so that a reader
/// that follows the offsets of a damaged file need not check them. Not for use by two threads at
/// once.
class FileBytes {
 public:
  explicit FileBytes(const std::filesystem::path& file) : in_(file, std::ios::binary) {}
  /// Sets the order of bytes for the numbers read after it; at first big endian, as in PNG.
  void set_big_endian(bool big) { big_endian_ = big; }

  /// At most 4096 bytes: a length read from a damaged file may be anything.
  std::string text(Offset at, std::size_t length) {
    std::string found(std::min<std::size_t>(length, 4096), '\0');
    // After a read that met the end of the file all others fail until the state is cleared.
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(found.data(), static_cast<std::streamsize>(found.size()));
    found.resize(static_cast<std::size_t>(in_.gcount()));
    return found;
  }

  /// Of 1 to 8 bytes.
  std::uint64_t number(Offset at, std::size_t size) {
    std::string bytes = text(at, size);
    if (bytes.size() < size) return 0;
    if (!big_endian_) std::reverse(bytes.begin(), bytes.end());
    std::uint64_t value = 0;
    for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
    return value;
  }

 private:
  std::ifstream in_;
  bool big_endian_ = true;
};

}  // namespace havers::images
