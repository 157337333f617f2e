// The checks of the answer itself, on either side of each of their limits, by results made by hand.
#include "calib/fit/answer_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

using test::says;
using testing::EndsWith;
using testing::HasSubstr;

CalibrationResult fitted_two() {
  CalibrationResult result;
  result.fitted = {"young_GPa", "ratio"};
  result.randomness = {.replicates = 8,
                       .replicates_needed = 4,
                       .common_gain = 20.0,
                       .simulator_share = 0.1,
                       .fresh_cost = 3.0,
                       .fresh_shift = 0.3,
                       .fresh_width = 1.2};
  return result;
}

TEST(Verdict, WarnsWhereFreshSeedsMakeAnotherAnswer) {
  EXPECT_EQ(check_randomness(fitted_two()).outcome, Outcome::pass);
  for (const auto& [number, within, beyond] : {std::tuple(&Randomness::fresh_shift, 0.99, 1.01),
                                               {&Randomness::simulator_share, 0.49, 0.51},
                                               {&Randomness::fresh_width, 1.99, 2.01},
                                               {&Randomness::fresh_width, 0.51, 0.49}}) {
    CalibrationResult result = fitted_two();
    result.randomness.*number = within;
    EXPECT_EQ(check_randomness(result).outcome, Outcome::pass) << within;
    result.randomness.*number = beyond;
    EXPECT_EQ(check_randomness(result).outcome, Outcome::warn) << beyond;
    EXPECT_THAT(check_randomness(result).text,
                EndsWith(" Raise calibrate.options.replicates to 16."));
    result.randomness.replicates_needed = 17;
    EXPECT_THAT(check_randomness(result).text, EndsWith("replicates to 17."));
  }
}

TEST(Verdict, SaysWhatFreshAndCommonSeedsBring) {
  CalibrationResult result = fitted_two();
  const std::string numbers =
      "8 fresh seeds per specimen move no parameter by more than 0.3 standard errors, the interval "
      "that changes most is 1.2 times as wide, their cost is 3; the replicates' chance makes 10 % "
      "of the variance.";
  for (const auto& [gain, sentence] :
       {std::pair(20.0,
                  " Common random numbers make differences between points 20 times less noisy."),
        {1.51, " Common random numbers make differences between points 1.51 times less noisy."},
        {1.49,
         " Common random numbers bring nothing here: replicates answer a change each in its own "
         "way."},
        {INFINITY, ""}}) {
    result.randomness.common_gain = gain;
    EXPECT_EQ(check_randomness(result).text, numbers + sentence);
  }
  result.randomness.fresh_shift = std::nan("");
  EXPECT_EQ(check_randomness(result).text,
            "Simulations with fresh seeds failed: the answer rests on its own.");
  EXPECT_EQ(check_randomness(result).outcome, Outcome::warn);
  EXPECT_FALSE(check_randomness({}).done);
}

TEST(Verdict, WarnsWhereTheLimitDiffersFromStepsInTime) {
  const Study study = test::synthetic_study({0.0});
  const FitProblem problem{.study = study, .unknowns = {}};
  CalibrationResult result = fitted_two();
  const auto check_at = [&](double strength, double strain) {
    result.confirmations = {{.failed = false,
                             .strength_limit = 50e6,
                             .strength_in_time = strength * 50e6,
                             .peak_in_time = 1.1 * strength * 50e6,
                             .failure_strain_limit = 4e-3,
                             .failure_strain_in_time = strain * 4e-3}};
    return check_confirmation(problem, result);
  };
  for (const double off : {-1.0, 1.0}) {
    EXPECT_EQ(check_at(1.0 + 0.019 * off, 1.0).outcome, Outcome::pass);
    EXPECT_EQ(check_at(1.0, 1.0 + 0.019 * off).outcome, Outcome::pass);
    EXPECT_EQ(check_at(1.0 + 0.021 * off, 1.0).outcome, Outcome::warn);
    EXPECT_EQ(check_at(1.0, 1.0 + 0.021 * off).outcome, Outcome::warn);
  }
  EXPECT_EQ(check_at(1.05, 0.97).text,
            "1 replicate step by step in time differs from the quasi-static limit by at most 5 % "
            "in strength and 3 % in failure strain; single waves of the break, too short for a "
            "testing machine, rise 10 % higher: inertia matters; fit with solver.regime = "
            "\"dynamic\".");
  result.confirmations = {{.failed = true}};
  EXPECT_EQ(check_confirmation(problem, result).outcome, Outcome::warn);
  EXPECT_EQ(check_confirmation(problem, result).text,
            "Every simulation in time failed: the limit stands unconfirmed.");
}

