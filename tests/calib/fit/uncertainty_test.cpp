// Errors and intervals of an answer that is a mean, for which textbooks have closed forms.
#include "calib/fit/uncertainty.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "calib/fit/calibrate.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// Where tests are known alike, (F9) makes the variance of each what they show of it: the mean's
// standard error is S/√n, and its interval Student's. His 97.5 % quantiles are those of the tables.
TEST(Uncertainty, OfAMeanIsThatOfATextbook) {
  for (const auto& [pairs, student] :
       {std::pair(1U, 12.7062), std::pair(2U, 3.18245), std::pair(5U, 2.26216)}) {
    const Study study = test::modulus_study(pairs);
    const auto parameter = test::parameter_of(test::fit(study), "young_GPa");
    const double error = test::deviation_of_moduli(study) / std::sqrt(2.0 * pairs);
    EXPECT_NEAR(parameter.standard_error / parameter.value / error, 1.0, 1e-3) << pairs;
    for (const auto& interval : {parameter.slopes_95, parameter.profile_95})
      for (const double end : interval)
        EXPECT_NEAR(std::abs(std::log(end / parameter.value)) / (student * error), 1.0, 1e-3)
            << pairs;
  }
}

}  // namespace
}  // namespace havers::calib
