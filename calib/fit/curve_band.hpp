// Replicates and measured curve of one specimen on one strain grid.
#pragma once

#include <span>

#include "calib/fit/calibration.hpp"

namespace havers::calib {

/// The band of the replicates, up to the largest failure strain of any curve. Beyond its end a
/// replicate that broke counts as no stress, one that did not is left out; NaN where none is left.
CurveBand band_of(std::span<const Response> replicates, const MeasuredTest& measured);

}  // namespace havers::calib
