// What the verdict says of single specimens, of their spread and of those held out.
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "calib/fit/answer.hpp"
#include "calib/fit/answer_checks.hpp"
#include "calib/fit/calibrate.hpp"
#include "calib/fit/model_checks.hpp"
#include "calib/synthetic/known_study.hpp"
#include "tests/support/slow.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

using test::check_of;
using test::says;

TEST(Verdict, RejectsSpecimensThatDifferByMoreThanHalf) {
  auto study = test::synthetic_study(test::three_orientations);
  std::swap(study.specimens[0].test, study.specimens[4].test);  // one along, one across
  const auto check = check_of(test::fit(study), "spread between specimens");
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_TRUE(says(check, "exchanged?")) << check.text;
  EXPECT_TRUE(says(check, ": they are not.")) << check.text;
  EXPECT_FALSE(says(check, "rejects nothing")) << check.text;
}

// Equal weights of a specimen effect pull the answer off the moduli known best, and four replicates
// hardly know the variance of strengths: neither is a difference of specimens.
TEST(Verdict, SeldomSaysThatSpecimensThatAreAlikeAreNot) {
  HAVERS_SLOW;
  for (const int number : {15, 57}) {
    auto known = known_study(three_orientations(), number);
    known.study.calibrate.threads = 1;
    known.study.calibrate.profiles = false;
    const auto check = check_of(calibrate(known.study), "spread between specimens");
    EXPECT_TRUE(says(check, "Were they alike, χ² would be ")) << number << ": " << check.text;
    EXPECT_FALSE(says(check, "they are not")) << number << ": " << check.text;
  }
}

TEST(Verdict, SaysThatAsManyParametersAsStrengthsLeaveNoSpread) {
  auto study = test::synthetic_study({0.0, 0.0}, {.specimen_effect = 0.1});
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  study.calibrate.level["head_tail_MPa"] = Level::specimen;
  const auto check = check_of(test::fit(study), "spread between specimens");
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_TRUE(says(check, "% in modulus (standard deviations) beyond noise")) << check.text;
  EXPECT_FALSE(says(check, "% in strength")) << check.text;
  EXPECT_TRUE(says(check,
                   "4 strengths for 4 parameters: whether specimens differ in strength cannot be "
                   "told, and the intervals do not include it."))
      << check.text;
  study.calibrate.terms = {"strength"};
  study.calibrate.parameters = {"head_tail_MPa"};
  const auto alone = check_of(test::fit(study), "spread between specimens").text;
  EXPECT_TRUE(alone.starts_with("4 strengths for 4 parameters")) << alone;
  study.calibrate.terms = {"failure strain"};
  const FitProblem problem = make_problem(study);
  EXPECT_FALSE(check_specimen_spread(problem, {}).done);
}

// One difference each tells the spread that makes the intervals, and hardly tells it.
TEST(Verdict, SaysThatTwoSpecimensHardlyShowTheirSpread) {
  auto study = test::synthetic_study({0.0}, {.specimen_effect = 0.2});
  study.calibrate.bounds["head_tail_MPa"] = {20.0, 200.0};
  const auto result = test::fit(study);
  EXPECT_GT(result.specimen_effect[strength], 0.01);
  const auto check = check_of(result, "spread between specimens");
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_TRUE(says(check, "the intervals include it, as far as so few tell it.")) << check.text;
  EXPECT_THAT(check.text, testing::EndsWith(" Test more."));
  const auto identifiable = check_of(result, "identifiable");
  EXPECT_EQ(identifiable.outcome, Outcome::fail);
  EXPECT_TRUE(says(identifiable, "The 95 % interval of head_tail_MPa covers "))
      << identifiable.text;
}

TEST(Verdict, WarnsOfAnIntervalThatCoversMostOfItsBounds) {
  auto study = test::synthetic_study({0.0}, {.specimen_effect = 0.2});
  study.calibrate.parameters = {"head_tail_MPa"};
  study.calibrate.bounds["head_tail_MPa"] = {1.0, 500.0};
  const auto check = check_of(test::fit(study), "identifiable");
  EXPECT_EQ(check.outcome, Outcome::warn) << check.text;
  EXPECT_THAT(check.text, testing::StartsWith("The 95 % interval of head_tail_MPa covers "));
}

// Residuals that no parameter could move have no level to be given.
TEST(Verdict, AsksForTheParameterThatWouldMoveWhatIsOff) {
  auto study = test::synthetic_study(test::three_orientations);
  const auto off = [&](std::vector<std::string> parameters) {
    study.calibrate.parameters = std::move(parameters);
    return check_of(test::fit(study), "residuals unstructured");
  };
  for (const auto& without_modulus :
       {std::vector<std::string>{"head_tail_MPa", "ratio"}, std::vector<std::string>{"poisson"}}) {
    const auto check = off(without_modulus);
    EXPECT_EQ(check.outcome, Outcome::fail);
    EXPECT_FALSE(says(check, "calibrate.level")) << check.text;
    EXPECT_TRUE(says(check, "young_GPa is not fitted: add it")) << check.text;
  }
  const auto strengths = off({"young_GPa"});
  EXPECT_EQ(strengths.outcome, Outcome::fail);
  EXPECT_TRUE(says(strengths, "add head_tail_MPa")) << strengths.text;
}

