// Every check of the verdict says yes and no where it should, in words.
#include <gtest/gtest.h>

#include <cmath>

#include "calib/fit/answer.hpp"
#include "calib/fit/calibrate.hpp"
#include "calib/fit/parameter_checks.hpp"
#include "tests/support/slow.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

using test::check_of;
using test::says;

// A metal: strength 500 MPa, 210 GPa, breaks at 12 %.
MeasuredTest ductile_test(double modulus) {
  MeasuredTest test;
  test.modulus = modulus;
  test.modulus_standard_error = 1e-3 * modulus;
  test.strength = 500e6;
  test.strength_standard_error = 1e5;
  test.failure_strain = 0.12;
  for (int i = 0; i <= 1000; ++i) {
    const double strain = 0.12 * i / 1000;
    test.strain.push_back(strain);
    test.stress.push_back(500e6 * std::tanh(modulus * strain / 500e6));
  }
  return test;
}

TEST(Verdict, PassesAModelThatIsTrue) {
  for (const auto& check : test::fit(test::synthetic_study(test::three_orientations)).verdict)
    EXPECT_EQ(check.outcome, Outcome::pass) << check.check << ": " << check.text;
}

// What a specimen tells does not depend on how narrow the bounds are that it is to lie in.
TEST(Verdict, SaysThatAParameterIsPressedAgainstANarrowBound) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.bounds["young_GPa"] = {14.5, 14.6};
  const auto result = test::fit(study);
  EXPECT_TRUE(test::parameter_of(result, "young_GPa").at_bound);
  EXPECT_EQ(check_of(result, "inside bounds").outcome, Outcome::fail);
  EXPECT_FALSE(result.trusted());
}

TEST(Verdict, GivesChiSquaredOfSpecimensThatWereAlike) {
  const auto alike = check_of(test::fit(test::synthetic_study(test::three_orientations)),
                              "spread between specimens");
  EXPECT_TRUE(says(alike, "15 degrees of freedom")) << alike.text;
  const auto unlike =
      check_of(test::fit(test::synthetic_study(test::three_orientations, {.specimen_effect = 0.1})),
               "spread between specimens");
  EXPECT_TRUE(says(unlike, "(p < 1e-6)")) << unlike.text;
}

TEST(Verdict, RejectsTheModelWhereCurvesAreNotBrittle) {
  auto study = test::synthetic_study({0.0, 0.0, 0.0, 0.0, 0.0});
  for (std::size_t s = 0; s < study.specimens.size(); ++s)
    study.specimens[s].test = ductile_test(1e9 * (205.0 + static_cast<double>(s)));
  const auto result = test::fit(study);
  const auto check = check_of(result, "brittle");
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_TRUE(says(check, "These curves are not brittle"));
  EXPECT_TRUE(says(check, "The model is rejected"));
  EXPECT_EQ(check_of(result, "inside bounds").outcome, Outcome::fail);  // 210 GPa is no bone
  EXPECT_FALSE(result.trusted());
}

// Compact bone does not stiffen on its way to the break (X10); neither does the model.
TEST(Verdict, WarnsWhereCurvesStiffenAsWhereTheyBend) {
  auto study = test::synthetic_study(test::three_orientations);
  const auto outcome_at = [&](double part) {
    for (auto& specimen : study.specimens) {
      const double straight = specimen.test.strength / specimen.test.modulus;
      specimen.test.failure_strain = straight / part;
    }
    return check_of(test::fit(study), "brittle");
  };
  EXPECT_EQ(outcome_at(0.98).outcome, Outcome::pass);
  EXPECT_EQ(outcome_at(1.02).outcome, Outcome::pass);
  const auto bent = outcome_at(0.94);
  EXPECT_TRUE(says(bent, "bend before they break"));
  EXPECT_EQ(bent.outcome, Outcome::warn);
  const auto stiffer = outcome_at(1.06);
  EXPECT_EQ(stiffer.outcome, Outcome::warn);
  EXPECT_TRUE(says(stiffer, "stiffen before they break")) << stiffer.text;
  EXPECT_EQ(outcome_at(1.2).outcome, Outcome::fail);
}

