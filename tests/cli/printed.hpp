// Numbers in what the program prints, to be compared with those of its JSON.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace havers::test {

/// The first line that has the words in it; the test fails where there is none.
inline std::string line_with(const std::string& text, const std::string& words) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find(words) != std::string::npos) return line;
  ADD_FAILURE() << "no line has \"" << words << "\" in\n" << text;
  return "";
}

/// A line's words with single spaces, and # for each number; and these as they are written.
struct Printed {
  std::string words{};
  std::vector<std::string> numbers{};
};

inline Printed printed(const std::string& line) {
  Printed result;
  std::istringstream in(line);
  for (std::string word; in >> word;) {
    const std::size_t end = word.find_last_not_of(",:;)") + 1;
    const std::string bare = word.substr(0, end);
    char* rest = nullptr;
    std::strtod(bare.c_str(), &rest);
    const bool is_number = !bare.empty() && *rest == '\0';
    if (is_number) result.numbers.push_back(bare);
    result.words += (result.words.empty() ? "" : " ") + (is_number ? "#" + word.substr(end) : word);
  }
  return result;
}

/// Half a unit of the last digit of a number as it is written, and a little for binary rounding.
inline double half_a_digit(const std::string& number) {
  const std::size_t e = std::min(number.find('e'), number.size());
  const std::size_t point = number.find('.');
  const int decimals = point < e ? static_cast<int>(e - point) - 1 : 0;
  const int exponent = e < number.size() ? std::stoi(number.substr(e + 1)) : 0;
  return 0.50001 * std::pow(10.0, exponent - decimals);
}

/// The numbers of a line are those expected, as far as their digits tell.
inline void expect_numbers(const std::string& line, const std::vector<double>& expected) {
  SCOPED_TRACE(line);
  const std::vector<std::string> numbers = printed(line).numbers;
  ASSERT_EQ(numbers.size(), expected.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_NEAR(std::stod(numbers[i]), expected[i], half_a_digit(numbers[i]));
}

}  // namespace havers::test
