// Measures as a reader knows them: in sentences, tables and figures.
#pragma once

#include <string>

#include "calib/sweep/measure.hpp"

namespace havers::calib {

/// A number in SI units is shown as number / scale, with the unit behind it.
struct MeasureWords {
  std::string name, unit;
  double scale = 1.0;  ///< SI value over the shown one.
};
/// The unit is empty where the number is shown as it is.
MeasureWords words_of(Measure measure);

}  // namespace havers::calib