// As joints of large scatter make them: the tests are as straight as a ruler.
TEST(Verdict, SaysThatTheModelBendsWhereTheTestsAreStraight) {
  const auto study = test::synthetic_study(test::three_orientations);
  const auto check_at = [&](double linearity) {
    const auto simulator = test::altered([linearity](Response& response, const sim::Scene&) {
      response.failure_strain /= linearity;
      response.strain = {0.0, response.failure_strain, response.failure_strain};
    });
    return check_of(calibrate_with(simulator, study), "brittle");
  };
  const auto half = check_at(0.5), little = check_at(0.94);
  EXPECT_EQ(half.outcome, Outcome::fail);
  EXPECT_TRUE(says(half, "The tests are brittle, and the model's curves are not brittle"))
      << half.text;
  EXPECT_EQ(little.outcome, Outcome::warn);
  EXPECT_TRUE(says(little, "The model's curves bend before they break"));
}

// Neither is straight, and nothing says that they are.
TEST(Verdict, CallsNoCurvesStraightThatBendAlike) {
  auto study = test::synthetic_study(test::three_orientations);
  for (auto& specimen : study.specimens) specimen.test.failure_strain /= 0.85;
  const auto simulator = test::altered([](Response& response, const sim::Scene&) {
    response.failure_strain /= 0.85;
    response.strain = {0.0, response.failure_strain, response.failure_strain};
  });
  const auto check = check_of(calibrate_with(simulator, study), "brittle");
  EXPECT_EQ(check.outcome, Outcome::pass);
  EXPECT_TRUE(says(check,
                   "cannot be told apart: strength / (modulus × failure strain) is 0.85 in "
                   "the tests and 0.85 in the model. Tests 10 % below the model would"))
      << check.text;
}

TEST(Verdict, LeavesCurvesUncheckedWhereNoTestBroke) {
  auto study = test::synthetic_study({0.0});
  for (auto& specimen : study.specimens) specimen.broke = false;
  const auto result = test::fit(study);
  EXPECT_TRUE(test::parameter_of(result, "young_GPa").identifiable);
  const auto check = check_of(result, "brittle");
  EXPECT_EQ(check.outcome, Outcome::pass);
  EXPECT_FALSE(check.done);
  EXPECT_EQ(check.text, "Not checked: no test broke, or no simulation.");
}

TEST(Verdict, ComparesOrientationsOnlyWhereItCan) {
  const auto one = check_of(test::fit(test::synthetic_study({0.0, 0.0})), "residuals unstructured");
  EXPECT_EQ(one.outcome, Outcome::pass);
  EXPECT_FALSE(one.done);
  EXPECT_TRUE(says(one, "Not checked: ")) << one.text;
  // Two parameters make up for two strengths, none for two moduli.
  auto study = test::synthetic_study({0.0, 45.0});
  const auto two = check_of(test::fit(study), "residuals unstructured");
  EXPECT_TRUE(two.done);
  EXPECT_TRUE(says(two, "(modulus: p = 0.")) << two.text;
  EXPECT_TRUE(says(two, "strength: too few to tell)")) << two.text;
  for (auto& specimen : study.specimens)
    if (specimen.orientation > 0.1)
      specimen.test = test::straight_test(0.7 * specimen.test.modulus, specimen.test.strength);
  EXPECT_EQ(check_of(test::fit(study), "residuals unstructured").outcome, Outcome::fail);
}

// The scouts' weights know of no difference between specimens: in them these ends are far apart.
TEST(Verdict, ComparesEndsByTheWeightsOfTheAnswer) {
  auto study = test::synthetic_study({0.0, 0.0, 90.0}, {.specimen_effect = 0.2});
  for (const auto& [name, value] : {std::pair("young_GPa", 14.0), std::pair("head_tail_MPa", 60.0)})
    apply(study.model, name, value);
  const FitProblem problem = make_problem(study);
  const auto simulator = test::ClosedForm{}.simulator();
  SimulationBatch batch(simulator, nullptr, 1);
  Answer answer;
  const auto end_at = [&](double shift) {
    const Point moved = start_point(problem.unknowns).array() + shift;
    auto end = predict(problem, batch, {moved}, 3).front();
    const std::vector<Landmarks> none(problem.models.size(), Landmarks(Landmarks::Zero()));
    score(problem, weigh(problem, end, none, Landmarks::Zero()), end);
    answer.weights = weigh(problem, end, none, Landmarks(Landmarks::Constant(0.2)));
    return end;
  };
  const auto verdict = [&] {
    CalibrationResult result;
    result.verdict = verdict_of(problem, answer, result);
    return check_of(result, "starts agree");
  };
  answer.active = {0, 1};
  answer.uncertainty.half_width = Eigen::VectorXd::Constant(2, 0.1);
  answer.best = end_at(0.0);
  answer.ends = {answer.best, end_at(0.01)};
  EXPECT_GT(std::abs(answer.ends[1].cost - answer.ends[0].cost), 0.5);
  EXPECT_EQ(verdict().text, "2 of 2 starts came to the same point.");
  answer.uncertainty.half_width.setZero();
  answer.ends = {answer.best, end_at(0.024)};
  EXPECT_TRUE(says(verdict(), "1 of 2 starts ends at another point")) << verdict().text;
  answer.ends = {answer.best, end_at(1.0)};
  EXPECT_TRUE(says(verdict(), "Only one of 2 starts reached the lowest cost")) << verdict().text;
}

