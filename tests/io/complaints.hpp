// What a reader says of a faulty file, with the folder taken out of the sentences.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/input_error.hpp"
#include "tests/support/scratch_folder.hpp"

namespace havers::test {

/// What the InputError that `call` throws says; "none" where it throws none.
inline std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "none";
}

/// The first problem of the InputError that `call` throws.
inline io::Problem first_problem_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const io::InputError& error) {
    return error.problems().front();
  }
  return {.where = "none", .what = "none", .hint = "none"};
}

/// The sentences of the InputError that `read` throws; empty when it throws none.
inline std::vector<std::string> complaints_of(const ScratchFolder& folder,
                                              const std::function<void()>& read) {
  std::vector<std::string> sentences;
  try {
    read();
  } catch (const io::InputError& error) {
    const std::string prefix = folder.path().string() + "/";
    for (const io::Problem& problem : error.problems()) {
      std::string sentence = to_string(problem);
      for (std::size_t at = sentence.find(prefix); at != sentence.npos; at = sentence.find(prefix))
        sentence.erase(at, prefix.size());
      sentences.push_back(sentence);
    }
  }
  return sentences;
}

}  // namespace havers::test
