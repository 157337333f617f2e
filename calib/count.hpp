// Numbers with their nouns, for sentences in corrections, warnings and pages; used in all folders
// above sim.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace havers::calib {

/// "1 row", "2 rows", "0 rows"; `n` is of any integer type, `noun` one whose plural takes an s.
std::string count(std::integral auto n, std::string_view noun) {
  return std::to_string(n) + " " + std::string(noun) + (n == 1 ? "" : "s");
}

}  // namespace havers::calib
