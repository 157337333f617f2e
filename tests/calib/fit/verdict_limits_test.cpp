// Checks of searches, simulations and parameters on either side of each of their limits, by answers
// made by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "calib/fit/answer.hpp"
#include "calib/fit/model_checks.hpp"
#include "calib/fit/parameter_checks.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

using test::says;
using testing::EndsWith;

/// A search that ended well, of a study whose specimens do not matter here.
struct EndedSearch {
  Study study = test::synthetic_study({0.0});
  FitProblem problem{.study = study, .unknowns = unknowns_of(study)};
  Answer answer{.status = CalibrationStatus::converged};
  CalibrationResult result{.cost = 3.0};

  EndedSearch() {
    answer.best.point = start_point(problem.unknowns);
    answer.best.failed = answer.slopes.failed = false;
    answer.active = {0};
  }
  [[nodiscard]] Check check(const std::string& name) {
    result.verdict = verdict_of(problem, answer, result);
    return test::check_of(result, name);
  }
};

TEST(Verdict, WarnsWhereSearchesStoppedShort) {
  EndedSearch search;
  search.answer.uncertainty.distance = 0.049;
  EXPECT_EQ(search.check("converged").text, "The searches stopped at a minimum, cost 3.");
  EXPECT_EQ(search.check("converged").outcome, Outcome::pass);
  search.answer.uncertainty.distance = 0.051;
  EXPECT_EQ(search.check("converged").text,
            "The searches stopped, but the slope promises a cost lower by 0.051: more replicates "
            "make the simulated outcome smoother.");
  EXPECT_EQ(search.check("converged").outcome, Outcome::warn);
  search.answer.uncertainty.distance = 0.0;
  search.answer.agrees = false;
  EXPECT_EQ(search.check("converged").text,
            "The searches stopped, but with what they came to the weights change: more replicates "
            "make the simulated outcome smoother.");
  EXPECT_EQ(search.check("converged").outcome, Outcome::warn);
}

TEST(Verdict, WarnsOfOneStartWithoutAnother) {
  EndedSearch search;
  EXPECT_FALSE(search.check("starts agree").done);
  search.answer.ends = {search.answer.best};
  EXPECT_EQ(search.check("starts agree").text,
            "Only one start gave an answer; nothing to compare it with.");
  EXPECT_EQ(search.check("starts agree").outcome, Outcome::warn);
}

TEST(Verdict, FailsWhereMoreThanAFifthOfTheSimulationsFail) {
  EndedSearch search;
  search.result.distinct_simulations = 100;
  search.result.most_failed_because = "the step is too long";
  for (const auto& [failed, outcome] : {std::pair(0, Outcome::pass),
                                        {4, Outcome::pass},
                                        {6, Outcome::warn},
                                        {19, Outcome::warn},
                                        {21, Outcome::fail}}) {
    search.result.failed_simulations = failed;
    EXPECT_EQ(search.check("simulations").outcome, outcome) << failed;
  }
  search.result.failed_simulations = 0;
  EXPECT_EQ(search.check("simulations").text, "0 of 100 different simulations failed.");
  for (const auto& [reserved, outcome] :
       {std::pair(4, Outcome::pass), std::pair(6, Outcome::warn)}) {
    search.result.reserved_simulations = reserved;
    EXPECT_EQ(search.check("simulations").outcome, outcome) << reserved;
  }
}

TEST(Verdict, AsksWhetherSpecimensFarApartAreOfOneKind) {
  const Study study = test::synthetic_study(test::three_orientations);
  const FitProblem problem = make_problem(study);
  Answer answer;
  const auto check_at = [&](Landmark q, double effect) {
    answer.weights.specimen.setZero();
    answer.weights.specimen[q] = effect;
    return check_specimen_spread(problem, answer);
  };
  for (const bool failed : {true, false}) {
    answer.slopes.failed = failed;
    answer.uncertainty.freedom.setConstant(5.0);
    for (const Landmark q : {modulus, strength}) {
      EXPECT_EQ(check_at(q, 0.29).outcome, Outcome::pass);
      EXPECT_EQ(check_at(q, 0.31).outcome, Outcome::warn);
      EXPECT_EQ(check_at(q, 0.49).outcome, Outcome::warn);
      EXPECT_EQ(check_at(q, 0.51).outcome, Outcome::fail);
    }
    EXPECT_EQ(check_at(strength, 0.31).text,
              std::string("Specimens differ by 0 % in modulus and 31 % in strength (standard "
                          "deviations) beyond noise, scatter and the model's own randomness: are "
                          "they of one kind?") +
                  (failed ? "" : " The intervals include it."));
    EXPECT_THAT(check_at(modulus, 0.51).text,
                EndsWith("no model of one bone describes them. Are tests, sizes or angles "
                         "exchanged?"));
  }
}

