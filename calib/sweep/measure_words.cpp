#include "calib/sweep/measure_words.hpp"

namespace havers::calib {

MeasureWords words_of(Measure measure) {
  constexpr double percent = 0.01, MPa = 1e6, GPa = 1e9;
  switch (measure) {
    case Measure::strength:
      return {"Strength", "MPa", MPa};
    case Measure::failure_strain:
      return {"Failure strain", "%", percent};
    case Measure::modulus:
      return {"Modulus", "GPa", GPa};
    case Measure::linear_part:
      return {"Linear part of the curve", "%", percent};
    case Measure::fall_part:  // no share: a wall may take longer to part than to fail
      return {"Strain from strength to end / failure strain", ""};
    case Measure::head_tail_broken:
      return {"Broken head-tail joints", ""};
    case Measure::flank_broken:
      return {"Broken flank joints", ""};
    case Measure::crack_span:
      return {"Height of the crack / H", "%", percent};
    case Measure::crack_linked:
      return {"Head-tail joints continued by a flank", "%", percent};
  }
  return {};
}

}  // namespace havers::calib
