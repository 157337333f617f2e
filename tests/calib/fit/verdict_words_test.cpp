// What a verdict says beside yes and no: what is left out, where it stays, what helps.
#include <gmock/gmock.h>

#include <set>

#include "calib/fit/answer.hpp"
#include "calib/fit/answer_checks.hpp"
#include "calib/fit/model_checks.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

using test::check_of;
using test::says;

TEST(Verdict, SaysWhatIsLeftOut) {
  const auto check = check_of(test::fit(test::synthetic_study({0.0})), "identifiable");
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_TRUE(says(check, "ratio is left out"));
  EXPECT_TRUE(says(check, ", the value of [model]. What is left out")) << check.text;
}

// One parameter, of which the study's value cannot be, and which its own noise hides.
TEST(Verdict, SaysWhereAParameterStaysThatIsLeftOut) {
  Study study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"scatter"};
  const FitProblem problem{.study = study, .unknowns = unknowns_of(study)};
  Answer answer;
  answer.left = {{0, "practically unidentifiable; kept where the fit found it"}};
  CalibrationResult result;
  const auto stays_at = [&](double scatter) {
    answer.best.point = Point::Constant(1, scatter);
    answer.best.failed = false;
    result.verdict = verdict_of(problem, answer, result);
    return check_of(result, "identifiable").text;
  };
  const std::string rest = " What is left out has no interval; ";
  EXPECT_THAT(stays_at(0.01), testing::HasSubstr("found it. It stays at 0.01, a bound." + rest));
  EXPECT_THAT(stays_at(0.5), testing::HasSubstr("found it. It stays at 0.5." + rest));
  EXPECT_THAT(stays_at(problem.unknowns[0].start), testing::HasSubstr(", the value of [model]."));
}

TEST(Verdict, TicksNothingOfAFitThatHasNoParameter) {
  Study study = test::synthetic_study({0.0});
  study.calibrate.parameters = {"scatter"};
  const FitProblem problem{.study = study, .unknowns = unknowns_of(study)};
  Answer answer{.status = CalibrationStatus::nothing_to_fit};
  answer.left = {{0, "nothing changes with it"}};
  answer.best.point = Point::Constant(1, 0.01);
  answer.best.failed = false;
  CalibrationResult result;
  result.verdict = verdict_of(problem, answer, result);
  for (const Check& check : result.verdict)
    if (check.outcome == Outcome::pass && check.check != "simulations") {
      EXPECT_FALSE(check.done) << check.check;
      EXPECT_TRUE(says(check, "Not checked: ")) << check.text;
    }
  EXPECT_EQ(check_of(result, "inside bounds").text, "Not checked: no parameter is fitted.");
  const Check left = check_of(result, "identifiable");
  EXPECT_EQ(left.outcome, Outcome::warn);
  EXPECT_FALSE(says(left, "the others")) << left.text;
}

TEST(Verdict, WritesPercentagesInPlainDigits) {
  EXPECT_EQ(percent_text(0.026), "2.6 %");
  EXPECT_EQ(percent_text(0.996), "100 %");
  EXPECT_EQ(percent_text(2.8), "280 %");
  EXPECT_EQ(percent_text(5e-27), "0 %");
}

TEST(Verdict, NamesWhyMostSimulationsFailedAndWhatWouldAvoidIt) {
  const Study study = test::synthetic_study({0.0});
  const FitProblem problem{.study = study, .unknowns = unknowns_of(study)};
  Answer answer;
  answer.best.point = Point::Constant(static_cast<Eigen::Index>(problem.unknowns.size()), 0.5);
  CalibrationResult result;
  result.failed_simulations = 5;
  result.distinct_simulations = 9;
  const auto advice = [&](const std::string& because) {
    result.most_failed_because = because;
    return verdict_of(problem, answer, result).back().text;
  };
  sim::Simulation run;
  run.status = sim::SimulationStatus::broken;
  run.step_error->strength = run.step_error->over_a_wave = 0.5;
  EXPECT_THAT(advice(run.why_not_trusted()), testing::HasSubstr("quasi-static regime, may help."));
  EXPECT_THAT(advice(explain(sim::SimulationStatus::step_limit)),
              testing::HasSubstr("takes fewer."));
  EXPECT_THAT(advice(explain(sim::SimulationStatus::not_converged)),
              testing::EndsWith("calibrate.bounds that keep to where the model can be simulated."));
}

