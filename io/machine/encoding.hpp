// Which encoding a text is in.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace havers::io {

/// What must be known to read a text as UTF-8.
struct Encoding {
  std::string
      name;  ///< As shown to the user; also iconv's name where `convert`. Empty: not a text.
  bool convert = false;        ///< Whether the bytes must be converted to be UTF-8.
  std::size_t mark_bytes = 0;  ///< Length of the byte order mark.
};

/// Finds the encoding of a file from its first bytes: byte order mark, zero bytes (UTF-16), pure
/// ASCII, valid UTF-8, and only then a guess by uchardet.
Encoding find_encoding(std::string_view bytes);

}  // namespace havers::io
