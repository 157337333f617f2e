// Measures as a reader knows them, also of a build without pages.
#pragma once

#include <string>

#include "calib/sweep/measure.hpp"

namespace havers::reports {

/// A measure as tables and axes show it.
struct MeasureWords {
  std::string name, unit;
  double scale = 1.0;  ///< SI value over the shown one.
};
MeasureWords words_of(calib::Measure measure);

}  // namespace havers::reports
