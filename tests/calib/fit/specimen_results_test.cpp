// What the result says of single specimens.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "calib/fit/calibrate.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// Of a test with 2 % less modulus and 1 % more strength than another, which is straight to the end
// but in strain, 3 % larger at the break.
TEST(SpecimenResult, HasTheDistancesOfAHeldOutTestWithTheirSigns) {
  Study study = test::synthetic_study(test::three_orientations);
  study.specimens[0].use = Use::validate;
  MeasuredTest& test = study.specimens[0].test;
  test = test::straight_test(0.98 * test.modulus, 1.01 * test.strength);
  const double row = test.failure_strain / 1000.0;
  test.failure_strain *= 1.03;
  const SpecimenResult held_out = test::fit(study).specimens[0];
  ASSERT_EQ(held_out.terms.size(), 3U);  // modulus, strength, failure strain
  double variance = 0.0;
  for (const TermResult& term : held_out.terms) variance += std::pow(term.sd, 2);
  // Half a row is added to a test that ends on its last one.
  const std::vector<double> distances{
      std::log(held_out.modulus.mean / test.modulus) / held_out.terms[0].sd,
      std::log(held_out.strength.mean / (test.strength * 1.0005)) / held_out.terms[1].sd,
      std::log(held_out.failure_strain.mean / (test.failure_strain + 0.5 * row)) /
          std::sqrt(variance)};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(held_out.residual.at(i), distances[i], 0.01) << i;
  EXPECT_LT(held_out.residual[2], -1.0);
}

TEST(SpecimenResult, HasMeanAndDeviationOfItsReplicates) {
  const auto result = test::fit(test::synthetic_study({0.0}), {.noise = 0.02});
  for (const SpecimenResult& specimen : result.specimens) {
    std::vector<double> strengths;
    for (const ReplicateResult& replicate : specimen.replicates)
      strengths.push_back(replicate.strength);
    EXPECT_NEAR(specimen.strength.mean, test::mean_of(strengths), 1.0);
    EXPECT_NEAR(specimen.strength.sd, test::deviation_of(strengths), 1.0);
    EXPECT_NEAR(specimen.failure_strain.sd * specimen.modulus.mean, specimen.strength.sd, 1.0);
  }
}

}  // namespace
}  // namespace havers::calib
