// The profile of the cost along each unknown, and the interval it gives.
#pragma once

#include <vector>

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// The cost along each active unknown, the others refitted (F15), all unknowns in one batch. In the
/// order of the active unknowns; at most eight points of each, evaluated twice.
/// Precondition: !answer.slopes.failed.
std::vector<Profile> profiles_of(Trail& trail, const Answer& answer);

}  // namespace havers::calib
