// A calibration with any simulator: what tests with closed forms, and other models, use.
#pragma once

#include "calib/fit/calibration.hpp"
#include "calib/fit/simulation_batch.hpp"

namespace havers::calib {

/// As calibrate(), with the simulator given. Its answers must depend on the scene alone, as equal
/// scenes in normal form are one simulation (F3). An exception that the simulator throws counts as
/// a failed simulation; one that the store throws goes on to the caller.
CalibrationResult calibrate_with(const Simulator& simulator, const Study& study,
                                 EvaluationStore* store = nullptr,
                                 const CalibrationObserver& observer = {});

}  // namespace havers::calib
