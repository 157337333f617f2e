// Specimens that the fit did not see.
#include "calib/fit/specimen_slopes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/slow.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

// r rests on one specimen at 45 degrees, which errs like the other: half of what parts the two is
// the fit's.
TEST(HeldOutSpecimen, IsAsFarOffAsItsStandardDeviationSays) {
  HAVERS_SLOW;
  constexpr int studies = 100;
  double sum = 0.0;
  for (unsigned draw = 1; draw <= studies; ++draw) {
    auto study = test::synthetic_study(test::three_orientations, {.strength_error = 0.02}, draw);
    study.specimens[2].use = Use::validate;
    study.calibrate.profiles = false;
    const CalibrationResult result = test::fit(study);
    sum += std::pow(result.specimens[2].residual[strength], 2);
    for (const TermResult& term : result.specimens[3].terms) EXPECT_EQ(term.parameters, 0.0);
  }
  RecordProperty("mean_square", std::to_string(sum / studies));
  EXPECT_NEAR(sum / studies, 1.0, 3.0 * std::sqrt(2.0 / studies));
}

// By the closed form: strength is proportional to the first threshold, modulus to Young's modulus.
TEST(SpecimenSlopes, AreThoseOfTheLaw) {
  auto study = test::synthetic_study({0.0, 90.0});
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  const FitProblem problem = make_problem(study);
  SimulationBatch batch(test::ClosedForm{}.simulator(), nullptr, 1);
  Answer answer{.active = {0, 1}, .replicates = 4};
  answer.best.point = start_point(problem.unknowns);
  Specimen other = study.specimens.front();
  other.id = "other";
  other.orientation = std::acos(-1.0) / 4.0;
  const Eigen::MatrixXd slopes = specimen_slopes(batch, problem, answer, other, 0);
  ASSERT_EQ(slopes.cols(), 2);
  EXPECT_NEAR(slopes(modulus, 0), 1.0, 1e-9);
  EXPECT_NEAR(slopes(modulus, 1), 0.0, 1e-9);
  EXPECT_NEAR(slopes(strength, 0), 0.0, 1e-9);
  EXPECT_NEAR(slopes(strength, 1), 1.0, 1e-9);
}

}  // namespace
}  // namespace havers::calib
