#include "io/machine/split_unit.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "io/machine/fact_names.hpp"
#include "io/machine/quantity.hpp"
#include "io/machine/vocabulary.hpp"

namespace havers::io {
namespace {

bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}

// "daX", "hPa": a capital inside a short word. "raw", "DIC", "Ist" are none.
bool has_inner_capital(std::string_view text) {
  constexpr std::size_t longest = 4;
  if (text.size() > longest) return false;
  for (std::size_t i = 1; i < text.size(); ++i)
    if (is_lower(text[i - 1]) && is_upper(text[i])) return true;
  return false;
}

// What is no known unit and yet hardly anything else. A wrong guess would cost a column, so in
// doubt it is none.
bool looks_like_a_unit(std::string_view text) {
  constexpr std::array<std::string_view, 5> not_of_a_test{"kg", "g", "t", "ft", "bar"};
  if (quantity_of_name(text) != Quantity::other || text.find(' ') != std::string_view::npos)
    return false;
  if (std::ranges::find(not_of_a_test, text) != not_of_a_test.end()) return true;
  for (const std::string_view mark : {"%", "‰", "²", "³", "°", "µ", "μ"})
    if (text.find(mark) != std::string_view::npos) return true;
  const std::size_t slash = text.find('/');
  if (slash != std::string_view::npos) return find_unit(text.substr(0, slash)).has_value();
  return has_inner_capital(text);
}

// Whether what is called so can have the unit; a strain by "m" or "in" is more likely a word.
bool can_have(std::string_view name, std::string_view text) {
  const std::optional<Unit> unit = find_unit(text);
  if (!unit) return false;
  if (const std::optional<Fact> fact = fact_of_key(name))
    return *fact != Fact::specimen_id && *fact != Fact::specimen_number &&
           unit->dimension == (*fact == Fact::area ? Dimension::area : Dimension::length);
  const Quantity quantity = quantity_of_name(name);
  if (quantity == Quantity::strain && (text == "m" || text == "in")) return false;
  return fits(quantity, unit->dimension) ||
         (quantity == Quantity::other && is_of_strain_alone(*unit));
}

// At the end of a name a unit in volts stands for a signal whose factor is not known yet.
bool is_signal(std::string_view text) {
  const std::optional<Unit> unit = find_unit(text);
  return unit && unit->dimension == Dimension::voltage;
}

NameAndUnit named_unit(std::string_view name, std::string_view unit) {
  return {std::string(without_blanks(name)), std::string(without_blanks(unit))};
}

// "Force (lbf) A", "Strain [%] (gauge)": brackets wherever they stand, with a unit that the
// quantity named by the rest can have.
std::optional<NameAndUnit> unit_inside(std::string_view text) {
  constexpr std::string_view opening = "([";
  for (std::size_t open = text.find_first_of(opening); open != std::string_view::npos;
       open = text.find_first_of(opening, open + 1)) {
    const std::size_t close = text.find(text[open] == '(' ? ')' : ']', open);
    if (close == std::string_view::npos) continue;
    std::string name(without_blanks(text.substr(0, open)));
    name.append(" ").append(without_blanks(text.substr(close + 1)));
    NameAndUnit split = named_unit(name, text.substr(open + 1, close - open - 1));
    if (can_have(split.name, split.unit)) return split;
  }
  return std::nullopt;
}

// The last brackets, where they hold what is a unit or looks like one; "(mm)" alone is a name.
std::optional<NameAndUnit> unit_at_end(std::string_view text) {
  if (text.back() != ')' && text.back() != ']') return std::nullopt;
  const std::size_t open = text.rfind(text.back() == ')' ? '(' : '[');
  if (open == std::string_view::npos || open == 0) return std::nullopt;
  const std::string_view unit = without_brackets(text.substr(open));
  if (!unit.empty() && !find_unit(unit) && !looks_like_a_unit(unit)) return std::nullopt;
  return named_unit(text.substr(0, open), unit);
}

}  // namespace

NameAndUnit split_unit(std::string_view text) {
  text = without_blanks(text);
  NameAndUnit whole{std::string(text), {}};
  if (text.empty()) return whole;
  const std::optional<NameAndUnit> at_end = unit_at_end(text);
  if (at_end && (can_have(at_end->name, at_end->unit) || is_signal(at_end->unit))) return *at_end;
  if (const std::optional<NameAndUnit> inside = unit_inside(text)) return *inside;
  if (at_end) return *at_end;
  if (text.back() == ')' || text.back() == ']') return whole;
  // Without brackets a text is a unit only where the named quantity can have it: not in "Load_in".
  for (const std::string_view mark : {"/", " in ", "_", ", ", " "}) {
    // Of "Stress/N/mm2" the first stroke, of "max_force_kN" the last underline.
    const std::size_t at = mark == "/" ? text.find(mark) : text.rfind(mark);
    if (at == std::string_view::npos || at == 0) continue;
    NameAndUnit split = named_unit(text.substr(0, at), text.substr(at + mark.size()));
    if (can_have(split.name, split.unit)) return split;
  }
  return whole;
}

}  // namespace havers::io
