// An extensometer that slips on the specimen, falls off it, or reaches its end.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "calib/experiment/raw_test.hpp"

namespace havers::calib {

/// What was done about it.
struct SlipRepair {
  std::vector<Correction> corrections;
  std::vector<std::string> warnings;
  int slips = 0;        ///< How many jumps were taken back.
  std::string problem;  ///< Not empty: the gauge was lost and nothing tells the strain after it.
};

/// Takes back the jumps of the strain (X13) up to the largest stress; after a gauge that fell off
/// or stands still, the strain goes on with the crosshead (X14). `extension` is empty where it was
/// not recorded. Strain [-], stress [Pa], extension [m].
SlipRepair mend_slips(std::vector<double>& strain, std::span<const double> stress,
                      std::span<const double> extension);

}  // namespace havers::calib
