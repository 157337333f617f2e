// What the specimens cannot tell is left out of the fit, with the reason.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/fit/calibrate.hpp"
#include "tests/support/slow.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

CalibrationResult fit(const std::vector<double>& degrees, std::vector<std::string> parameters,
                      const test::ClosedForm& law = {}) {
  auto study = test::synthetic_study(degrees, {}, 1, law);
  study.calibrate.parameters = std::move(parameters);
  return calibrate_with(law.simulator(), study);
}

void expect_left_out(const CalibratedParameter& parameter, const std::string& reason, double kept) {
  EXPECT_FALSE(parameter.identifiable);
  EXPECT_NE(parameter.left_out_because.find(reason), std::string::npos)
      << parameter.left_out_because;
  EXPECT_TRUE(std::isnan(parameter.interval_95[0]));
  EXPECT_NEAR(parameter.value, kept, 1e-9);
}

TEST(Identifiability, LeavesOutTheRatioWhereHeadTailJointsDecideAlone) {
  const auto result = fit({0.0}, {"young_GPa", "head_tail_MPa", "ratio"});
  expect_left_out(test::parameter_of(result, "ratio"), "structurally unidentifiable: nothing",
                  value_of(sim::Scene{}, "ratio"));
  EXPECT_TRUE(test::parameter_of(result, "head_tail_MPa").identifiable);
  EXPECT_EQ(result.left_out.front().what, "ratio");
}

// The outcome jumps with the ratio, but at random from seed to seed: no information.
TEST(Identifiability, IsNotFooledByNoise) {
  auto simulator = test::ClosedForm{}.simulator();
  simulator.run = [](const sim::Scene& scene) {
    auto other = scene;
    other.joints.seed += static_cast<std::uint64_t>(1e6 * sim::ratio(scene.assembly, scene.joints));
    return test::ClosedForm{}(other);
  };
  const auto result = calibrate_with(simulator, test::synthetic_study({0.0, 90.0}));
  EXPECT_FALSE(test::parameter_of(result, "ratio").identifiable);
  EXPECT_NE(
      test::parameter_of(result, "ratio").left_out_because.find("calibrate.options.replicates"),
      std::string::npos)
      << "a large effect by chance is not \"no more than\": "
      << test::parameter_of(result, "ratio").left_out_because;
  EXPECT_TRUE(test::parameter_of(result, "head_tail_MPa").identifiable);
}

// Along the fibres the ratio counts below 1.5, as in the study (1.0), and not above, as in truth
// (2.0): back at the study's value it would make the threshold wrong.
Simulator informed_of_low_ratios() {
  return test::altered([](Response& response, const sim::Scene& scene) {
    const double r = sim::ratio(scene.assembly, scene.joints);
    if (scene.assembly.orientation > 0.1) return;
    const double factor = std::pow(std::max(1.5 / r, 1.0), 0.7);
    response.strength *= factor;
    response.failure_strain *= factor;
  });
}

TEST(Identifiability, LeavesWhatTheStudyHasWrongWhereTheFitFoundIt) {
  const auto study = test::synthetic_study({0.0, 90.0});
  ASSERT_NEAR(value_of(study.model, "ratio"), 1.0, 1e-9);
  const auto result = calibrate_with(informed_of_low_ratios(), study);
  const auto ratio = test::parameter_of(result, "ratio");
  EXPECT_FALSE(ratio.identifiable);
  EXPECT_TRUE(std::isnan(ratio.interval_95[0]));
  EXPECT_GT(ratio.value, 1.4);
  EXPECT_NE(ratio.left_out_because.find("the study's value contradicts the specimens"),
            std::string::npos)
      << ratio.left_out_because;
  EXPECT_NEAR(test::parameter_of(result, "head_tail_MPa").value, 60.0, 0.6);
  EXPECT_EQ(test::check_of(result, "inside bounds").outcome, Outcome::pass);
}