// A crosshead's strain has the machine in it, which no residual shows.
TEST(Verdict, WarnsOfAModulusWithTheMachineInIt) {
  auto study = test::synthetic_study(test::three_orientations);
  const auto check = [&] { return check_of(test::fit(study), "strain of bone alone"); };
  EXPECT_EQ(check().outcome, Outcome::pass);
  study.specimens[1].test.machine_in_strain = true;
  const auto crosshead = check();
  EXPECT_EQ(crosshead.outcome, Outcome::warn);
  EXPECT_THAT(crosshead.text, testing::StartsWith("The strain of S2 is the crosshead's"));
  EXPECT_THAT(crosshead.text, testing::HasSubstr("machine_compliance_mm_per_kN"));
  study.specimens[1].use = Use::validate;
  EXPECT_EQ(check().outcome, Outcome::pass);
  study.calibrate.parameters = {"head_tail_MPa"};
  EXPECT_FALSE(check().done);
}

TEST(Verdict, SaysWhyNothingWasConfirmedInTime) {
  auto study = test::synthetic_study(test::three_orientations);
  const FitProblem problem = make_problem(study);
  EXPECT_TRUE(
      says(check_confirmation(problem, {}), "not asked for; calibrate.options.confirm = 3"));
  study.calibrate.confirm = 1;
  EXPECT_TRUE(says(check_confirmation(problem, {}), "no parameter was fitted"));
  CalibrationResult result;
  result.fitted = {"young_GPa"};
  EXPECT_TRUE(says(check_confirmation(problem, result), "step by step in time anyhow"));
}

TEST(Verdict, SaysThatAHeldOutSpecimenIsOff) {
  auto study = test::synthetic_study(test::three_orientations);
  study.specimens[0].use = Use::validate;
  const auto fitted = test::fit(study);
  EXPECT_EQ(check_of(fitted, "held-out specimens").outcome, Outcome::pass);
  EXPECT_FALSE(says(check_of(fitted, "held-out specimens"), "Not checked"));
  EXPECT_TRUE(says(check_of(fitted, "confirmed in time"), "Not checked: "));
  EXPECT_TRUE(says(check_validation({}, {}), "Not checked: "));
  EXPECT_FALSE(check_validation({}, {}).done);
  EXPECT_TRUE(check_of(fitted, "held-out specimens").done);
  study.specimens[0].test = test::straight_test(14e9, 90e6);
  const auto check = check_of(test::fit(study), "held-out specimens");
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_TRUE(says(check, "S1"));
}

// Along the fibres the ratio shows nothing; at 45 degrees the study's value of it does not predict.
TEST(Verdict, FailsAHeldOutSpecimenWhateverIsLeftOut) {
  auto study = test::synthetic_study({0.0, 45.0});
  for (const std::size_t s : {2U, 3U}) study.specimens[s].use = Use::validate;
  const auto result = test::fit(study);
  ASSERT_FALSE(test::parameter_of(result, "ratio").identifiable);
  const auto check = check_of(result, "held-out specimens");
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_FALSE(result.trusted());
  EXPECT_TRUE(says(check, "off by more than three standard deviations: S3 (")) << check.text;
  EXPECT_TRUE(says(check, "because what is left out (ratio) has another value")) << check.text;
  study.calibrate.automatic = true;  // what that leaves out the study knows
  EXPECT_TRUE(says(check_of(test::fit(study), "held-out specimens"), "do not carry over"));
}

// Of a strength among those of the replicates the failure strain is the same number.
TEST(Verdict, ExcusesAHeldOutSpecimenAmongItsReplicates) {
  CalibrationResult result;
  SpecimenResult& specimen = result.specimens.emplace_back();
  specimen.id = "V1";
  specimen.use = Use::validate;
  for (const double strength : {50e6, 51e6, 63e6})
    specimen.replicates.push_back(
        {.failed = false, .broke = true, .strength = strength, .failure_strain = strength / 14e9});
  specimen.measured.strength = 62e6;
  specimen.measured.failure_strain = 62e6 / 14e9;
  specimen.residual = {0.1, -4.4, -4.3};
  EXPECT_EQ(check_validation(result, {}).outcome, Outcome::pass);
  specimen.residual[0] = 4.0;
  EXPECT_EQ(check_validation(result, {}).outcome, Outcome::fail) << "by its modulus";
  specimen.residual[0] = 0.1;
  specimen.measured.failure_strain = 70e6 / 14e9;
  EXPECT_EQ(check_validation(result, {}).outcome, Outcome::fail) << "a strain larger than any";
  specimen.measured.failure_strain = 62e6 / 14e9;
  specimen.measured.strength = 64e6;
  EXPECT_EQ(check_validation(result, {}).outcome, Outcome::fail) << "stronger than any";
}

