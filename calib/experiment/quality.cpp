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
    reasons.push_back(
        fmt::format("rejected: the noise of the stress is {:.3g} % of the strength, more than "
                    "{:.3g} %",
                    100.0 * noise, 100.0 * options.largest_noise));
  if (test.failure_strain <= 0.0)
    reasons.push_back(fmt::format("rejected: the failure strain is {:.4g} %, which is no stretch",
                                  100.0 * test.failure_strain));
  return reasons;
}

}  // namespace havers::calib