TEST(Identifiability, IsStoppedAtAnyPointAndKeepsTheBestOne) {
  HAVERS_SLOW;
  auto study = test::synthetic_study({0.0, 90.0});
  study.calibrate.profiles = false;
  const auto calls_until = [&](int last) {
    int calls = 0;
    const auto result = calibrate_with(informed_of_low_ratios(), study, nullptr,
                                       [&](const CalibrationProgress&) { return ++calls < last; });
    for (const auto& parameter : result.parameters)
      EXPECT_TRUE(parameter.bounds[0] <= parameter.value && parameter.value <= parameter.bounds[1])
          << parameter.name << " = " << parameter.value << ", stopped at " << last;
    return calls;
  };
  const int all = calls_until(std::numeric_limits<int>::max());
  for (int last = 1; last <= all; last += 2) calls_until(last);
}

// At one orientation only a product of threshold and ratio shows. An interval of the threshold at
// the study's ratio, 1.0 where 2.0 is true, would be wrong by half.
TEST(Identifiability, HoldsTheThresholdWhateverTheRatioThatIsLeftOut) {
  for (unsigned draw = 1; draw <= 10; ++draw) {
    auto study = test::synthetic_study({45.0}, {.specimen_effect = 0.01}, draw);
    study.calibrate.bounds["ratio"] = {0.5, 4.0};
    const auto result = test::fit(study);
    EXPECT_FALSE(test::parameter_of(result, "ratio").identifiable);
    const auto threshold = test::parameter_of(result, "head_tail_MPa");
    for (const auto& interval :
         {threshold.slopes_95, threshold.profile_95, threshold.interval_95}) {
      EXPECT_LT(interval[0], 60.0);
      EXPECT_GT(interval[1], 60.0);
    }
    // The law's 1 + r from 1.5 to 5 beside the study's 2, and what two specimens leave open.
    EXPECT_NEAR(std::log(threshold.interval_95[1] / threshold.value), std::log(5.0 / 2.0), 0.25);
  }
}

// What the ratio may be lets the threshold be anywhere between its bounds, beside a standard error
// of a few per cent: no answer.
TEST(Identifiability, RejectsAnIntervalThatBoundsAloneWouldGive) {
  auto study = test::synthetic_study({45.0}, {.specimen_effect = 0.1});
  study.calibrate.bounds["ratio"] = {0.1, 20.0};
  study.calibrate.bounds["head_tail_MPa"] = {20.0, 200.0};
  const auto result = test::fit(study);
  const auto threshold = test::parameter_of(result, "head_tail_MPa");
  ASSERT_TRUE(threshold.identifiable);
  const Check check = test::check_of(result, "identifiable");
  EXPECT_EQ(check.outcome, Outcome::fail) << check.text;
  EXPECT_TRUE(test::says(check, "without any test: its value is not known.")) << check.text;
  EXPECT_FALSE(result.trusted());
  const double part = threshold.standard_error / threshold.value;
  EXPECT_THAT(result.directions,
              testing::Contains(fmt::format("head_tail_MPa is known to ± {:.2g} % (one standard "
                                            "error, at ratio = 1).",
                                            100.0 * part)));
}

TEST(Identifiability, LeavesOutTheScatterBesideTheThreshold) {
  for (const auto& degrees : {std::vector{0.0}, std::vector{0.0, 45.0, 90.0}}) {
    const auto result = fit(degrees, {"young_GPa", "head_tail_MPa", "scatter"});
    expect_left_out(test::parameter_of(result, "scatter"),
                    "only head_tail_MPa × (1 − scatter/2) is determined", 0.3);
    EXPECT_TRUE(test::parameter_of(result, "head_tail_MPa").identifiable);
  }
}

