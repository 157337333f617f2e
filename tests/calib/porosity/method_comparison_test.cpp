#include "calib/porosity/method_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace havers::calib {
namespace {

PorosityTrial trial_of(const std::string& hardship, double truth, double ours) {
  PorosityTrial trial{.hardship = hardship, .pixels = 1e6, .truth = truth};
  trial.readings.back() = {ours, 0.05};
  return trial;
}

const MethodSummary& ours_of(const std::array<MethodSummary, porosity_methods>& methods) {
  return methods.at(static_cast<std::size_t>(PorosityMethod::ours));
}

TEST(CompareMethods, SumsUpErrorsAndTime) {
  const auto comparison = compare_methods(
      {trial_of("noise", 0.0, 0.001), trial_of("noise", 0.1, 0.104), trial_of("blur", 0.1, 0.12)});
  const MethodSummary& all = ours_of(comparison.methods);
  EXPECT_NEAR(all.median_error, 0.004, 1e-12);
  EXPECT_NEAR(all.worst_error, 0.02, 1e-12);
  EXPECT_NEAR(all.worst_if_none, 0.001, 1e-12);
  EXPECT_NEAR(all.cpu_per_pixel, 5e-8, 1e-15);
  ASSERT_EQ(comparison.hardships.size(), 2U);
  EXPECT_EQ(comparison.hardships[0].hardship, "noise");
  EXPECT_NEAR(ours_of(comparison.hardships[0].methods).worst_error, 0.004, 1e-12);
  EXPECT_TRUE(std::isnan(ours_of(comparison.hardships[1].methods).worst_if_none));
}

TEST(CompareMethods, NamesEveryMethod) {
  for (std::size_t i = 0; i < porosity_methods; ++i)
    EXPECT_FALSE(to_string(static_cast<PorosityMethod>(i)).empty());
}

}  // namespace
}  // namespace havers::calib