// One that is held has followed nothing.
TEST(Verdict, CountsAParameterAtItsBoundAsHeld) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  apply(study.model, "ratio", 2.0);
  study.calibrate.bounds["head_tail_MPa"] = {10.0, 30.0};
  const auto spread = check_of(test::fit(study), "spread between specimens");
  EXPECT_TRUE(says(spread, "(p < 1e-6)")) << spread.text;
}

TEST(Verdict, ComparesAHeldOutSpecimenByTheTermsThereAre) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.parameters = {"head_tail_MPa", "ratio"};
  study.calibrate.terms = {"strength", "failure strain"};
  study.specimens[0].use = Use::validate;
  const auto held_out = check_of(test::fit(study), "held-out specimens");
  EXPECT_EQ(held_out.outcome, Outcome::pass) << held_out.text;
  study.specimens[0].test.modulus = std::nan("");
  const auto useless = check_of(test::fit(study), "held-out specimens");
  EXPECT_EQ(useless.outcome, Outcome::fail);
  EXPECT_EQ(useless.text,
            "Nothing can be compared of held-out specimens whose simulations failed or did not "
            "break, or whose tests tell too little: S1.");
}

TEST(Verdict, TellsHeldOutSpecimensThatAreOffFromThoseThatNothingIsComparedWith) {
  CalibrationResult result;
  const double none = std::nan("");
  result.specimens = {{.id = "B1", .use = Use::validate, .residual = {1.0, 4.0, none}},
                      {.id = "B2", .use = Use::validate, .residual = {none, none, none}}};
  const auto check = check_validation(result, {});
  EXPECT_EQ(check.outcome, Outcome::fail);
  EXPECT_TRUE(says(check, "more than three standard deviations: B1 (4.0). ")) << check.text;
  EXPECT_THAT(check.text, testing::EndsWith(" B2."));
}

// One step from the answer knows no bounds, and every third strength of a draw may be missing.
TEST(Verdict, SaysWhereTheBootstrapIsWiderAndKeepsItInsideTheBounds) {
  auto study = test::synthetic_study(test::three_orientations, {.specimen_effect = 0.1});
  study.calibrate.bounds["ratio"] = {1.5, 2.5};
  auto result = test::fit(study);
  const auto ratio = test::parameter_of(result, "ratio");
  ASSERT_TRUE(ratio.bootstrap_missing.empty()) << ratio.bootstrap_missing;
  EXPECT_GE(ratio.bootstrap_95[0], 1.5);
  EXPECT_LE(ratio.bootstrap_95[1], 2.5);
  EXPECT_TRUE(ratio.bootstrap_95[0] == 1.5 || ratio.bootstrap_95[1] == 2.5);

  const FitProblem problem = make_problem(study);
  auto& parameter = result.parameters.front();
  parameter.bootstrap_95 = parameter.interval_95;
  EXPECT_FALSE(says(check_intervals(problem, result), "young_GPa ("));
  parameter.bootstrap_95[1] *= parameter.interval_95[1] / parameter.interval_95[0];
  EXPECT_TRUE(says(check_intervals(problem, result), "young_GPa (2 times as wide in logarithms)"));
}

TEST(Verdict, NamesEverySpecimenThatAloneDeterminesAParameter) {
  CalibrationResult result;
  result.fitted = {"young_GPa", "ratio"};
  for (const char* id : {"A10", "A1"})
    result.specimens.push_back(
        {.id = id, .influence = {{"young_GPa", std::nan("")}, {"ratio", std::nan("")}}});
  const auto check = check_influence(result);
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_TRUE(says(check, "Without any one of A10, A1 the parameters")) << check.text;
}

// A file copied under another name, given to a second specimen.
TEST(Verdict, WarnsOfSpecimensWithTheSameRecord) {
  Study study = test::synthetic_study(test::three_orientations);
  for (std::size_t s = 0; s < study.specimens.size(); ++s) {
    study.specimens[s].test.strain = {0.0, 1e-3, 2e-3};
    study.specimens[s].test.max_force = 100.0 + static_cast<double>(s);
  }
  const auto check = [&] { return check_of(test::fit(study), "every test once"); };
  EXPECT_EQ(check().outcome, Outcome::pass);
  study.specimens[3].test = study.specimens[1].test;
  study.specimens[3].use = Use::validate;
  EXPECT_EQ(check().outcome, Outcome::warn);
  EXPECT_TRUE(says(check(), "The records of S2 and S4 are the same, number for number"));
}

}  // namespace
}  // namespace havers::calib
