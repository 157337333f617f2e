#include "io/input_error.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace havers::io {

std::string at_line(const std::string& file, std::size_t line) {
  return file + ":" + std::to_string(line);
}

std::string to_string(const Problem& problem) {
  std::string text = problem.where + ": " + problem.what;
  if (!problem.hint.empty()) text += " (" + problem.hint + ")";
  // A file's name or a cell may hold a line end or an escape sequence for the terminal.
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return text;
}

InputError::InputError(std::vector<Problem> problems) {
  std::set<std::string> told;
  for (Problem& problem : problems) {
    // Two problems are the same where their sentences are; the order stays that in which they were
    // found.
    const std::string sentence = to_string(problem);
    if (!told.insert(sentence).second) continue;
    text_ += (text_.empty() ? "" : "\n") + sentence;
    problems_.push_back(std::move(problem));
  }
}

InputError::InputError(std::string where, std::string what, std::string hint)
    : InputError(std::vector<Problem>{{std::move(where), std::move(what), std::move(hint)}}) {}

}  // namespace havers::io
