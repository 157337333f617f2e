// A test reduced to engineering stress and strain and the quantities a model is compared with.
#pragma once

#include <string>
#include <vector>

#include "calib/experiment/raw_test.hpp"

namespace havers::calib {

/// How a raw test is reduced. Equations (X1)... in calib/experiment/README.md. Every correction has
/// a switch.
struct ReductionOptions {
  double window_low = 0.1;     ///< Modulus window, lower end, part of the strength. [-]
  double window_high = 0.4;    ///< Modulus window, upper end, part of the strength. [-]
  double straightness = 0.03;  ///< Slopes of the window's halves may differ by this part (X5). [-]
  bool remove_toe = true;  ///< Shift the strain so that the modulus line passes through the origin.
  bool cut_after_break = true;  ///< Drop the rows after the specimen has parted.
  double break_part =
      0.5;  ///< Stress after the maximum that counts as parted, part of the strength. [-]
  bool remove_spikes = true;  ///< Replace single rows that stand out of force or strain (X11).
  bool spread_repeated_times = true;  ///< Give rows that share a time times of their own (X12).
  bool mend_slips = true;  ///< Take back the jumps of a slipping extensometer (X13), (X14).
  double machine_compliance = 0.0;     ///< Taken off the crosshead where there is no gauge. [m/N]
  bool quality_control = true;         ///< Reject a test whose numbers mean little (X16).
  double largest_modulus_error = 0.2;  ///< Standard error, part of the modulus (X16). [-]
  double largest_noise = 0.05;         ///< Of the stress, part of the strength (X16). [-]
};

/// Stress against strain, corrected, and what follows from it. Engineering stress throughout.
struct MeasuredTest {
  std::vector<double> strain;  ///< [-]
  std::vector<double> stress;  ///< [Pa]
  std::vector<double> time;    ///< Empty where not recorded. [s]

  double area = 0.0;                    ///< [m²]
  double modulus = 0.0;                 ///< Robust slope in the window. [Pa]
  double modulus_standard_error = 0.0;  ///< [Pa]
  double window_low = 0.0,
         window_high = 0.0;              ///< Strains between which the modulus was fitted. [-]
  double max_force = 0.0;                ///< [N]
  double strength = 0.0;                 ///< Largest stress. [Pa]
  double strength_standard_error = 0.0;  ///< The noise of the stress (X7). [Pa]
  double failure_strain = 0.0;           ///< Corrected strain at the strength. [-]
  bool load_turned =
      false;  ///< The load was recorded negative, as a machine may count tension (X22).
  bool of_crosshead = false;  ///< The strain is the crosshead's, not a gauge's (X2).
  bool machine_in_strain =
      false;                 ///< Strain of the crosshead, nothing taken off for the machine (X2).
  bool broke = true;         ///< false: it was stopped or unloaded; both are lower bounds (X20).
  double strain_rate = 0.0;  ///< Median over the loading; 0 where time was not recorded. [1/s]
  double energy_to_failure = 0.0;  ///< ∫ σ dε up to the strength (X15). [J/m³]
  double linearity = 1.0;  ///< Strength / (modulus · failure strain): 1 when linear to failure. [-]
  std::vector<Correction> corrections;
  std::vector<std::string> warnings;  ///< A sentence each.
  std::string unit_doubt;  ///< The warning whose numbers no compact bone has (X22); else empty.
};

/// Reduces a test. A test that cannot be reduced (no rows, no strain, no area) says why in
/// `problems` and leaves the numbers but the area at zero; one that quality control rejects says
/// why and keeps them.
struct Reduction {
  MeasuredTest test;
  std::vector<std::string> problems;
};
Reduction reduce_test(const RawTest& recorded, const ReductionOptions& options = {});

}  // namespace havers::calib
