// Where a result comes from and what it took.
#pragma once

#include <limits>
#include <map>
#include <string>

namespace havers::calib {

/// Of one run of a command: cli fills it, the files and pages of the result carry it.
struct Provenance {
  std::string havers;                                              ///< Its version, "0.1.0".
  std::string compiler;                                            ///< What built it, "GNU 12.2.0".
  std::string command;                                             ///< As typed.
  std::map<std::string, std::string> inputs;                       ///< File name to SHA-256.
  double wall_seconds = std::numeric_limits<double>::quiet_NaN();  ///< NaN where not recorded.
  double cpu_seconds = std::numeric_limits<double>::quiet_NaN();   ///< NaN where not recorded.
};

}  // namespace havers::calib