TEST(Verdict, SaysThatTwoSpecimensWithoutAnIntervalTellNoSpread) {
  const Study study = test::synthetic_study({0.0});
  const Check check = check_specimen_spread(make_problem(study), {});
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_EQ(check.text,
            "Fewer than three specimens: how much they differ beyond noise is not told. Test "
            "more.");
}

TEST(Verdict, LooksForToesInThreeTestsOfAModulusWithAnInterval) {
  Study study = test::synthetic_study({0.0, 0.0});
  study.calibrate.parameters = {"young_GPa"};
  Answer answer;
  EXPECT_EQ(check_toe(make_problem(study), answer).text, "Not checked: young_GPa has no interval.");
  answer.active = {0};
  answer.uncertainty.half_width = Eigen::VectorXd::Constant(1, 0.01);
  EXPECT_TRUE(check_toe(make_problem(study), answer).done);
  study.specimens.resize(2);
  EXPECT_EQ(check_toe(make_problem(study), answer).text,
            "Not checked: it takes three tests with rows enough.");
  EXPECT_FALSE(check_toe(make_problem(study), answer).done);
}

// Bounds alone give an interval of 95 % of their range.
TEST(Verdict, FailsWhereAnIntervalCoversNearlyAllOfItsBounds) {
  EndedSearch search;
  const Unknown& unknown = search.problem.unknowns.front();
  search.result.parameters = {{.name = "young_GPa", .identifiable = true}};
  const auto check_at = [&](double part) {
    const double below = 0.5 * (1.0 - part) * unknown.range();
    search.result.parameters[0].interval_95 = {from_search(*unknown.info, unknown.lower + below),
                                               from_search(*unknown.info, unknown.upper - below)};
    return check_identifiable(search.problem, search.answer, search.result);
  };
  EXPECT_EQ(check_at(0.49).text, "The specimens inform every parameter asked for.");
  EXPECT_EQ(check_at(0.49).outcome, Outcome::pass);
  EXPECT_EQ(check_at(0.51).outcome, Outcome::warn);
  EXPECT_EQ(check_at(0.89).outcome, Outcome::warn);
  EXPECT_EQ(check_at(0.89).text,
            "The 95 % interval of young_GPa covers 89 % of the range of its bounds in logarithms, "
            "which tell much of it.");
  EXPECT_EQ(check_at(0.91).outcome, Outcome::fail);
  EXPECT_THAT(check_at(0.91).text,
              EndsWith("hardly less than without any test: its value is not known."));
}

// Its test counts in the fit; beside one that the fit has not seen it counts for nothing.
TEST(Verdict, LeavesOutAHeldOutTestThatTheFitHasSeen) {
  Study study = test::synthetic_study({0.0});
  study.specimens[1].test = study.specimens[0].test;
  const FitProblem problem = make_problem(study);
  EXPECT_THAT(check_records(problem).text,
              testing::HasSubstr("and intervals are too narrow. Give"));
  study.specimens[1].use = Use::validate;
  EXPECT_EQ(check_records(problem).outcome, Outcome::warn);
  EXPECT_EQ(check_records(problem).text,
            "The records of S1 and S2 are the same, number for number: a fit that has seen a test "
            "is not tested by it, and \"held-out specimens\" leaves it out. Give each specimen its "
            "own file, or leave one out.");
  CalibrationResult result;
  for (const Specimen& specimen : study.specimens)
    result.specimens.push_back({.id = specimen.id, .use = specimen.use, .measured = specimen.test});
  EXPECT_FALSE(check_validation(result, {}).done);
  EXPECT_EQ(check_validation(result, {}).text,
            "Not checked: the fit has seen every test that was kept for validation.");
  result.specimens[1].measured.max_force += 1.0;
  EXPECT_THAT(check_validation(result, {}).text, testing::HasSubstr("1 held-out specimen lies"));
}

// (F12) What lies at a bound follows nothing, fitted or not.
TEST(Verdict, LetsWhatIsLeftOutAtABoundFollowNothing) {
  EndedSearch search;
  Answer& answer = search.answer;
  answer.best.residuals = Eigen::Vector3d(1.0, 2.0, 3.0);
  answer.active = {0};
  answer.asked = {Eigen::MatrixXd::Identity(3, 2), {0, 1}};
  const Eigen::VectorXd factor = Eigen::VectorXd::Ones(3);
  EXPECT_NEAR(unfollowed(search.problem, answer, factor).residuals.norm(), 3.0, 1e-12);
  answer.best.point[1] = search.problem.unknown(1).upper;
  EXPECT_NEAR(unfollowed(search.problem, answer, factor).residuals.norm(), std::sqrt(13.0), 1e-12);
}

}  // namespace
}  // namespace havers::calib
