// What is said of the answer after it is found: other intervals, other specimens, other seeds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/fit/answer_checks.hpp"
#include "calib/fit/calibrate.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

double log_width(const std::array<double, 2>& interval) {
  return std::log(interval[1] / interval[0]);
}

// The law is a product of powers, so that in logarithms the cost is a parabola.
TEST(Hindsight, ProfilesAgreeWithTheSlopesWhereTheCostIsAParabola) {
  const auto result = test::fit(test::synthetic_study(test::three_orientations));
  ASSERT_EQ(result.profiles.size(), 3U);
  for (const char* name : {"young_GPa", "head_tail_MPa"}) {
    const auto parameter = test::parameter_of(result, name);
    EXPECT_TRUE(parameter.profile_missing.empty()) << parameter.profile_missing;
    EXPECT_NEAR(log_width(parameter.profile_95) / log_width(parameter.slopes_95), 1.0, 0.1) << name;
    EXPECT_EQ(parameter.interval_95, parameter.profile_95) << name;
  }
  for (const auto& profile : result.profiles) {
    EXPECT_EQ(profile.value.size(), 5U);
    EXPECT_GT(profile.rise.front(), 0.5 * profile.level);
    EXPECT_EQ(profile.rise[2], 0.0);
  }
}

TEST(Hindsight, NoProfileIsMadeThatWasNotAskedFor) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.profiles = false;
  const auto result = test::fit(study);
  EXPECT_TRUE(result.profiles.empty());
  EXPECT_FALSE(test::parameter_of(result, "ratio").profile_missing.empty());
}

TEST(Hindsight, EndsIntervalsAtTheBoundsWithoutProfilesToo) {
  auto study = test::synthetic_study({0.0}, {.specimen_effect = 0.05});
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  study.calibrate.bounds["head_tail_MPa"] = {50.0, 80.0};
  study.calibrate.profiles = false;
  const auto parameter = test::parameter_of(test::fit(study), "head_tail_MPa");
  EXPECT_LT(parameter.slopes_95[0], 50.0);
  EXPECT_EQ(parameter.interval_95[0], 50.0);
}

TEST(Hindsight, BootstrapIntervalsAreLikeTheOthersOrSayWhyTheyAreMissing) {
  auto study = test::synthetic_study({0.0, 0.0, 0.0, 45.0, 45.0, 45.0, 90.0, 90.0, 90.0},
                                     {.specimen_effect = 0.05});
  const auto many = test::parameter_of(test::fit(study), "young_GPa");
  ASSERT_TRUE(many.bootstrap_missing.empty()) << many.bootstrap_missing;
  EXPECT_NEAR(log_width(many.bootstrap_95) / log_width(many.interval_95), 1.0, 0.4);
  const auto few = test::parameter_of(test::fit(test::synthetic_study({0.0})), "young_GPa");
  EXPECT_NE(few.bootstrap_missing.find("too few"), std::string::npos);
  EXPECT_TRUE(std::isnan(few.bootstrap_95[0]));
}

// One step with the slopes says what a fit without the specimen finds.
TEST(Hindsight, TellsHowTheAnswerMovesWithoutASpecimen) {
  const auto study = test::synthetic_study(test::three_orientations, {.specimen_effect = 0.05});
  const auto whole = test::fit(study);
  auto rest = study;
  rest.specimens[1].use = Use::validate;
  const auto without = test::parameter_of(test::fit(rest), "young_GPa");
  const auto with = test::parameter_of(whole, "young_GPa");
  ASSERT_EQ(whole.specimens[1].influence.front().parameter, "young_GPa");
  EXPECT_NEAR(whole.specimens[1].influence.front().shift,
              (without.value - with.value) / with.standard_error, 0.3);
}

