// What a measured test asks of the model.
#pragma once

#include <string>
#include <vector>

#include "calib/fit/landmarks.hpp"
#include "calib/study/study.hpp"

namespace havers::calib {

/// Landmarks of a measured test with their noise.
struct Target {
  bool usable = false;  ///< The reduction gave modulus, strength and failure strain.
  Landmarks value = Landmarks::Zero();
  Landmarks noise =
      Landmarks::Zero();  ///< Standard deviation of `value` from the machine alone (F5). [-]
  bool censored = false;  ///< The test was stopped unbroken: the strength is a lower bound.
  Eigen::Array<bool, landmark_count, 1> present;  ///< The landmarks that count.
};

/// The test's landmarks, those of `terms`. A specimen that parts between two rows was stronger than
/// its last row, by half a row on average: this is added, and its uncertainty is part of the noise
/// (F5).
Target target_of(const Specimen& specimen, const std::vector<std::string>& terms);

}  // namespace havers::calib