TEST(Verdict, SaysWhichParameterLiesAtABound) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.bounds["young_GPa"] = {5.0, 12.0};
  const auto check = check_of(test::fit(study), "inside bounds");
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_TRUE(says(check, "young_GPa = 12 of [5, 12]"));
}

TEST(Verdict, WarnsOfWhatIsLeftOutWhereTheFitRanIntoABound) {
  const FitProblem problem = make_problem(test::synthetic_study(test::three_orientations));
  const Unknown& last = problem.unknowns.back();
  const auto index = static_cast<Eigen::Index>(problem.unknowns.size()) - 1;
  Answer answer;
  answer.best.point = start_point(problem.unknowns);
  answer.left = {{index, "a reason"}};
  answer.left[0].kept_where_found = true;
  EXPECT_EQ(check_bounds(problem, answer, {}).outcome, Outcome::pass);
  answer.best.point[index] = last.upper;
  const Check check = check_bounds(problem, answer, {});
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_TRUE(says(check, "but " + last.label + ", left out, was found at one")) << check.text;
  answer.left[0].kept_where_found = false;  // the study's own value
  EXPECT_EQ(check_bounds(problem, answer, {}).outcome, Outcome::pass);
}

TEST(Verdict, SeesAModulusThatDiffersBetweenOrientations) {
  auto study = test::synthetic_study(test::three_orientations);
  for (const std::size_t s : {4U, 5U}) {
    auto& test = study.specimens[s].test;
    test = test::straight_test(0.7 * test.modulus, test.strength);
  }
  const auto check = check_of(test::fit(study), "residuals unstructured");
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_TRUE(says(check, "young_GPa = \"orientation\""));
  EXPECT_TRUE(says(check, "(p < 1e-6)") || says(check, "(p = 0.00")) << check.text;
}

// A spread between specimens that chance gave moves the answer off the strengths that are known
// best: that is no misfit. Of 40 true models 2 were rejected.
TEST(Verdict, RejectsStrengthsThatDifferBetweenOrientationsAndNoneOfATrueModel) {
  HAVERS_SLOW;
  int of_true = 0, of_false = 0;
  const auto rejected = [](const Study& study) {
    const auto check = check_of(test::fit(study), "residuals unstructured");
    return check.outcome == Outcome::fail ? 1 : 0;
  };
  for (unsigned draw = 1; draw <= 40; ++draw) {
    Study study = test::unequally_known_study(draw);
    of_true += rejected(study);
    if (draw > 10) continue;
    for (const std::size_t s : {4U, 5U}) {
      auto& test = study.specimens[s].test;
      test = test::straight_test(test.modulus, 2.5 * test.strength);
    }
    of_false += rejected(study);
  }
  EXPECT_EQ(of_true, 0);
  EXPECT_GE(of_false, 8);
}

TEST(Verdict, SaysThatSimulationsDoNotBreak) {
  auto study = test::synthetic_study(test::three_orientations);
  study.model.loading.max_strain = 1e-4;
  const auto check = check_of(test::fit(study), "simulations break");
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_TRUE(says(check, "loading.max_strain"));
}

TEST(Verdict, CountsFailedSimulations) {
  const auto simulator = test::altered([](Response& response, const sim::Scene& scene) {
    response.failed = scene.joints.seed % 10 < 3;
  });
  const auto result = calibrate_with(simulator, test::synthetic_study(test::three_orientations));
  EXPECT_EQ(check_of(result, "simulations").outcome, Outcome::fail);
}

}  // namespace
}  // namespace havers::calib