// One specimen is "the fitted specimen", not "the 1 fitted specimens".
TEST(Verdict, SpeaksOfOneAsOfOne) {
  Study study = test::synthetic_study({0.0});
  study.specimens.resize(1);
  study.calibrate.parameters = {"head_tail_MPa", "ratio"};
  const CalibrationResult result = test::fit(study);
  EXPECT_THAT(test::parameter_of(result, "ratio").left_out_because,
              testing::EndsWith("nothing that the fitted specimen shows changes with it"));
  EXPECT_EQ(test::parameter_of(result, "head_tail_MPa").bootstrap_missing,
            "1 specimen is too few to draw from, 5 are the least");
  EXPECT_EQ(result.directions.front(), "The specimens determine 1 of 1 direction.");
  EXPECT_TRUE(says(check_of(result, "better than a plain law"), "1 strength is too few"));
  study.calibrate.parameters = {"head_tail_MPa", "young_GPa"};
  const Check spread = check_of(test::fit(study), "spread between specimens");
  EXPECT_TRUE(says(spread, " on 1 degree of freedom (")) << spread.text;

  CalibrationResult one;
  one.specimens.push_back({.id = "A1", .use = Use::validate});
  EXPECT_TRUE(says(check_validation(one, {}), "1 held-out specimen lies within"));
  one.fitted = {"ratio"};
  one.confirmations.push_back({.failed = false,
                               .strength_limit = 1.0,
                               .strength_in_time = 1.0,
                               .peak_in_time = 1.0,
                               .failure_strain_limit = 1.0,
                               .failure_strain_in_time = 1.0});
  const FitProblem problem{.study = study, .unknowns = {}, .fitted = {0, 1}};
  EXPECT_TRUE(says(check_confirmation(problem, one), "1 replicate step by step in time differs"));
  EXPECT_EQ(check_confirmation(problem, one).outcome, Outcome::pass);
  one.confirmations.push_back({.failed = true});
  EXPECT_TRUE(says(check_confirmation(problem, one), "in time 1 more has no answer to be trusted"));
  EXPECT_EQ(check_confirmation(problem, one).outcome, Outcome::warn);
}

TEST(Verdict, SaysHowManySimulationsDoNotBreak) {
  CalibrationResult result;
  for (const int unbroken : {0, 1}) {
    SpecimenResult& specimen = result.specimens.emplace_back();
    for (int i = 0; i < 4; ++i)
      specimen.replicates.push_back({.failed = false, .broke = i >= unbroken});
    specimen.replicates.push_back({.failed = true});
  }
  EXPECT_TRUE(says(check_censored(result), "1 of 8 simulations at the answer reach"));
  EXPECT_EQ(check_censored(result).outcome, Outcome::warn);
  for (std::size_t i : {1U, 2U}) result.specimens[1].replicates[i].broke = false;
  EXPECT_TRUE(says(check_censored(result), "1 of 2 specimens does not break"));
  EXPECT_EQ(check_censored(result).outcome, Outcome::fail);
  result.specimens.pop_back();
  EXPECT_EQ(check_censored(result).outcome, Outcome::pass);
}

// A strength that simulations do not reach is compared with nothing.
TEST(Verdict, FailsAHeldOutSpecimenWhoseSimulationsDoNotBreak) {
  CalibrationResult result;
  SpecimenResult& specimen = result.specimens.emplace_back();
  specimen.id = "V1";
  specimen.use = Use::validate;
  specimen.residual = {0.5, 0.0, 0.0};
  specimen.replicates = {{.failed = false}, {.failed = false}, {.failed = false, .broke = true}};
  EXPECT_TRUE(says(check_validation(result, {}), "failed or did not break"));
  EXPECT_EQ(check_validation(result, {}).outcome, Outcome::fail);
  specimen.replicates.front().broke = true;
  EXPECT_EQ(check_validation(result, {}).outcome, Outcome::pass);
}

