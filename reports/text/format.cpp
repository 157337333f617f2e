// Numbers to text. Details are settled here once for all pages: rounding that adds a digit, zeros
// without a minus, true minus signs, spaces that do not break.
#include "reports/text/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

#include "calib/decimals.hpp"

namespace havers::reports {
namespace {

using calib::decimals_for, calib::exponent_of;

constexpr std::string_view unknown = "–";

// A true minus sign, as wide as a plus.
std::string with_minus(const std::string& text) {
  return text.starts_with('-') ? fmt::format("−{}", text.substr(1)) : text;
}

// No minus before what is rounded to zero.
std::string fixed(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos ? fmt::format("{:.{}f}", 0.0, decimals)
                                                            : with_minus(text);
}

// Of "-0.23" in plain digits: "⁻⁰·²³".
std::string superscript(std::string_view exponent) {
  constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴",
                                                    "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : exponent)
    text += c == '-' ? "⁻" : c == '.' ? "·" : digits.at(static_cast<std::size_t>(c - '0'));
  return text;
}

// "1e-08" becomes 10⁻⁸: a factor of 1 is left out.
std::string power_of_ten(const std::string& mantissa, int exponent) {
  const std::string factor =
      mantissa == "1" ? "" : fmt::format("{}\u00a0×\u00a0", with_minus(mantissa));
  return fmt::format("{}10{}", factor, superscript(std::to_string(exponent)));
}

// Every match as `written` has it.
std::string replaced(const std::string& sentence, const std::regex& pattern,
                     std::string (*written)(const std::smatch&)) {
  std::string text;
  std::size_t done = 0;
  for (std::sregex_iterator found(sentence.begin(), sentence.end(), pattern), none; found != none;
       ++found) {
    const auto at = static_cast<std::size_t>(found->position());
    text += sentence.substr(done, at - done) + written(*found);
    done = at + static_cast<std::size_t>(found->length());
  }
  return text + sentence.substr(done);
}

// Whether a value can be shown to two digits of the width without powers of ten.
bool shows_plainly(double value, double width) {
  return std::abs(value) < 1e6 && decimals_for(width) <= 7;
}

}  // namespace

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return std::string(unknown);
  if (value == 0.0) return "0";
  const int exponent = exponent_of(value, digits);
  if (exponent >= -4 && exponent < 6) return fixed(value, std::max(0, digits - 1 - exponent));
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  return power_of_ten(text.substr(0, text.find('e')), exponent);
}

double without_rounding(double value) {
  return std::abs(value) <= 1e-12 ? 0.0 : value;
}

std::string setting(double value, std::string_view unit, int digits) {
  if (!std::isfinite(value)) return std::string(unknown);
  const std::string text = typeset(fmt::format("{:.{}g}", value, digits));
  return unit.empty() ? text : fmt::format("{}\u00a0{}", text, unit);
}

std::string typeset(const std::string& sentence) {
  static const std::regex power(R"((-?\b\d+(?:\.\d+)?)e([+-]\d{1,3})\b)"),
      exponent(R"(\^(-?\d+(?:\.\d+)?))"), minus(R"((^|[\s(\[=])-(?=\d))"), degree(R"((\d) deg\b)");
  static const std::regex unit(R"((\d) (?=(%|1/s|[kMG]?Pa|(µ|[mnp])?[ms]|k?N|k?J|kg)(?!\w)))"),
      error(R"(± (?=\d))");
  // The order matters. Units are found by plain digits before them: their spaces come first. Powers
  // of ten come before exponents and minus signs, which would change parts of them.
  const std::string held =
      std::regex_replace(std::regex_replace(sentence, unit, "$1\u00a0"), error, "±\u00a0");
  std::string text = replaced(held, power, [](const std::smatch& found) {
    return power_of_ten(found.str(1), std::stoi(found.str(2)));
  });
  text =
      replaced(text, exponent, [](const std::smatch& found) { return superscript(found.str(1)); });
  return std::regex_replace(std::regex_replace(text, minus, "$1−"), degree, "$1°");
}

std::string quantity(double value, std::string_view unit, int digits) {
  // The dash for an unknown number has no unit.
  if (!std::isfinite(value) || unit.empty()) return number(value, digits);
  return fmt::format("{}\u00a0{}", number(value, digits), unit);
}

std::string plus_minus(double value, double error) {
  if (!std::isfinite(value) || !std::isfinite(error) || error <= 1e-9 * std::abs(value))
    return number(value);  // not known, or no more than rounding
  if (!shows_plainly(value, error))
    return fmt::format("{}\u00a0±\u00a0{}", number(value), number(error, 2));
  const int decimals = decimals_for(error);
  return fmt::format("{}\u00a0±\u00a0{}", fixed(value, decimals), fixed(error, decimals));
}

std::string interval(double low, double high, int more) {
  if (!std::isfinite(low) || !std::isfinite(high)) return std::string(unknown);
  const double width = high - low;
  if (width <= 0.0 || !shows_plainly(std::max(std::abs(low), std::abs(high)), width))
    return fmt::format("{} to {}", number(low), number(high));
  const int decimals = decimals_for(width) + more;
  return fmt::format("{} to {}", fixed(low, decimals), fixed(high, decimals));
}

std::string with_interval(double value, double low, double high, std::string_view unit, int more) {
  // The value has as many decimals as its interval, so that the three numbers compare easily.
  const double width = high - low, most = std::max(std::abs(low), std::abs(high));
  const bool plainly = std::isfinite(value) && std::isfinite(width) && width > 0.0 &&
                       shows_plainly(std::max(std::abs(value), most), width);
  const std::string shown = plainly ? fixed(value, decimals_for(width) + more) : number(value, 3);
  const std::string space = unit.empty() ? "" : "\u00a0";
  if (!std::isfinite(value)) return std::string(unknown);
  return fmt::format("{}{}{} ({})", shown, space, unit,
                     std::isfinite(width) ? interval(low, high, more) : "interval not known");
}

std::string chance(double p) {
  if (std::isnan(p)) return "–";
  return p < 1e-6 ? "p < 10⁻⁶" : fmt::format("p = {}", number(p, 2));
}

Prefix prefix_for(double magnitude) {
  constexpr std::array<Prefix, 7> prefixes{Prefix{1e6, "M"},  Prefix{1e3, "k"},  Prefix{1.0, ""},
                                           Prefix{1e-3, "m"}, Prefix{1e-6, "µ"}, Prefix{1e-9, "n"},
                                           Prefix{1e-12, "p"}};
  for (const Prefix& prefix : prefixes)
    if (std::abs(magnitude) >= prefix.factor) return prefix;
  return {};
}

std::string prefixed(double value, std::string_view unit, int digits) {
  const Prefix prefix = prefix_for(value);
  return quantity(value / prefix.factor, fmt::format("{}{}", prefix.symbol, unit), digits);
}

double round_down(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double step : {5.0, 2.0})
    if (step * power <= limit) return step * power;
  return power;
}

std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    const bool special = c == '"' || c == '`' || c == '\\';
    if (c == '\'')
      result += "’";
    else
      result += control ? ' ' : special ? '_' : c;
  }
  return result;
}

}  // namespace havers::reports
