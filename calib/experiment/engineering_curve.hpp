// Raw channels to engineering stress and strain.
#pragma once

#include <string>
#include <vector>

#include "calib/experiment/raw_test.hpp"

namespace havers::calib {

/// Stress against strain before any correction, or why there is none.
struct EngineeringCurve {
  std::vector<double> strain;      ///< [-]
  std::vector<double> stress;      ///< [Pa]
  double area = 0.0;               ///< 0 where unknown. [m²]
  bool of_crosshead = false;       ///< The strain is the crosshead's (X2).
  bool machine_in_strain = false;  ///< The crosshead's, nothing taken off for the machine.
  std::vector<Correction> corrections;
  std::vector<std::string> warnings;
  std::vector<std::string> problems;
};

/// Force and stress of a machine that writes tension negative, turned, with a warning: where they
/// are negative while strain, or else the crosshead, says that the specimen gets longer (X22).
/// Or another record does: `stretched`.
void turn_negative_load(RawTest& raw, bool stretched = false);

/// (X1) stress from force and area, else the machine's; (X2) strain from the gauge, else from the
/// crosshead less what the machine gives way (`machine_compliance` [m/N]).
EngineeringCurve engineering_curve(const RawTest& raw, double machine_compliance = 0.0);

}  // namespace havers::calib