// Those that did not fail are no fair sample of its strengths.
TEST(Verdict, NamesSpecimensWhoseSimulationsOftenFail) {
  const Study study = test::synthetic_study({0.0});
  const FitProblem problem{.study = study, .unknowns = unknowns_of(study)};
  Answer answer;
  answer.best.point = Point::Constant(static_cast<Eigen::Index>(problem.unknowns.size()), 0.5);
  CalibrationResult result;
  result.distinct_simulations = 400;
  result.failed_simulations = 3;
  result.most_failed_because = "the specimen falls apart; more fibres help";
  result.specimens.push_back({.id = "C2"});
  result.specimens[0].replicates.resize(8);
  result.specimens[0].failed_simulations = 3;
  const auto simulations = [&] { return verdict_of(problem, answer, result).back(); };
  EXPECT_EQ(simulations().text,
            "3 of 400 different simulations failed, more than a quarter of those of C2, most often "
            "so: the specimen falls apart; more fibres help.");
  EXPECT_EQ(simulations().outcome, Outcome::warn);
  result.specimens[0].failed_simulations = 2;
  EXPECT_TRUE(says(simulations(), "3 of 400 different simulations failed; the replicates"));
  result.reserved_simulations = 100;
  result.most_reserved_because = "the time step: 20 ns was given, and its error is not known";
  EXPECT_TRUE(says(simulations(),
                   "; 100 have a reservation, most often so: the time step: 20 ns "
                   "was given, and its error is not known."));
  EXPECT_EQ(simulations().outcome, Outcome::warn);
}

TEST(CalibrationResult, SaysWhyItIsNotTrusted) {
  CalibrationResult result;
  result.verdict = {{"converged", Outcome::fail, ""}, {"inside bounds", Outcome::pass, ""}};
  result.status = CalibrationStatus::budget_spent;
  EXPECT_EQ(why_not_trusted(result), explain(CalibrationStatus::budget_spent));
  result.status = CalibrationStatus::converged;
  EXPECT_EQ(why_not_trusted(result), "1 of 2 checks failed (converged)");
  result.verdict[1].outcome = Outcome::fail;
  EXPECT_EQ(why_not_trusted(result), "2 of 2 checks failed (converged, inside bounds)");
}

// Strengths of two orientations that scatter differently have no modulus together.
TEST(Verdict, SaysTheWeibullModulusOfOneOrientationAtATime) {
  CalibrationResult result;
  const auto test = [&](double degrees, double scatter, int i) {
    SpecimenResult& specimen = result.specimens.emplace_back();
    specimen.orientation = degrees * degree;
    specimen.strength.mean = 1.0;
    specimen.measured.broke = true;
    specimen.measured.strength = 1.0 + scatter * (i - 2);
    ReplicateResult& replicate = specimen.replicates.emplace_back();
    replicate.failed = false;
    replicate.broke = true;
    replicate.strength = specimen.measured.strength;
  };
  for (int i = 0; i < 5; ++i) test(0.0, 0.1, i);
  const auto along = weibull_sentence(result, {});
  EXPECT_THAT(along, testing::StartsWith(" The scatter of the strengths measured at 0 deg about"));
  for (int i = 0; i < 4; ++i) test(90.0, 0.001, i);
  EXPECT_EQ(weibull_sentence(result, {}), along) << "four are too few";
  test(90.0, 0.001, 4);
  const auto both = weibull_sentence(result, {});
  EXPECT_THAT(both, testing::StartsWith(along));
  EXPECT_THAT(both.substr(along.size()), testing::HasSubstr("measured at 90 deg"));
}

TEST(CalibrationStatus, HasASentenceEach) {
  std::set<std::string> sentences;
  for (const auto status : {CalibrationStatus::converged, CalibrationStatus::budget_spent,
                            CalibrationStatus::all_failed, CalibrationStatus::nothing_to_fit,
                            CalibrationStatus::cancelled})
    sentences.insert(explain(status));
  EXPECT_EQ(sentences.size(), 5U);
  EXPECT_EQ(to_string(Outcome::warn), "warn");
}

}  // namespace
}  // namespace havers::calib
