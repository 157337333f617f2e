#include "io/machine/excerpt.hpp"

#include <algorithm>

namespace havers::io {

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 60;                             // [byte]
  constexpr unsigned char continues = 0x80, continuation = 0xC0;  // of a character in UTF-8
  std::size_t length = std::min(text.size(), longest);
  // Never cut in the middle of a character.
  while (length < text.size() && length > 0 &&
         (static_cast<unsigned char>(text[length]) & continuation) == continues)
    --length;
  std::string shown(text.substr(0, length));
  std::ranges::replace_if(
      shown, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return length < text.size() ? shown + "..." : shown;
}

}  // namespace havers::io