TEST(Identifiability, FitsTheScatterWhereTheThresholdIsKnown) {
  auto study = test::synthetic_study({0.0, 90.0});
  study.model.joints.head_tail = 60e6;
  study.model.joints.flank = sim::flank_from_ratio(study.model.assembly, 60e6, 2.0);
  study.calibrate.parameters = {"young_GPa", "scatter"};
  const auto result = test::fit(study);
  EXPECT_NEAR(test::parameter_of(result, "scatter").value, 0.3, 0.02);
}

TEST(Identifiability, LeavesOutTheRatioBesideTheThresholdAtOneOrientation) {
  const auto result = fit({45.0}, {"head_tail_MPa", "ratio"});
  EXPECT_NE(
      test::parameter_of(result, "ratio").left_out_because.find("only head_tail_MPa × ratio^-0."),
      std::string::npos)
      << test::parameter_of(result, "ratio").left_out_because;
}

TEST(Identifiability, TriesEverythingWhenAutomaticAndKeepsWhatIsInformed) {
  auto study = test::synthetic_study({0.0, 45.0, 90.0});
  study.calibrate.automatic = true;
  const auto result = test::fit(study);
  EXPECT_TRUE(test::parameter_of(result, "ratio").identifiable);
  EXPECT_FALSE(test::parameter_of(result, "scatter").identifiable);
  EXPECT_TRUE(result.trusted());
  // At another scatter the threshold has another interval, and further angles change nothing.
  const Check check = test::check_of(result, "identifiable");
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_TRUE(test::says(check, "The interval of head_tail_MPa holds for that value only."));
  EXPECT_TRUE(test::says(check, "has no interval; sections (porosity) may tell it.")) << check.text;
}

TEST(Identifiability, WarnsOfNothingWhenAutomaticLeavesOutWhatChangesNothing) {
  auto study = test::synthetic_study({0.0});
  study.calibrate.automatic = true;
  study.porosity.to_scatter = ToScatter::linear;
  for (auto& specimen : study.specimens) specimen.porosity = 0.02;
  const Check check = test::check_of(test::fit(study), "identifiable");
  EXPECT_EQ(check.outcome, Outcome::pass) << check.text;
  EXPECT_TRUE(test::says(check, "has no interval; specimens at another orientation may tell it."));
}

TEST(Identifiability, AsksForABreakWhereEveryTestWasStopped) {
  auto study = test::synthetic_study(test::three_orientations);
  for (auto& specimen : study.specimens) specimen.broke = false;
  const Check check = test::check_of(test::fit(study), "identifiable");
  EXPECT_EQ(check.outcome, Outcome::warn);
  EXPECT_TRUE(test::says(check, "has no interval; tests up to the break may tell it."))
      << check.text;
}

TEST(Identifiability, NamesTheTermThatWouldTell) {
  auto study = test::synthetic_study(test::three_orientations);
  study.calibrate.parameters = {"young_GPa", "head_tail_MPa"};
  study.calibrate.terms = {"strength"};
  const Check modulus = test::check_of(test::fit(study), "identifiable");
  EXPECT_TRUE(test::says(modulus, "\"modulus\" among calibrate.options.terms may tell it."))
      << modulus.text;
  study.calibrate.terms = {"modulus"};
  const Check strength = test::check_of(test::fit(study), "identifiable");
  EXPECT_TRUE(test::says(strength, "\"strength\" among calibrate.options.terms may tell it."))
      << strength.text;
}

TEST(Identifiability, SaysThatIntervalsHoldForEachOfSeveralAlone) {
  const auto check = [](const std::vector<std::string>& parameters) {
    return test::check_of(fit({0.0}, parameters), "identifiable").text;
  };
  EXPECT_THAT(check({"young_GPa", "head_tail_MPa", "ratio"}),
              testing::HasSubstr("hold wherever the specimens allow it to be."));
  EXPECT_THAT(check({"young_GPa", "head_tail_MPa", "ratio", "scatter"}),
              testing::HasSubstr("hold wherever the specimens allow each of what is left out, by "
                                 "itself with the rest held, to be."));
}

}  // namespace
}  // namespace havers::calib
