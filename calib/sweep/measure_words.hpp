// Measures as a reader knows them: in sentences, tables and figures.
#pragma once

#include <string>

#include "calib/sweep/measure.hpp"

namespace havers::calib {

struct MeasureWords {
  std::string name, unit;
  double scale = 1.0;  ///< SI value over the shown one.
};
MeasureWords words_of(Measure measure);

}  // namespace havers::calib
