#include "cli/number_check.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

namespace havers::cli {
namespace {

// CLI11's own checks take NaN, and what is no number for one.
template <class Number, class Rule>
CLI::Validator number_check(const std::string& words, Rule holds) {
  const auto complaint = [words, holds](const std::string& text) -> std::string {
    Number value{};
    const bool good = CLI::detail::lexical_cast(text, value) && holds(value);
    return good ? "" : fmt::format("is {}, must be {}", text, words);
  };
  return {complaint, ""};  // the help names no type twice
}

}  // namespace

CLI::Validator above_zero() {
  return number_check<double>("a number above 0",
                              [](double value) { return std::isfinite(value) && value > 0.0; });
}

CLI::Validator not_negative() {
  return number_check<double>("a number, 0 or more",
                              [](double value) { return std::isfinite(value) && value >= 0.0; });
}

CLI::Validator count(int most) {
  return number_check<int>(fmt::format("a whole number from 1 to {}", most),
                           [most](int value) { return value >= 1 && value <= most; });
}

CLI::Validator seed_number() {
  const auto complaint = [](const std::string& text) -> std::string {
    std::int64_t value = 0;  // as far as a study's and a scene's seed go, in TOML
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    const bool good = read.ec == std::errc{} && read.ptr == end && value >= 0;
    return good ? "" : fmt::format("is {}, must be a whole number from 0 to 2^63 - 1", text);
  };
  return {complaint, ""};  // the help names no type twice
}

}  // namespace havers::cli
