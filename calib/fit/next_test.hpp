// Which further test would tell most.
#pragma once

#include <vector>

#include "calib/fit/answer.hpp"

namespace havers::calib {

/// What one more specimen at 0°, 45° and 90°, one ten times as fast as that nearest to 0°, and one
/// more section of every specimen, would make of the errors (F18). Orientations that the study does
/// not have, and the faster one, are simulated where every parameter is shared. Precondition:
/// !answer.slopes.failed.
std::vector<NextTest> next_tests(SimulationBatch& batch, const FitProblem& problem,
                                 const Answer& answer);

}  // namespace havers::calib
