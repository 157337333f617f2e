// What a measured test asks of the model.
#pragma once

#include "calib/experiment/measured_test.hpp"
#include "calib/fit/prediction.hpp"

namespace havers::calib {

/// Landmarks of a measured test with their noise.
struct Target {
  bool usable = false;  ///< The reduction gave modulus, strength and failure strain.
  Landmarks value = Landmarks::Zero();
  Landmarks noise =
      Landmarks::Zero();  ///< Standard deviation of `value` from the machine alone (F5). [-]
};

/// The test's landmarks. A specimen that parts between two rows was stronger than its last row, by
/// half a row on average: this is added, and its uncertainty is part of the noise (F5).
Target target_of(const MeasuredTest& test);

}  // namespace havers::calib
