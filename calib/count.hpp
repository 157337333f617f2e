// Numbers with their nouns, in the sentences of all rooms above the model.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace havers::calib {

/// "1 row", "2 rows"; `noun` takes an s.
std::string count(std::integral auto n, std::string_view noun) {
  return std::to_string(n) + " " + std::string(noun) + (n == 1 ? "" : "s");
}

}  // namespace havers::calib