TEST(Verdict, WarnsOfASpecimenThatMovesAParameterByMoreThanTwoErrors) {
  CalibrationResult result = fitted_two();
  result.specimens = {{.id = "A1", .influence = {{"young_GPa", 1.9}, {"ratio", -1.9}}},
                      {.id = "A2", .influence = {{"young_GPa", 0.1}, {"ratio", 0.2}}}};
  EXPECT_EQ(check_influence(result).outcome, Outcome::pass);
  EXPECT_EQ(check_influence(result).text,
            "Without any one specimen every parameter stays within two standard errors.");
  result.specimens[0].influence[1].shift = -2.1;
  result.specimens[1].influence[0].shift = 2.1;
  EXPECT_EQ(check_influence(result).outcome, Outcome::warn);
  EXPECT_EQ(check_influence(result).text,
            "Left out, these move a parameter by more than two standard errors: A1 (ratio by "
            "-2.1), A2 (young_GPa by 2.1). Look at these tests, and test more like them.");
}

TEST(Verdict, WarnsOfParametersThatAreNotToldApart) {
  CalibrationResult result = fitted_two();
  result.directions = {"All of them.", "Their product is known."};
  const auto check_at = [&](double correlation) {
    result.correlation = {{1.0, correlation}, {correlation, 1.0}};
    return check_correlation(result);
  };
  for (const double size : {-0.89, 0.89}) {
    EXPECT_EQ(check_at(size).outcome, Outcome::pass) << size;
    EXPECT_EQ(check_at(size).text, "No two parameters are correlated by more than 0.9.");
  }
  EXPECT_EQ(check_at(0.91).outcome, Outcome::warn);
  const std::string text =
      "Correlated by more than 0.9: young_GPa and ratio (-0.91). Their product is known.";
  EXPECT_EQ(check_at(-0.91).text, text);
  EXPECT_EQ(check_at(-0.91).outcome, Outcome::warn);
  result.next_tests = {{"this", {0.7, 0.8}}, {"that", {0.9, 0.6}}, {"no other", {0.9, 0.9}}};
  EXPECT_EQ(check_at(-0.91).text, text + " Most would tell that.");
}

// In logarithms, where the interval by the slopes is from half to twice the value.
TEST(Verdict, WarnsWhereProfilesGiveOtherIntervals) {
  Study study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"young_GPa"};
  const FitProblem problem = make_problem(study);
  CalibrationResult result = fitted_two();
  result.parameters = {{.name = "young_GPa", .bounds = {1.0, 100.0}, .identifiable = true}};
  CalibratedParameter& parameter = result.parameters.front();
  parameter.slopes_95 = parameter.interval_95 = {7.0, 28.0};
  const auto check_at = [&](double times) {
    parameter.profile_95 = {14.0 * std::pow(0.5, times), 14.0 * std::pow(2.0, times)};
    return check_intervals(problem, result);
  };
  EXPECT_EQ(
      check_at(0.51).text,
      "Profile likelihood gives intervals 0.51 times as wide in logarithms as the slopes do.");
  EXPECT_EQ(check_at(0.51).outcome, Outcome::pass);
  EXPECT_EQ(check_at(1.99).outcome, Outcome::pass);
  EXPECT_EQ(check_at(2.01).outcome, Outcome::warn);
  EXPECT_EQ(check_at(0.49).outcome, Outcome::warn);
  EXPECT_EQ(check_at(0.49).text,
            "Profile likelihood gives other intervals: young_GPa (0.49 times as wide in "
            "logarithms). Believe the wider one.");
  parameter.profile_95[0] = std::nan("");
  EXPECT_THAT(check_intervals(problem, result).text,
              HasSubstr("intervals: young_GPa (open below)."));
  parameter.slopes_95[0] = 1.0;  // the bound, at which the profile may well be open
  EXPECT_THAT(check_intervals(problem, result).text,
              HasSubstr("no profile was asked for or could"));
  EXPECT_FALSE(check_intervals(problem, result).done);
}

