#include "calib/sweep/law.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/calib/student_tail.hpp"
#include "tests/support/sweeps.hpp"

namespace havers::calib {
namespace {

using test::deviation;
using test::KnownSweep;

const std::vector<SweepKey> two_keys{{"d", {"0.2", "0.4", "0.8"}}, {"r", {"1", "3"}}};

Law only_law(const LawRequest& request, const KnownSweep& known) {
  auto laws = fit_laws(request, known.plan, known.points, known.runs);
  EXPECT_EQ(laws.size(), 1U);
  return laws.front();
}

TEST(Law, FindsAPlaneAgainToRounding) {
  const KnownSweep known(two_keys, 2, [](const SweepPoint& p, int) {
    return 3.0 * p.numbers[0] - 2.0 * p.numbers[1] + 7.0;
  });
  const Law law = only_law({Measure::strength, {"d", "r"}, ""}, known);
  EXPECT_EQ(law.status, LawStatus::fitted);
  EXPECT_NEAR(law.coefficients[0], 3.0, 1e-12);
  EXPECT_NEAR(law.coefficients[1], -2.0, 1e-12);
  EXPECT_NEAR(law.coefficients[2], 7.0, 1e-12);
  EXPECT_NEAR(law.explained, 1.0, 1e-12);
}

// Slope's standard error: σ/√Σ(x − x̄)², with σ² = Σ residual²/(n − 2).
TEST(Law, StandardErrorIsTheTextbookOne) {
  const KnownSweep known({{"d", {"0", "1"}}}, 20, [](const SweepPoint& p, int k) {
    return 5.0 * p.numbers[0] + deviation(k);
  });
  const Law law = only_law({Measure::strength, {"d"}, ""}, known);
  double squares = 0.0;
  for (int k = 0; k < 20; ++k) squares += 2.0 * deviation(k) * deviation(k);
  EXPECT_NEAR(law.standard_errors[0], std::sqrt(squares / 38.0) / std::sqrt(40 * 0.25), 1e-12);
  EXPECT_NEAR(law.coefficients[0], 5.0, 1e-12);
}

// 5x ± 1 at 0 and 1: the residuals' squares add up to 4, those about the mean of all to 29.
TEST(Law, StatesScatterExplainedPartAndConfidence) {
  const KnownSweep known({{"d", {"0", "1"}}}, 2, [](const SweepPoint& p, int k) {
    return 5.0 * p.numbers[0] + 2.0 * k - 1.0;
  });
  const Law law = only_law({Measure::strength, {"d"}, ""}, known);
  EXPECT_EQ(law.runs, 4);
  EXPECT_NEAR(law.residual_sd, std::sqrt(4.0 / 2.0), 1e-12);
  EXPECT_NEAR(law.explained, 1.0 - 4.0 / 29.0, 1e-12);
  EXPECT_NEAR(test::student_tail(law.confidence_factor, 2), 0.025, 1e-12);
}

// (W2) Means 100, 130, 100 lie 10, 20, 10 off their level line: 2·600 for one degree of freedom;
// two runs 10 above and below each mean give 600 for three. F of 1 and 3 is t² of 3.
TEST(Law, LackOfFitIsTheTextbookOne) {
  const KnownSweep known({{"d", {"0", "1", "2"}}}, 2, [](const SweepPoint& p, int k) {
    return (p.numbers[0] == 1.0 ? 130.0 : 100.0) + 20.0 * k - 10.0;
  });
  const Law law = only_law({Measure::strength, {"d"}, ""}, known);
  EXPECT_NEAR(law.lack_of_fit, 6.0, 1e-10);
  EXPECT_NEAR(law.lack_of_fit_p, 2.0 * test::student_tail(std::sqrt(6.0), 3), 1e-10);
}

TEST(Law, LackOfFitIsSeenInAParabolaAndNotInALine) {
  const std::vector<SweepKey> keys{{"d", {"0", "1", "2", "3"}}};
  const auto fitted = [&](double bend) {
    const KnownSweep known(keys, 20, [bend](const SweepPoint& p, int k) {
      return p.numbers[0] + bend * p.numbers[0] * p.numbers[0] + deviation(k);
    });
    return only_law({Measure::strength, {"d"}, ""}, known);
  };
  EXPECT_NEAR(fitted(0.0).lack_of_fit, 0.0, 1e-12);
  EXPECT_GT(fitted(0.0).lack_of_fit_p, 0.99);
  EXPECT_LT(fitted(1.0).lack_of_fit_p, 1e-3);
}

// As the modulus is in the limit: R² of rounding was below 0, and its F called the law wrong.
TEST(Law, ExplainsNothingOfRunsThatAreEqualButForRounding) {
  const KnownSweep known(two_keys, 2, [](const SweepPoint& p, int k) {
    return 13e9 * (1.0 + 1e-15 * std::round(4.0 * p.numbers[0] * p.numbers[1] + k));
  });
  const Law law = only_law({Measure::modulus, {"d", "r"}, ""}, known);
  EXPECT_EQ(law.status, LawStatus::fitted);
  EXPECT_NEAR(law.coefficients.back(), 13e9, 1.0);
  EXPECT_TRUE(std::isnan(law.explained));
  EXPECT_TRUE(std::isnan(law.lack_of_fit));
}

TEST(Law, IsFittedForEveryValueOfPer) {
  const KnownSweep known(two_keys, 2,
                         [](const SweepPoint& p, int) { return p.numbers[0] * p.numbers[1]; });
  const auto laws = fit_laws({Measure::strength, {"d"}, "r"}, known.plan, known.points, known.runs);
  ASSERT_EQ(laws.size(), 2U);
  EXPECT_EQ(laws[1].at, "3");
  EXPECT_NEAR(laws[1].coefficients[0], 3.0, 1e-12);
}

TEST(Law, SaysWhenItCannotBeFitted) {
  const KnownSweep few({{"d", {"0", "1"}}}, 1, [](const SweepPoint&, int) { return 1.0; });
  EXPECT_EQ(only_law({Measure::strength, {"d"}, ""}, few).status, LawStatus::too_few_runs);
  const KnownSweep same({{"d", {"1", "1"}}}, 5, [](const SweepPoint&, int k) { return k; });
  EXPECT_EQ(only_law({Measure::strength, {"d"}, ""}, same).status, LawStatus::terms_do_not_vary);
  KnownSweep unbroken(two_keys, 2, [](const SweepPoint& p, int) { return p.numbers[0]; });
  unbroken.runs.back().broke = false;
  EXPECT_EQ(only_law({Measure::strength, {"d"}, ""}, unbroken).status, LawStatus::unbroken_runs);
  EXPECT_EQ(only_law({Measure::modulus, {"d"}, ""}, unbroken).status, LawStatus::fitted);
  for (const LawStatus status : {LawStatus::fitted, LawStatus::too_few_runs,
                                 LawStatus::terms_do_not_vary, LawStatus::unbroken_runs})
    EXPECT_FALSE(explain(status).empty());
}

}  // namespace
}  // namespace havers::calib