// The answer is the mean of log E: without one of n specimens it is that of the others.
TEST(Hindsight, TellsExactlyHowOneMeanMovesWithoutASpecimen) {
  for (const auto& degrees : {std::vector{0.0}, test::three_orientations}) {
    auto study = test::synthetic_study(degrees, {.specimen_effect = 0.05});
    study.calibrate.parameters = {"young_GPa"};
    study.calibrate.terms = {"modulus"};
    const auto result = test::fit(study);
    const auto young = test::parameter_of(result, "young_GPa");
    for (const auto& specimen : result.specimens) {
      const double above = std::log(specimen.measured.modulus / (1e9 * young.value));
      const double exact = -above / (static_cast<double>(result.specimens.size()) - 1.0);
      EXPECT_NEAR(specimen.influence.front().shift * young.standard_error / young.value / exact,
                  1.0, 0.01);
    }
  }
}

// Not the weights, the draws of the bootstrap, nor the specimen that a further test is made from.
TEST(Hindsight, IsTheSameForSpecimensInAnyOrder) {
  auto study = test::synthetic_study({0.0, 45.0}, {.specimen_effect = 0.05});
  study.specimens.push_back(study.specimens.front());
  study.specimens.back().id = "A1";
  study.specimens.back().test.modulus_standard_error *= 20.0;
  for (auto& specimen : study.specimens) specimen.test.strain_rate = 1e-3;
  const auto one = test::fit(study);
  std::ranges::reverse(study.specimens);
  const auto other = test::fit(study);
  ASSERT_EQ(one.next_tests.size(), 4U);
  ASSERT_EQ(other.next_tests.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(one.next_tests[i].what, other.next_tests[i].what);
    EXPECT_EQ(one.next_tests[i].width, other.next_tests[i].width) << one.next_tests[i].what;
  }
  for (const char* name : {"young_GPa", "head_tail_MPa", "ratio"}) {
    const auto here = test::parameter_of(one, name), there = test::parameter_of(other, name);
    EXPECT_TRUE(here.bootstrap_missing.empty());
    EXPECT_EQ(here.value, there.value) << name;
    EXPECT_EQ(here.interval_95, there.interval_95) << name;
    EXPECT_EQ(here.bootstrap_95, there.bootstrap_95) << name;
  }
}

TEST(Hindsight, SaysInWordsWhatIsDetermined) {
  const auto result = test::fit(test::synthetic_study(test::three_orientations));
  ASSERT_EQ(result.directions.size(), 4U);
  EXPECT_EQ(result.directions[0], "The specimens determine 3 of 3 directions.");
  EXPECT_THAT(result.directions[1], testing::EndsWith(" % (one standard error)."));
  ASSERT_EQ(result.correlation.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(result.correlation[i][i], 1.0, 1e-12);
  EXPECT_NEAR(result.correlation[0][1], result.correlation[1][0], 1e-12);
}

// The closed form's noise is a factor of the seed alone: common seeds cancel it altogether.
TEST(Hindsight, LooksAtTheAnswerWithFreshSeeds) {
  const auto result = test::fit(test::synthetic_study(test::three_orientations));
  EXPECT_TRUE(std::isinf(result.randomness.common_gain));
  EXPECT_GT(result.randomness.fresh_shift, 0.0);
  EXPECT_LT(result.randomness.fresh_shift, 1.5);
  EXPECT_GT(result.randomness.simulator_share, 0.0);
  EXPECT_LT(result.randomness.simulator_share, 0.5);
  EXPECT_NEAR(std::log(result.randomness.fresh_width), 0.0, std::log(3.0));
}

TEST(Hindsight, WarnsWhereFreshSeedsMakeOtherIntervals) {
  CalibrationResult result;
  result.fitted = {"young_GPa"};
  result.randomness = {.replicates = 8,
                       .replicates_needed = 4,
                       .simulator_share = 0.1,
                       .fresh_cost = 3.0,
                       .fresh_shift = 0.1};
  for (const auto& [width, outcome] : {std::pair(1.0, Outcome::pass),
                                       {1.9, Outcome::pass},
                                       {4.7, Outcome::warn},
                                       {0.2, Outcome::warn}}) {
    result.randomness.fresh_width = width;
    EXPECT_EQ(check_randomness(result).outcome, outcome) << width;
  }
}

// Seeds of each point's own: differences keep all of the noise, and the slopes are worse.
TEST(Hindsight, DoesWithoutCommonRandomNumbersAndSaysWhatThatCosts) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.common_seeds = false;
  const auto result = test::fit(study);
  EXPECT_GT(result.randomness.common_gain, 0.5);
  EXPECT_LT(result.randomness.common_gain, 2.0);
  EXPECT_NEAR(test::parameter_of(result, "head_tail_MPa").value, 60.0, 1.0);
}

