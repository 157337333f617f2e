#include "calib/experiment/quality.hpp"

#include <fmt/format.h>

namespace havers::calib {

// (X16)
std::vector<std::string> rejections(const MeasuredTest& test, const ReductionOptions& options) {
  std::vector<std::string> reasons;
  const double modulus_error = test.modulus_standard_error / test.modulus;
  if (modulus_error > options.largest_modulus_error)
    reasons.push_back(fmt::format(
        "rejected: the standard error of the modulus is {:.3g} % of it, more than {:.3g} %",
        100.0 * modulus_error, 100.0 * options.largest_modulus_error));
  const double noise = test.strength_standard_error / test.strength;
  if (noise > options.largest_noise)
    reasons.push_back(fmt::format(
        "rejected: the noise of the stress is {:.3g} % of the strength, more than {:.3g} %",
        100.0 * noise, 100.0 * options.largest_noise));
  if (test.failure_strain <= 0.0)
    reasons.push_back(fmt::format("rejected: the failure strain is {:.4g} %, which is no stretch",
                                  100.0 * test.failure_strain));
  return reasons;
}

// (X22) A factor of 1000 takes every strength of the one range out of it, a factor of 100 every
// modulus of the other. A crosshead's modulus holds the machine, which may be ten times as soft.
// Where the strength is wrong, so is the modulus, whatever the strain.
std::string doubt_of_units(const RawTest& raw, const MeasuredTest& test) {
  constexpr double lowest_strength = 1e6, highest_strength = 1e9, lowest_modulus = 1e9,
                   highest_modulus = 1e11, softest_machine = 0.1;
  const bool from_force = !raw.force.empty() && test.area > 0.0;
  if (test.strength < lowest_strength || test.strength > highest_strength)
    return fmt::format(
        "a strength of {:.5g} MPa is not that of compact bone ({:g} to {:g} MPa): check the units "
        "({})",
        test.strength * 1e-6, lowest_strength * 1e-6, highest_strength * 1e-6,
        from_force ? "force_unit, width_mm, thickness_mm" : "stress_unit");
  const double lowest = test.of_crosshead ? softest_machine * lowest_modulus : lowest_modulus;
  if (test.modulus >= lowest && test.modulus <= highest_modulus) return {};
  return fmt::format(
      "a modulus of {:.5g} GPa with a failure strain of {:.3g} % is not that of compact bone "
      "({:g} to {:g} GPa): check the units ({})",
      test.modulus * 1e-9, 100.0 * test.failure_strain, lowest * 1e-9, highest_modulus * 1e-9,
      raw.strain.empty() ? "extension_unit, gauge_length_mm" : "strain_unit");
}

}  // namespace havers::calib
