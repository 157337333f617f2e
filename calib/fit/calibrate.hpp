// A calibration with any simulator: what tests with closed forms, and other models, use.
#pragma once

#include "calib/fit/calibration.hpp"
#include "calib/fit/simulation_batch.hpp"

namespace havers::calib {

/// As calibrate(), with the simulator given.
CalibrationResult calibrate_with(const Simulator& simulator, const Study& study,
                                 EvaluationStore* store = nullptr,
                                 const CalibrationObserver& observer = {});

}  // namespace havers::calib