TEST(Hindsight, TakesAsManyReplicatesAsItNeeds) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.replicates = replicates_by_need;
  const auto few = test::fit(study, {.noise = 1e-5});
  const auto many = test::fit(study, {.noise = 0.02});
  EXPECT_EQ(few.randomness.replicates, 4);
  EXPECT_GT(many.randomness.replicates, 8);
  EXPECT_NEAR(test::parameter_of(many, "head_tail_MPa").value, 60.0, 2.0);
}

// Strengths known to 10 %, but for that at which a test was stopped: it tells nothing.
TEST(Hindsight, NeedsNoReplicatesForABoundThatNothingContradicts) {
  auto study = test::synthetic_study(test::three_orientations);
  for (auto& specimen : study.specimens)
    specimen.test.strength_standard_error = 0.1 * specimen.test.strength;
  study.specimens.push_back(study.specimens[0]);
  study.specimens.back().id = "stopped";
  study.specimens.back().broke = false;
  study.specimens.back().test = test::straight_test(14e9, 25e6, 2e-3, 2e-3);
  EXPECT_EQ(test::fit(study, {.noise = 0.02}).randomness.replicates_needed, 4);
}

TEST(Hindsight, TermsAddUpToTheCost) {
  auto study = test::synthetic_study(test::three_orientations);
  for (const char* more : {"pre-peak curve", "energy", "post-peak drop"})
    study.calibrate.terms.emplace_back(more);
  const auto result = test::fit(study);
  double squares = 0.0, shares = 0.0;
  for (const auto& specimen : result.specimens) {
    EXPECT_EQ(specimen.terms.size(), 6U);
    EXPECT_EQ(specimen.replicates.size(), 8U);
    for (const auto& term : specimen.terms) {
      EXPECT_NEAR(std::pow(term.sd, 2),
                  std::pow(term.machine, 2) + std::pow(term.replicates, 2) +
                      std::pow(term.scatter, 2) + std::pow(term.specimens, 2),
                  1e-12);
      EXPECT_NEAR(term.residual, (term.simulated - term.measured) / term.sd, 1e-9);
      squares += std::pow(term.residual, 2);
      shares += term.share;
    }
  }
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_NEAR(0.5 * squares, result.cost, 1e-9 * result.cost);
}

// A test that was stopped at half its strength knows the modulus and a bound.
TEST(Hindsight, AStoppedTestIsABoundAndNoError) {
  auto study = test::synthetic_study(test::three_orientations);
  const auto whole = test::fit(study);
  study.specimens.push_back(study.specimens[0]);
  study.specimens.back().id = "stopped";
  study.specimens.back().broke = false;
  study.specimens.back().test = test::straight_test(14e9, 25e6, 2e-3, 2e-3);
  const auto result = test::fit(study);
  EXPECT_NEAR(test::parameter_of(result, "head_tail_MPa").value,
              test::parameter_of(whole, "head_tail_MPa").value, 0.2);
  ASSERT_EQ(result.specimens.back().terms.size(), 2U);
  EXPECT_EQ(result.specimens.back().terms[1].residual, 0.0);
  EXPECT_TRUE(result.specimens.back().terms[1].bound);
  EXPECT_FALSE(result.specimens.front().terms[1].bound);
}

