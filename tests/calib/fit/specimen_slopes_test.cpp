// Specimens that the fit did not see.
#include "calib/fit/specimen_slopes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

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

double error_by_parameters(const SpecimenResult& specimen, const std::string& name) {
  const auto found = std::ranges::find(specimen.terms, name, &TermResult::term);
  return found == specimen.terms.end() ? std::nan("") : found->parameters;
}

// Its modulus is one of those that bars have, beside the mean of five.
TEST(SpecimenSlopes, OfAHeldOutSpecimenWithoutAGroupHaveWhatGroupsDifferBy) {
  auto study = test::synthetic_study({0.0, 0.0, 0.0}, {.specimen_effect = 0.05});
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  study.calibrate.level["young_GPa"] = Level::specimen;
  study.specimens[5].use = Use::validate;
  const auto result = test::fit(study);
  std::vector<double> moduli;
  for (std::size_t k = 0; k < 5; ++k) moduli.push_back(std::log(result.parameters[k].value));
  const double expected = test::deviation_of(moduli) * std::sqrt(1.0 + 1.0 / 5.0);
  EXPECT_NEAR(error_by_parameters(result.specimens[5], "modulus"), expected, 0.01 * expected);
  EXPECT_EQ(test::check_of(result, "held-out specimens").outcome, Outcome::pass);
}

// One group does not tell what groups differ by: of the modulus nothing is compared.
TEST(SpecimenSlopes, CompareNothingOfWhatOneGroupDoesNotTell) {
  auto study = test::synthetic_study({0.0, 90.0});
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  study.calibrate.level["young_GPa"] = Level::orientation;
  study.specimens[2].use = study.specimens[3].use = Use::validate;
  const auto result = test::fit(study);
  EXPECT_TRUE(std::isnan(error_by_parameters(result.specimens[2], "modulus")));
  EXPECT_TRUE(std::isfinite(error_by_parameters(result.specimens[2], "strength")));
  EXPECT_TRUE(std::isnan(result.specimens[2].residual[0]));
  EXPECT_TRUE(std::isfinite(result.specimens[2].residual[1]));
}

}  // namespace
}  // namespace havers::calib
