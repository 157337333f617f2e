// Toes that no single test shows are plain in many.
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/reduction.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// Bars of 15 GPa and 12 MPa, whose toes reach through the window; few rows tell of it.
Check check_of_bars(double toe) {
  Study study = test::synthetic_study(std::vector<double>(12, 0.0));
  study.calibrate.parameters = {"young_GPa"};
  unsigned seed = 0;
  for (Specimen& specimen : study.specimens)
    specimen.test = test::reduced(test::record({.young = 15e9,
                                                .strength = 12e6,
                                                .toe = toe,
                                                .force_noise = 0.5,
                                                .strain_noise = 2e-6,
                                                .strain_rate = 2e-4,
                                                .seed = ++seed}));
  const CalibrationResult result = test::fit(study);
  const CalibratedParameter parameter = test::parameter_of(result, "young_GPa");
  const bool holds = parameter.interval_95[0] <= 15.0 && 15.0 <= parameter.interval_95[1];
  const Check check = test::check_of(result, "modulus clear of toes");
  EXPECT_TRUE(check.done);
  EXPECT_EQ(holds, check.outcome == Outcome::pass)
      << parameter.interval_95[0] << " to " << parameter.interval_95[1] << ": " << check.text;
  return check;
}

TEST(Verdict, WarnsOfToesThatNoSingleTestShows) {
  EXPECT_EQ(check_of_bars(0.0).outcome, Outcome::pass);
  const Check check = check_of_bars(1e-4);
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_TRUE(test::says(check, "Raise reduction.window_low and window_high.")) << check.text;
}

}  // namespace
}  // namespace havers::calib
