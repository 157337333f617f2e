// What of an answer is the chance of its replicates.
#include "calib/fit/randomness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "calib/fit/calibrate.hpp"
#include "calib/fit/scenes.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

/// Log strengths of the closed form less those measured, of each specimen; but for a constant.
struct SimulatedMeans {
  std::vector<double> seen, fresh, variance;  // the last of the replicates seen

  SimulatedMeans(const Study& study, const test::ClosedForm& law) {
    const int n = study.calibrate.replicates;
    for (const Specimen& specimen : study.specimens) {
      const double measured = std::log(specimen.test.strength);
      const auto draws_from = [&](int first) {
        std::vector<double> draws;
        for (int i = first; i < first + n; ++i)
          draws.push_back(law.noise *
                          test::normal_of(replicate_seed(study.calibrate.seed, specimen.id, i)));
        return draws;
      };
      const auto draws = draws_from(0);
      seen.push_back(test::mean_of(draws) - measured);
      fresh.push_back(test::mean_of(draws_from(n)) - measured);
      variance.push_back(std::pow(test::deviation_of(draws), 2));
    }
  }
};

// The answer is the mean over the specimens of one orientation: all of (F17) is in closed form.
TEST(Randomness, OfAMeanIsThatOfItsReplicates) {
  const test::ClosedForm law{.noise = 0.02};
  const Study study =
      test::one_mean_study(3, "head_tail_MPa", "strength", {.specimen_effect = 0.02}, 1, law);
  const auto result = test::fit(study, law);
  ASSERT_GT(result.specimen_effect[strength], 0.0);
  const SimulatedMeans means(study, law);
  const auto threshold = test::parameter_of(result, "head_tail_MPa");
  const double specimens = 6.0, replicates = 8.0;
  const double error = threshold.standard_error / threshold.value;
  const double spread = error * std::sqrt(specimens);
  // The search ends where the specimen effect stays to 5 %.
  EXPECT_NEAR(spread / test::deviation_of(means.seen), 1.0, 0.05);

  const double shift = test::mean_of(means.fresh) - test::mean_of(means.seen);
  EXPECT_NEAR(result.randomness.fresh_shift, std::abs(shift) / error, 1e-3);
  double squares = 0.0;
  for (const double fresh : means.fresh)
    squares += std::pow((fresh - test::mean_of(means.seen)) / spread, 2);
  EXPECT_NEAR(result.randomness.fresh_cost, 0.5 * squares, 2e-3 * squares);
  // But for Student's quantile, which is hardly another one.
  EXPECT_NEAR(result.randomness.fresh_width, test::deviation_of(means.fresh) / spread, 0.02);

  const double part = test::mean_of(means.variance) / std::pow(spread, 2);
  EXPECT_NEAR(result.randomness.simulator_share, part / replicates, 1e-3 * part);
  EXPECT_EQ(result.randomness.replicates_needed, static_cast<int>(std::ceil(part / 0.05)));
  EXPECT_GT(result.randomness.replicates_needed, 4);  // the least there are
}

// The closed form's noise is a factor of the seed alone: common seeds cancel it altogether.
TEST(Randomness, CancelsInDifferencesWithCommonSeeds) {
  const auto result = test::fit(test::synthetic_study(test::three_orientations));
  EXPECT_TRUE(std::isinf(result.randomness.common_gain));
}

// Seeds of each point's own: differences keep all of the noise, and the slopes are worse.
TEST(Randomness, DoesWithoutCommonRandomNumbersAndSaysWhatThatCosts) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.common_seeds = false;
  const auto result = test::fit(study);
  EXPECT_GT(result.randomness.common_gain, 0.5);
  EXPECT_LT(result.randomness.common_gain, 2.0);
  EXPECT_NEAR(test::parameter_of(result, "head_tail_MPa").value, 60.0, 1.0);
}

TEST(Randomness, TakesAsManyReplicatesAsItNeeds) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.replicates = replicates_by_need;
  const auto few = test::fit(study, {.noise = 1e-5});
  const auto many = test::fit(study, {.noise = 0.02});
  EXPECT_EQ(few.randomness.replicates, 4);
  EXPECT_GT(many.randomness.replicates, 8);
  EXPECT_NEAR(test::parameter_of(many, "head_tail_MPa").value, 60.0, 2.0);
}

// Strengths known to 10 %, but for that at which a test was stopped: it tells nothing.
TEST(Randomness, NeedsNoReplicatesForABoundThatNothingContradicts) {
  auto study = test::synthetic_study(test::three_orientations);
  for (auto& specimen : study.specimens)
    specimen.test.strength_standard_error = 0.1 * specimen.test.strength;
  study.specimens.push_back(study.specimens[0]);
  study.specimens.back().id = "stopped";
  study.specimens.back().broke = false;
  study.specimens.back().test = test::straight_test(14e9, 25e6, 2e-3, 2e-3);
  EXPECT_EQ(test::fit(study, {.noise = 0.02}).randomness.replicates_needed, 4);
}

// Moduli depend on no seed. The exponent of porosity would follow how they differ, and is not told.
TEST(Randomness, LetsWhatIsLeftOutStay) {
  auto study = test::synthetic_study({0.0, 0.0}, {.specimen_effect = 0.03});
  study.calibrate.parameters = {"young_GPa", "modulus_exponent"};
  study.calibrate.terms = {"modulus"};
  study.porosity.to_modulus = ToModulus::power;
  for (Specimen& specimen : study.specimens)
    specimen.porosity = 0.05 - 0.05 * std::log(specimen.test.modulus / 14e9);
  const auto result = test::fit(study);
  ASSERT_FALSE(test::parameter_of(result, "modulus_exponent").identifiable);
  EXPECT_NEAR(result.randomness.fresh_shift, 0.0, 1e-9);
  EXPECT_NEAR(result.randomness.fresh_width, 1.0, 0.05);
}

}  // namespace
}  // namespace havers::calib
