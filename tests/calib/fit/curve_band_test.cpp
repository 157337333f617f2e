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

TEST(CurveBand, IsTheMedianOfTheReplicatesAndTheirDistanceFromTheTest) {
  const std::vector<Response> replicates{straight(9e9, 0.01), straight(10e9, 0.01),
                                         straight(12e9, 0.01), Response{}};
  const auto band = band_of(replicates, test::straight_test(10e9, 50e6));
  ASSERT_EQ(band.strain.back(), 0.01);
  for (std::size_t i = 1; i + 1 < band.strain.size(); ++i) {
    EXPECT_NEAR(band.median[i], 10e9 * band.strain[i], 1.0);
    EXPECT_LE(band.lower[i], band.median[i]);
    EXPECT_GE(band.upper[i], band.median[i]);
    const bool measured = band.strain[i] <= 0.005 * (1.0 + 1e-12);
    EXPECT_EQ(std::isnan(band.measured[i]), !measured);
    if (measured) {
      EXPECT_NEAR(band.residual[i], 0.0, 10.0);
    }
  }
}

TEST(CurveBand, CountsABrokenReplicateAsCarryingNothing) {
  const std::vector<Response> replicates{straight(10e9, 0.002), straight(10e9, 0.002),
                                         straight(10e9, 0.01)};
  const auto band = band_of(replicates, {});
  EXPECT_EQ(band.median[band.strain.size() / 2], 0.0);
  EXPECT_GT(band.upper[band.strain.size() / 2], 0.0);
}

}  // namespace
}  // namespace havers::calib
