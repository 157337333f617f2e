#include "reports/sweep/measure_words.hpp"

#include "reports/text/format.hpp"

namespace havers::reports {

MeasureWords words_of(calib::Measure measure) {
  switch (measure) {
    case calib::Measure::strength:
      return {"Strength", "MPa", in::MPa};
    case calib::Measure::failure_strain:
      return {"Failure strain", "%", in::percent};
    case calib::Measure::modulus:
      return {"Modulus", "GPa", in::GPa};
    case calib::Measure::linear_part:
      return {"Linear part of the curve", "%", in::percent};
    case calib::Measure::fall_part:
      return {"Strain from strength to end / failure strain", "%", in::percent};
    case calib::Measure::head_tail_broken:
      return {"Broken head-tail joints", "", 1.0};
    case calib::Measure::flank_broken:
      return {"Broken flank joints", "", 1.0};
    case calib::Measure::crack_span:
      return {"Height of the crack / H", "%", in::percent};
    case calib::Measure::crack_linked:
      return {"Head-tail joints continued by a flank", "%", in::percent};
  }
  return {};
}

}  // namespace havers::reports
