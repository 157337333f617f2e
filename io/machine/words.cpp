#include "io/machine/words.hpp"

#include <algorithm>

namespace havers::io {
namespace {

// For text in lower case. Every byte of a character that is not ASCII counts as a letter.
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || static_cast<signed char>(c) < 0;
}

// The small letter of a letter of Latin-1 (from U+00C0), where it stands 32 places on, or of Latin
// Extended-A (to U+017F), where it is the next. There capitals have even numbers or, in two ranges,
// odd ones. U+00D7 is the multiplication sign, and the small letter of U+0130 is not a single one.
unsigned small_letter(unsigned letter) {
  if (letter < 0x100)
    return letter >= 0xC0 && letter <= 0xDE && letter != 0xD7 ? letter + 0x20 : letter;
  if (letter == 0x130 || letter == 0x138 || letter == 0x149 || letter >= 0x17F) return letter;
  if (letter == 0x178) return 0xFF;
  const bool at_odd = (letter > 0x138 && letter < 0x149) || letter > 0x178;
  return (letter % 2 == 1) == at_odd ? letter + 1 : letter;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto byte = static_cast<unsigned char>(result[i]);
    if (byte >= 'A' && byte <= 'Z') result[i] = static_cast<char>(byte + 0x20);
    if (byte < 0xC3 || byte > 0xC5 || i + 1 == result.size()) continue;
    const auto second = static_cast<unsigned char>(result[i + 1]);
    const unsigned small = small_letter((byte & 0x1FU) << 6U | (second & 0x3FU));
    result[i] = static_cast<char>(0xC0U | small >> 6U);
    result[++i] = static_cast<char>(0x80U | (small & 0x3FU));
  }
  return result;
}

bool contains(std::string_view text, std::string_view word, Match match) {
  for (std::size_t at = text.find(word); at != std::string_view::npos;
       at = text.find(word, at + 1)) {
    const bool alone = (at == 0 || !is_letter(text[at - 1])) &&
                       (at + word.size() == text.size() || !is_letter(text[at + word.size()]));
    if (match == Match::anywhere || alone) return true;
  }
  return false;
}

bool contains_any(std::string_view text, std::span<const std::string_view> words, Match match) {
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return contains(text, word, match); });
}

}  // namespace havers::io
