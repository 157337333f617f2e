#include "io/input_error.hpp"

#include <utility>

namespace havers::io {

std::string at_line(const std::string& file, std::size_t line) {
  return file + ":" + std::to_string(line);
}

std::string to_string(const Problem& problem) {
  std::string text = problem.where + ": " + problem.what;
  if (!problem.hint.empty()) text += " (" + problem.hint + ")";
  return text;
}

InputError::InputError(std::vector<Problem> problems) : problems_(std::move(problems)) {
  for (const Problem& problem : problems_) text_ += to_string(problem) + "\n";
  if (!text_.empty()) text_.pop_back();
}

InputError::InputError(std::string where, std::string what, std::string hint)
    : InputError(std::vector<Problem>{{std::move(where), std::move(what), std::move(hint)}}) {}

}  // namespace havers::io
