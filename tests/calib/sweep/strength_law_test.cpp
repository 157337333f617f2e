#include "calib/sweep/strength_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace havers::calib {
namespace {

// As many quantiles of a law as a large sample would have.
template <class Quantile>
std::vector<double> quantiles(int n, Quantile quantile) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(quantile((i + 0.5) / n));
  return values;
}

TEST(StrengthLaw, FindsWeibullAgain) {
  const auto values =
      quantiles(2000, [](double u) { return 40e6 * std::pow(-std::log1p(-u), 1.0 / 8.0); });
  const StrengthLaw law = strength_law(values);
  EXPECT_EQ(law.runs, 2000);
  EXPECT_NEAR(law.weibull_modulus, 8.0, 0.05);
  EXPECT_LT(law.weibull_modulus_95[0], 8.0);
  EXPECT_GT(law.weibull_modulus_95[1], 8.0);
  EXPECT_NEAR(law.weibull_scale, 40e6, 0.05e6);
  EXPECT_LT(law.log_likelihood_gain, -2.0);
}

TEST(StrengthLaw, FindsGumbelAgain) {
  const auto values =
      quantiles(2000, [](double u) { return 60e6 + 5e6 * std::log(-std::log1p(-u)); });
  const StrengthLaw law = strength_law(values);
  EXPECT_NEAR(law.gumbel_location, 60e6, 0.05e6);
  EXPECT_NEAR(law.gumbel_width, 5e6, 0.05e6);
  EXPECT_GT(law.log_likelihood_gain, 2.0);
}

TEST(StrengthLaw, IsNoneOfTooFewOrEqualStrengths) {
  EXPECT_EQ(strength_law(std::vector{1.0, 2.0, 3.0}).runs, 0);
  EXPECT_EQ(strength_law(std::vector(10, 4e7)).runs, 0);
}

}  // namespace
}  // namespace havers::calib
