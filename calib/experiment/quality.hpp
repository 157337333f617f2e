// Whether the numbers of a test mean enough to calibrate with, and can be those of bone.
#pragma once

#include <string>
#include <vector>

#include "calib/experiment/measured_test.hpp"

namespace havers::calib {

/// Why a reduced test is rejected, a sentence each; empty when it is accepted (X16).
std::vector<std::string> rejections(const MeasuredTest& test, const ReductionOptions& options);

/// What a strength or modulus that no compact bone has says of the units of its columns; empty
/// where bone may have it (X22). `raw` tells what they come from.
std::string doubt_of_units(const RawTest& raw, const MeasuredTest& test);

}  // namespace havers::calib
