#include "io/machine/words.hpp"

#include <algorithm>

namespace havers::io {
namespace {

// Of a text in lower case; every byte of a character that is not ASCII counts as one.
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || static_cast<signed char>(c) < 0;
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto byte = static_cast<unsigned char>(result[i]);
    // U+00C0 to U+00DE are 0xC3 and a byte that is 0x20 below that of its lower case.
    const bool accented = i > 0 && result[i - 1] == '\xC3' && byte >= 0x80 && byte <= 0x9E;
    if ((byte >= 'A' && byte <= 'Z') || accented) result[i] = static_cast<char>(byte + 0x20);
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