TEST(Verdict, SaysWhereTheBootstrapIsWider) {
  Study study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"young_GPa"};
  study.calibrate.profiles = false;
  const FitProblem problem = make_problem(study);
  CalibrationResult result = fitted_two();
  result.parameters = {{.name = "young_GPa", .interval_95 = {7.0, 28.0}, .identifiable = true}};
  for (const auto& [times, is_said] : {std::pair(1.49, false), std::pair(1.6, true)}) {
    result.parameters[0].bootstrap_95 = {14.0 * std::pow(0.5, times), 14.0 * std::pow(2.0, times)};
    EXPECT_EQ(says(check_intervals(problem, result),
                   "wider ones: young_GPa (1.6 times as wide in logarithms); a draw may"),
              is_said);
  }
}

// Eight strengths at one orientation, of which a plain law has the mean and the model all
// deviations but `part` of each. Both have one parameter, so that their criteria differ by 2 n
// log(part).
Check plain_law_at(double difference, bool kept = false) {
  const Study study = test::synthetic_study({0.0, 0.0, 0.0, 0.0}, {.specimen_effect = 0.05});
  const FitProblem problem = make_problem(study);
  const double count = 8.0, part = std::exp(-difference / (2.0 * count));
  double mean = 0.0;
  for (const Target& target : problem.targets) mean += target.value[strength] / count;
  Answer answer;
  answer.best.point = start_point(problem.unknowns);
  answer.best.residuals = Eigen::VectorXd::Zero(8 * landmark_count);
  answer.slopes.failed = false;
  answer.slopes.jacobian = Eigen::MatrixXd::Zero(8 * landmark_count, 1);
  for (std::size_t f = 0; f < problem.fitted.size(); ++f) {
    const double measured = problem.targets[problem.fitted[f]].value[strength];
    answer.best.predictions.emplace_back().mean[strength] = measured - part * (measured - mean);
    answer.slopes.jacobian(first_row(f) + strength, 0) = 1.0;
  }
  answer.active = {0};
  answer.asked = {answer.slopes.jacobian, answer.active};
  // Another unknown that moves one strength is left out.
  answer.left = {{.unknown = 1, .because = "", .kept_where_found = kept}};
  answer.asked.unknowns.push_back(1);
  answer.asked.jacobian.conservativeResize(Eigen::NoChange, 2);
  answer.asked.jacobian.col(1).setUnit(strength);
  return check_plain_law(problem, answer);
}

TEST(Verdict, RejectsAModelThatSaysLessThanAPlainLaw) {
  EXPECT_EQ(plain_law_at(0.1).outcome, Outcome::pass);
  EXPECT_FALSE(says(plain_law_at(0.1), "fibres."));
  for (const double slightly : {-0.1, -5.9}) {
    EXPECT_EQ(plain_law_at(slightly).outcome, Outcome::warn) << slightly;
    EXPECT_THAT(plain_law_at(slightly).text, EndsWith(": these tests do not need the fibres."));
  }
  EXPECT_EQ(plain_law_at(-6.1).outcome, Outcome::fail);
  EXPECT_THAT(plain_law_at(-6.1).text,
              EndsWith("(one strength per orientation): the law without fibres says it better, the "
                       "model is rejected."));
}

// AICc counts it with 12 instead of 6.4 in all.
TEST(Verdict, CountsWhatIsKeptWhereTheFitFoundItBesideAPlainLaw) {
  EXPECT_EQ(plain_law_at(5.5).outcome, Outcome::pass);
  EXPECT_EQ(plain_law_at(5.5, true).outcome, Outcome::warn);
  EXPECT_EQ(plain_law_at(5.7, true).outcome, Outcome::pass);
}

}  // namespace
}  // namespace havers::calib
