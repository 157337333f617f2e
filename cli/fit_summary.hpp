// A fit in a few lines on stdout: the verdict before the numbers.
#pragma once

#include "calib/fit/calibration.hpp"

namespace havers::cli {

/// `wall_seconds` stands beside the cost it bought [s]; `verbose`: what was left out, too.
void print_fit_summary(const calib::CalibrationResult& result, double wall_seconds, bool verbose);

}  // namespace havers::cli
