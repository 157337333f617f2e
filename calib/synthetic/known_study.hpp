// Studies of known truth: the model's own tests, with the noise of a laboratory.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "calib/study/study.hpp"

namespace havers::calib {

/// What known studies calibrate.
using KnownParameters = std::array<const char*, 3>;
inline constexpr KnownParameters known_parameters{"young_GPa", "head_tail_MPa", "ratio"};

/// What is tested, what is unknown, and how unlike the specimens are.
struct Design {
  std::string name;             ///< "0, 45, 90 deg".
  std::vector<double> degrees;  ///< Orientation of each specimen. [°]
  /// Standard deviation between specimens of log modulus and of log strength, beyond what the model
  /// itself scatters. [-]
  double specimen_effect = 0.0;
  KnownParameters parameters = known_parameters;
};

/// Two specimens each at 0°, 45° and 90°, all of one bone.
Design three_orientations();

/// The same with scatter unknown instead of threshold: two unknowns that cost simulations.
Design unknown_scatter();

/// A study, and the answer that its fit should have.
struct KnownStudy {
  Study study;
  KnownParameters parameters;
  std::array<double, 3> truth{};  ///< Of `parameters`, in their units.
};

/// A study on walls of 8 layers of 6 fibres. Truth, tests and noise are drawn by `number` alone.
KnownStudy known_study(const Design& design, int number);

/// The same with a truth that is given.
KnownStudy known_study(const Design& design, int number, const std::array<double, 3>& truth);

/// Part of n studies that did what they should, with Wilson's 95 % interval. [-]
struct Rate {
  double part = 0.0;
  std::array<double, 2> interval_95{};
};
/// For n = 0 the part is NaN and the interval [0, 1].
Rate rate_of(int successes, int n);

/// Median, and 10 and 90 % beside it: {10 %, 50 %, 90 %}. Precondition: not empty.
std::array<double, 3> quantiles_of(std::vector<double> values);

}  // namespace havers::calib
