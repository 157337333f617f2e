// What is said of the answer after it is found: other intervals, other specimens, other seeds.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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
    const auto parameter = test::parameter_of(result, "young_GPa");
    for (const auto& specimen : result.specimens) {
      const double above = std::log(specimen.measured.modulus / (1e9 * parameter.value));
      const double exact = -above / (static_cast<double>(result.specimens.size()) - 1.0);
      EXPECT_NEAR(
          specimen.influence.front().shift * parameter.standard_error / parameter.value / exact,
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

// Strengths of two specimens at 0 degrees go with σ₁, of two at 45 with σ₁/(1 + r): in logarithms J
// has the rows (1, 0) and (1, −q), q = r/(1 + r), over s. (JᵀJ)⁻¹ goes as (q², q; q, 2), and its
// roots are those of λ² − (2 + q²) λ + q².
TEST(Hindsight, SaysInWordsWhatIsDetermined) {
  auto study = test::synthetic_study({0.0, 45.0}, {.specimen_effect = 0.01});
  study.calibrate.parameters = {"head_tail_MPa", "ratio"};
  study.calibrate.terms = {"strength"};
  study.calibrate.profiles = false;
  const auto result = test::fit(study, {.noise = 0.0});
  ASSERT_EQ(result.fitted, study.calibrate.parameters);
  ASSERT_EQ(result.correlation.size(), 2U);
  for (const std::size_t i : {0U, 1U}) EXPECT_NEAR(result.correlation[i].at(i), 1.0, 1e-12);
  EXPECT_NEAR(result.correlation[0].at(1), 1.0 / std::numbers::sqrt2, 1e-3);
  EXPECT_EQ(result.correlation[0].at(1), result.correlation[1].at(0));

  const double sd = result.specimens[0].terms.at(0).sd;
  const double r = test::parameter_of(result, "ratio").value, q = r / (1.0 + r);
  const double root = std::sqrt(std::pow(2.0 + q * q, 2) - 4.0 * q * q);
  const double large = 0.5 * (2.0 + q * q + root), small = 0.5 * (2.0 + q * q - root);
  // The smaller exponent of either direction, which stand at right angles; two specimens each.
  const double exponent = (large - 2.0) / q;
  const auto part = [&](double eigenvalue) {
    return 100.0 * sd * std::hypot(1.0, exponent) / std::sqrt(2.0 * eigenvalue);
  };
  EXPECT_THAT(
      result.directions,
      testing::ElementsAre(
          "The specimens determine 2 of 2 directions.",
          fmt::format("head_tail_MPa × ratio^{:.2g} is known to ± {:.2g} % (one standard error).",
                      -exponent, part(large)),
          fmt::format("head_tail_MPa^{:.2g} × ratio is known to ± {:.2g} % (one standard error).",
                      exponent, part(small))));
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

// The modulus that is a bar's own has no other to tell it, and nothing else needs that bar.
TEST(Hindsight, TellsWhatAllShareWithoutASpecimenThatHasParametersOfItsOwn) {
  auto study = test::synthetic_study({0.0, 0.0});
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  study.calibrate.profiles = false;
  const auto shared = test::fit(study);
  study.calibrate.level["young_GPa"] = Level::specimen;
  const auto result = test::fit(study);
  for (std::size_t s = 0; s < 4; ++s) {
    const auto& influence = result.specimens[s].influence;
    ASSERT_EQ(influence.size(), 5U);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(std::isnan(influence[k].shift), k == s) << s << k;
    }
    EXPECT_NEAR(influence[4].shift, shared.specimens[s].influence[1].shift, 0.05) << s;
  }
  const Check check = test::check_of(result, "no specimen decides");
  EXPECT_EQ(check.outcome, Outcome::pass) << check.text;
}

}  // namespace
}  // namespace havers::calib