// Bars about 10 % apart, without noise of the simulator. Stopped ones far below their strength say
// nothing of how much strengths differ, nor how well their mean is known.
TEST(Hindsight, StoppedTestsDoNotMakeStrengthsAlike) {
  auto study = test::synthetic_study({0.0, 0.0, 90.0}, {.specimen_effect = 0.1});
  study.calibrate.parameters = {"head_tail_MPa"};
  study.calibrate.terms = {"strength"};
  const test::ClosedForm exact{.noise = 0.0};
  const auto broken = test::fit(study, exact);
  for (int i = 0; i < 4; ++i) {
    auto& stopped = study.specimens.emplace_back(study.specimens.front());
    stopped.id = "stopped " + std::to_string(i);
    stopped.broke = false;
    stopped.test = test::straight_test(14e9, 25e6, 2e-3, 2e-3);
  }
  const auto all = test::fit(study, exact);
  RecordProperty("effect", std::to_string(all.specimen_effect[strength]));
  EXPECT_GT(broken.specimen_effect[strength], 0.05);
  EXPECT_NEAR(all.specimen_effect[strength], broken.specimen_effect[strength], 1e-6);
  const auto one = test::parameter_of(broken, "head_tail_MPa");
  const auto other = test::parameter_of(all, "head_tail_MPa");
  EXPECT_NEAR(log_width(other.slopes_95), log_width(one.slopes_95), 1e-6);
  EXPECT_NEAR(log_width(other.profile_95), log_width(one.profile_95), 1e-3);
  for (std::size_t i = 0; i < broken.verdict.size(); ++i)
    for (const char* check : {"residuals unstructured", "spread between specimens"})
      if (broken.verdict[i].check == check) {
        EXPECT_EQ(all.verdict[i].text, broken.verdict[i].text);
      }
}

// E = E₀ (1−p)^m over specimens whose porosity differs.
TEST(Hindsight, FitsTheLawOfModulusAndPorosity) {
  auto study = test::synthetic_study({0.0, 0.0, 0.0, 0.0, 0.0});
  study.porosity.to_modulus = ToModulus::power;
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa", "modulus_exponent"};
  for (std::size_t s = 0; s < study.specimens.size(); ++s) {
    auto& specimen = study.specimens[s];
    const double porosity = 0.02 + 0.03 * static_cast<double>(s);
    const double factor = std::pow(1.0 - porosity, 2.2);
    specimen.porosity = porosity;
    specimen.test =
        test::straight_test(factor * specimen.test.modulus, specimen.test.strength, 2e-3, 2e-3);
  }
  study.porosity.to_scatter = ToScatter::none;
  const auto result = test::fit(study);
  const auto exponent = test::parameter_of(result, "modulus_exponent");
  EXPECT_TRUE(exponent.identifiable) << exponent.left_out_because;
  EXPECT_LE(exponent.interval_95[0], 2.2);
  EXPECT_GE(exponent.interval_95[1], 2.2);
  EXPECT_NEAR(exponent.value, 2.2, 0.2);
  EXPECT_NEAR(test::parameter_of(result, "young_GPa").value, 14.0, 0.2);
  EXPECT_EQ(std::ranges::count(result.left_out, "E = E₀ (1−p)^m outside p of 2 to 29 %",
                               &sim::LeftOut::what),
            1);
}

// Only in the limit are other moduli and strengths the same simulation.
TEST(LeftOut, SaysWhyItRanFewerSimulationsThanItAskedFor) {
  const auto why = [](const Simulator& simulator) {
    const auto result = calibrate_with(simulator, test::synthetic_study({0.0, 90.0}));
    return result.left_out.back().why;
  };
  auto simulator = test::ClosedForm{}.simulator();
  simulator.quasi_static = [](const sim::Scene&) { return true; };
  EXPECT_THAT(why(simulator), testing::HasSubstr("in the quasi-static limit"));
  simulator.quasi_static = [](const sim::Scene&) { return false; };
  EXPECT_EQ(why(simulator), "asked for before");
}

}  // namespace
}  // namespace havers::calib
