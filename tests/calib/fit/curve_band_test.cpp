#include "calib/fit/curve_band.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

Response straight(double stiffness, double failure_strain) {
  Response response;
  response.failed = false;
  response.broke = true;
  response.failure_strain = failure_strain;
  response.strain = {0.0, failure_strain, failure_strain};
  response.stress = {0.0, stiffness * failure_strain, 0.0};
  return response;
}

// Of three, the quantiles of 2.5 and 97.5 % are a twentieth of the way from the outer to the inner.
TEST(CurveBand, IsTheQuantilesOfTheReplicatesAndTheirDistanceFromTheTest) {
  const std::vector<Response> replicates{straight(9e9, 0.01), straight(12e9, 0.01),
                                         straight(10e9, 0.01), Response{}};
  const auto band = band_of(replicates, test::straight_test(8e9, 40e6));
  ASSERT_EQ(band.strain.size(), 121U);
  ASSERT_EQ(band.strain.back(), 0.01);
  for (std::size_t i = 1; i + 1 < band.strain.size(); ++i) {
    const double strain = band.strain[i];
    EXPECT_NEAR(band.median[i], 10e9 * strain, 1.0);
    EXPECT_NEAR(band.lower[i], 9.05e9 * strain, 1.0);
    EXPECT_NEAR(band.upper[i], 11.9e9 * strain, 1.0);
    if (strain > 0.005 * (1.0 + 1e-12)) {  // the test's end
      EXPECT_TRUE(std::isnan(band.measured[i]) && std::isnan(band.residual[i])) << strain;
    } else {
      EXPECT_NEAR(band.measured[i], 8e9 * strain, 1.0);
      EXPECT_NEAR(band.residual[i], 2e9 * strain, 1.0);
    }
  }
}

TEST(CurveBand, CountsABrokenReplicateAsCarryingNothing) {
  const std::vector<Response> replicates{straight(10e9, 0.002), straight(10e9, 0.002),
                                         straight(10e9, 0.01)};
  const auto band = band_of(replicates, {});
  const std::size_t middle = band.strain.size() / 2;
  EXPECT_EQ(band.median[middle], 0.0);
  EXPECT_NEAR(band.upper[middle], 0.95 * 10e9 * 0.005, 1.0);  // of 0, 0 and what is left
}

}  // namespace
}  // namespace havers::calib
