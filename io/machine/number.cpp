// Almost every cell is a few digits and a mark, and is converted directly. Any other goes to
// from_chars, scrubbed of what that does not take: thousands marks, a plus, a decimal comma, the
// minus sign of typography.
#include "io/machine/number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace havers::io {
namespace {

constexpr std::string_view minus_sign = "\xE2\x88\x92";  // U+2212

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Length of the thousands mark at the beginning of `rest`; 0 where there is none.
std::size_t thousands_mark(std::string_view rest, char decimal) {
  if (is_digit(rest.front())) return 0;
  const char other = decimal == '.' ? ',' : '.';
  if (rest.front() == other || rest.front() == ' ' || rest.front() == '\'') return 1;
  // No-break blank, narrow no-break blank, thin blank, typographic apostrophe.
  for (const std::string_view mark : {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89", "\xE2\x80\x99"})
    if (rest.starts_with(mark)) return mark.size();
  return 0;
}

// Three digits and no fourth: "1,5" and "1,0000" group nothing.
bool is_group(std::string_view rest) {
  return rest.size() >= 3 && std::all_of(rest.begin(), rest.begin() + 3, is_digit) &&
         (rest.size() == 3 || !is_digit(rest[3]));
}

// Digits, a mark, digits, fifteen at most, a thousands mark before the first group: almost every
// cell. Both the digits and the power of ten are exact, so the quotient is the nearest double, as
// that of from_chars, which takes four times as long.
bool convert_short(std::string_view cell, char decimal, double& value) {
  static constexpr std::array powers{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                     1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = cell.front() == '-';
  if (negative) cell.remove_prefix(1);
  if (cell.empty() || cell.size() > powers.size() || !is_digit(cell.front())) return false;
  const char other = decimal == '.' ? ',' : '.';
  std::int64_t digits = 0;
  std::size_t after_mark = cell.size();  // how many characters follow the mark; all: there is none
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (is_digit(cell[i]))
      digits = 10 * digits + (cell[i] - '0');
    else if (cell[i] == decimal && after_mark == cell.size())
      after_mark = cell.size() - i - 1;
    else if (cell[i] != other || i > 3 || cell[0] == '0' || after_mark < cell.size() ||
             !is_group(cell.substr(i + 1)))
      return false;
  }
  const auto whole = static_cast<double>(digits);
  value = after_mark == cell.size() ? whole : whole / powers[after_mark];
  if (negative) value = -value;
  return true;
}

// The cell as from_chars wants it, in a buffer on the stack.
class Scrubbed {
 public:
  // False where the cell cannot be a number.
  bool scrub(std::string_view cell, char decimal) {
    if (cell.starts_with(minus_sign)) {
      put('-');
      cell.remove_prefix(minus_sign.size());
    } else if (cell.starts_with('+')) {
      cell.remove_prefix(1);
      if (cell.starts_with('-')) return false;
    }
    std::size_t whole = 0;  // digits before the decimal mark
    bool fraction = false;  // past the decimal mark or the exponent's letter
    bool grouped = false;
    while (!cell.empty() && length_ < buffer_.size()) {
      const std::size_t mark = fraction || whole == 0 ? 0 : thousands_mark(cell, decimal);
      if (mark > 0) {
        const bool leading_zero = buffer_[length_ - whole] == '0';
        // The first group has one to three digits and does not begin with 0.
        if ((!grouped && (whole > 3 || leading_zero)) || !is_group(cell.substr(mark))) return false;
        grouped = true;
        cell.remove_prefix(mark);
        continue;
      }
      const char c = cell.front();
      // from_chars would take this point for the decimal mark.
      if (c == '.' && decimal != '.') return false;
      if (is_digit(c) && !fraction) ++whole;
      if (c == decimal || c == 'e' || c == 'E') fraction = true;
      put(c == decimal ? '.' : c);
      cell.remove_prefix(1);
    }
    return cell.empty();
  }
  [[nodiscard]] std::string_view text() const { return {buffer_.data(), length_}; }

 private:
  void put(char c) { buffer_.at(length_++) = c; }
  std::array<char, 64> buffer_{};
  std::size_t length_ = 0;
};

// Of a number out of range: one by its exponent or, without one, by the zeros behind the mark. It
// is as good as zero.
bool is_small(std::string_view text) {
  const std::size_t exponent = text.find_first_of("eE");
  if (exponent != std::string_view::npos) return text.find('-', exponent) != std::string_view::npos;
  return text[text.find_first_not_of("+-0")] == '.';
}

Number convert(std::string_view text) {
  Number number;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number.value);
  if (error == std::errc::invalid_argument || stopped != end)
    number.fault = NumberFault::text;
  else if (error == std::errc::result_out_of_range)
    number = {0.0, is_small(text) ? NumberFault::none : NumberFault::too_large};
  else if (!std::isfinite(number.value))
    number.fault = NumberFault::not_finite;
  return number;
}

}  // namespace

std::string to_string(NumberFault fault) {
  constexpr std::array words{"is a number", "is empty", "is not a number", "is not a finite number",
                             "is too large for a number"};
  return words.at(static_cast<std::size_t>(fault));
}

Number parse_number(std::string_view cell, char decimal) {
  if (cell.empty()) return {0.0, NumberFault::empty};
  Number number;
  if (convert_short(cell, decimal, number.value)) return number;
  // First as it stands; only a cell that is a text so may still be a number once it is scrubbed.
  if (decimal == '.') {
    const Number plain = convert(cell);
    if (plain.fault != NumberFault::text) return plain;
  }
  Scrubbed scrubbed;
  if (!scrubbed.scrub(cell, decimal)) return {0.0, NumberFault::text};
  return convert(scrubbed.text());
}

Number parse_lone_number(std::string_view cell) {
  const auto points = std::ranges::count(cell, '.'), commas = std::ranges::count(cell, ',');
  // A single mark is the decimal one; where both kinds occur the last is; several of one kind group
  // thousands.
  bool comma = commas == 1;
  if (points > 0 && commas > 0)
    comma = cell.rfind(',') > cell.rfind('.');
  else if (points > 1)
    comma = true;
  return parse_number(cell, comma ? ',' : '.');
}

std::string_view without_half_day(std::string_view cell) {
  for (const std::string_view half :
       {"AM", "PM", "am", "pm", "a.m.", "p.m.", "a. m.", "p. m.", "A.M.", "P.M."}) {
    if (cell.size() <= half.size() || !cell.ends_with(half)) continue;
    cell.remove_suffix(half.size());
    if (cell.ends_with(' ')) cell.remove_suffix(1);
    break;
  }
  return cell;
}

namespace {

// Of a day of 24 hours.
Number parse_time_of_day(std::string_view cell) {
  if (cell.ends_with('Z')) cell.remove_suffix(1);
  cell.remove_prefix(cell.find_last_of(" T") + 1);  // npos + 1 is 0
  // With one colon and decimals, "12:01.5", these are minutes and seconds; "12:01" is refused, as
  // it may be hours and minutes.
  const bool minutes =
      cell.find_first_of(".,") != std::string_view::npos && std::ranges::count(cell, ':') == 1;
  const int parts = minutes ? 2 : 3;  // hours, minutes, seconds
  Number time;
  for (int part = 0; part < parts; ++part) {
    const std::size_t end = part + 1 < parts ? cell.find(':') : cell.size();
    if (end == std::string_view::npos || end == 0 || !is_digit(cell.front()))
      return {0.0, NumberFault::text};
    const Number number = parse_lone_number(cell.substr(0, end));
    if (number.fault != NumberFault::none || (part > 0 && number.value >= 60.0))
      return {0.0, NumberFault::text};
    time.value = 60.0 * time.value + number.value;
    cell.remove_prefix(std::min(end + 1, cell.size()));
  }
  return time;
}

}  // namespace

Number parse_clock(std::string_view cell) {
  constexpr double half_day = 43200.0;
  if (const std::string_view hours = without_half_day(cell); hours.size() < cell.size()) {
    const bool afternoon = cell.find_first_of("Pp", hours.size()) != std::string_view::npos;
    Number time = parse_time_of_day(hours);
    // From 1:00:00 to 12:59:59; twelve o'clock is hour 0 of its half.
    if (time.value >= half_day + 3600.0 || time.value < 3600.0) time.fault = NumberFault::text;
    time.value = std::fmod(time.value, half_day) + (afternoon ? half_day : 0.0);
    return time;
  }
  return parse_time_of_day(cell);
}

bool is_number(std::string_view cell, char decimal) {
  return parse_number(cell, decimal).fault == NumberFault::none;
}

}  // namespace havers::io
