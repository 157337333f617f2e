// The one exception of havers: what is wrong with the user's input.
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

namespace havers::io {

/// One complaint. `where` is a file, a file and line, or a file and key; `hint` says what to do,
/// may be empty.
struct Problem {
  std::string where, what, hint;
};

/// "file:line", for a problem's `where`.
std::string at_line(const std::string& file, std::size_t line);

/// "where: what (hint)", in one line: control characters become blanks.
std::string to_string(const Problem& problem);

/// All problems of an input together, each once, for one mistake may stand in the way of many keys
/// and files; caught once, in main, exit code 2.
class InputError : public std::exception {
 public:
  explicit InputError(std::vector<Problem> problems);
  /// A single problem.
  InputError(std::string where, std::string what, std::string hint = {});
  /// A line for each problem.
  [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
  std::string text_;
};

/// Goes on collecting after an input that was refused.
inline void collect(std::vector<Problem>& all, const std::vector<Problem>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace havers::io
