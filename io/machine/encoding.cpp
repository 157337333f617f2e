#include "io/machine/encoding.hpp"

#include <iconv.h>
#include <uchardet/uchardet.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>

namespace havers::io {
namespace {

// Control characters that no text has. Tabs, line ends, form feeds and the end mark of DOS, 0x1A,
// may be in one.
bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\x1a';
}

// In UTF-16 of western text nearly every second byte is zero: here more than four fifths of these,
// and none of the others. Empty where the text is not UTF-16.
std::string utf16_by_zeros(std::string_view bytes) {
  std::array<std::size_t, 2> zeros{};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] == '\0') ++zeros.at(i % 2);
  const std::size_t many = bytes.size() / 2 * 8 / 10;
  if (bytes.size() < 4) return {};
  if (zeros[1] > many && zeros[0] == 0) return "UTF-16LE";
  if (zeros[0] > many && zeros[1] == 0) return "UTF-16BE";
  return {};
}

// A character cut off by the end of the block is no fault.
bool is_utf8(std::string text) {
  iconv_t check = iconv_open("UTF-16", "UTF-8");
  std::string converted(2 * text.size() + 2, '\0');
  char *in = text.data(), *out = converted.data();
  std::size_t in_left = text.size(), out_left = converted.size();
  const bool whole = iconv(check, &in, &in_left, &out, &out_left) != static_cast<std::size_t>(-1);
  const bool cut_off = !whole && errno == EINVAL;
  iconv_close(check);
  return whole || cut_off;
}

// Only lines with accents: a thousand lines of digits would drown the few that tell.
std::string telling_lines(std::string_view bytes) {
  std::string lines;
  while (!bytes.empty()) {
    const std::size_t length = std::min(bytes.find_first_of("\r\n"), bytes.size() - 1) + 1;
    const std::string_view line = bytes.substr(0, length);
    if (std::ranges::any_of(line, [](char c) { return static_cast<signed char>(c) < 0; }))
      lines += line;
    bytes.remove_prefix(length);
  }
  return lines;
}

// "si³a" for "siła": read as WINDOWS-1252, central European letters are symbols inside a word. The
// micro and degree signs stand before letters in their own right.
bool has_symbols_in_words(std::string_view text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool symbol = byte >= 0x80 && byte < 0xC0 && byte != 0xB5 && byte != 0xB0;
    if (symbol && std::isalpha(static_cast<unsigned char>(text[i + 1])) != 0) return true;
  }
  return false;
}

// The encoding of a text that is neither ASCII nor UTF-8.
std::string guess(std::string_view bytes) {
  const std::string lines = telling_lines(bytes);
  uchardet_t detector = uchardet_new();
  uchardet_handle_data(detector, lines.data(), lines.size());
  uchardet_data_end(detector);
  std::string name = uchardet_get_charset(detector);
  uchardet_delete(detector);
  // A few accents do not tell the alphabets apart, so western Europe is assumed unless the text
  // speaks against it. ISO-8859-1 is WINDOWS-1252 without the characters 0x80 to 0x9F.
  for (const char* known : {"GB18030", "BIG5", "SHIFT_JIS", "EUC-KR"})
    if (name == known) return name;
  const bool central = name == "WINDOWS-1250" || name == "ISO-8859-2";
  if (central && has_symbols_in_words(lines)) return name;
  const bool latin1 = std::ranges::none_of(lines, [](char c) {
    return static_cast<unsigned char>(c) >= 0x80 && static_cast<unsigned char>(c) < 0xA0;
  });
  return latin1 ? "ISO-8859-1" : "WINDOWS-1252";
}

}  // namespace

Encoding find_encoding(std::string_view bytes) {
  using std::string_view_literals::operator""sv;
  if (bytes.starts_with("\xEF\xBB\xBF")) return {"UTF-8 with BOM", false, 3};
  // UTF-32 is asked before UTF-16, as the mark of UTF-32LE begins with that of UTF-16LE.
  if (bytes.starts_with("\xFF\xFE\0\0"sv)) return {"UTF-32LE", true, 4};
  if (bytes.starts_with("\0\0\xFE\xFF"sv)) return {"UTF-32BE", true, 4};
  if (bytes.starts_with("\xFF\xFE"sv)) return {"UTF-16LE", true, 2};
  if (bytes.starts_with("\xFE\xFF"sv)) return {"UTF-16BE", true, 2};
  if (const std::string wide = utf16_by_zeros(bytes); !wide.empty()) return {wide, true, 0};
  // Zeros are control characters too: text in UTF-16 would be refused here.
  if (std::ranges::any_of(bytes, is_control)) return {};
  if (std::ranges::all_of(bytes, [](char c) { return static_cast<signed char>(c) >= 0; }))
    return {"ASCII", false, 0};
  if (is_utf8(std::string(bytes))) return {"UTF-8", false, 0};
  return {guess(bytes), true, 0};
}

}  // namespace havers::io
