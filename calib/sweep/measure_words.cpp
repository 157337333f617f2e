#include "calib/sweep/measure_words.hpp"

#include <array>

namespace havers::calib {

MeasureWords words_of(Measure measure) {
  constexpr double percent = 0.01, MPa = 1e6, GPa = 1e9;
  // In the order of `Measure`.
  const std::array<MeasureWords, measure_count> words{{
      {"Strength", "MPa", MPa},
      {"Failure strain", "%", percent},
      {"Modulus", "GPa", GPa},
      {"Linear part of the curve", "%", percent},
      // no share: a wall may take longer to part than to fail
      {"Strain from strength to end / failure strain", ""},
      {"Broken head-tail joints", ""},
      {"Broken flank joints", ""},
      {"Height of the crack / H", "%", percent},
      {"Head-tail joints continued by a flank", "%", percent},
  }};
  return words.at(static_cast<std::size_t>(measure));
}

}  // namespace havers::calib
