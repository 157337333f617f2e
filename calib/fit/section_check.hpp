// Whether the sections tell what the model takes from them.
#pragma once

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// What the model takes from porosity is told of every specimen, by sections beyond doubt (F27).
Check check_sections(const FitProblem& problem);

}  // namespace havers::calib
