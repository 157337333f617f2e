// Words in the names that files give to things.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace havers::io {

/// Lower case of ASCII and of the accented letters of western and central European languages
/// (U+00C0 to U+017F), of a text in UTF-8; as many bytes as before. Other letters stay as they are.
std::string lower(std::string_view text);

/// A word that is common inside others ("last" in "plastic") must stand alone.
enum class Match { anywhere, alone };

/// Whether a text in lower case contains the word.
bool contains(std::string_view text, std::string_view word, Match match);
/// Whether it contains one of the words.
bool contains_any(std::string_view text, std::span<const std::string_view> words,
                  Match match = Match::anywhere);

}  // namespace havers::io
