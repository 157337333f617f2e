// Whether the numbers of a test mean enough to calibrate with.
#pragma once

#include <string>
#include <vector>

#include "calib/experiment/measured_test.hpp"

namespace havers::calib {

/// Why a reduced test is rejected, a sentence each; empty when it is accepted (X16).
std::vector<std::string> rejections(const MeasuredTest& test, const ReductionOptions& options);

}  // namespace havers::calib
