// What the specimens do not tell: where it stays, and what it costs the others.
#include "calib/fit/left_out.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/fit/calibrate.hpp"
#include "tests/support/studies.hpp"

namespace havers::calib {
namespace {

/// Two bars at 0° that differ by 5 %, the ratio asked for: it acts on their strengths by chance
/// alone, and hardly.
CalibrationResult fit_with_effect_of_ratio(double effect, unsigned draw) {
  Study study = test::synthetic_study({0.0}, {.specimen_effect = 0.05}, draw);
  study.calibrate.replicates = 4;
  const auto law = [effect](const sim::Scene& scene) {
    sim::Scene moved = scene;
    std::mt19937_64 random(scene.joints.seed + 77);
    std::normal_distribution<double> normal;
    moved.joints.head_tail *=
        std::exp(effect * normal(random) * std::log(sim::ratio(scene.assembly, scene.joints)));
    Response response = test::ClosedForm{}(scene);
    const Response by_ratio = test::ClosedForm{}(moved);
    response.strength = by_ratio.strength;
    response.strain = by_ratio.strain;
    response.stress = by_ratio.stress;
    response.failure_strain = by_ratio.failure_strain;
    return response;
  };
  return calibrate_with({.run = law, .quasi_static = [](const sim::Scene&) { return true; }},
                        study);
}

TEST(LeftOut, TakesNoFreedomWhereItMovesNothing) {
  int held = 0;
  for (unsigned draw = 1; draw <= 20; ++draw) {
    const auto with = fit_with_effect_of_ratio(1e-9, draw),
               without = fit_with_effect_of_ratio(0.0, draw);
    ASSERT_FALSE(test::parameter_of(with, "ratio").identifiable);
    const auto [low, high] = test::parameter_of(with, "head_tail_MPa").interval_95;
    const auto [lower, higher] = test::parameter_of(without, "head_tail_MPa").interval_95;
    EXPECT_NEAR(low, lower, 1e-3 * lower);
    EXPECT_NEAR(high, higher, 1e-3 * higher);
    held += low <= 60.0 && 60.0 <= high ? 1 : 0;
  }
  EXPECT_GE(held, 16);
}

// Where simulations scatter more, tests that are alike by chance contradict a scatter less. The
// truth is 60 MPa and 0.3.
TEST(LeftOut, WidensTheIntervalToEachScatterThatTestsAllow) {
  constexpr unsigned draws = 40;
  unsigned held = 0;
  for (unsigned draw = 1; draw <= draws; ++draw) {
    Study study = test::synthetic_study(test::three_orientations, {}, draw);
    study.calibrate.parameters = {"young_GPa", "head_tail_MPa", "scatter"};
    study.calibrate.profiles = false;
    study.model.joints.scatter = 0.05;
    const auto threshold = test::parameter_of(test::fit(study), "head_tail_MPa");
    const auto [low, high] = threshold.interval_95;
    held += low <= 60.0 && 60.0 <= high ? 1 : 0;
  }
  EXPECT_GE(held, 36U);
}

// Of σ₁ and scatter strengths tell a product only.
TEST(LeftOut, StaysWhereTheStudyHasItWhateverPointIsLookedAtFirst) {
  for (const double start : {8.0, 60.0, 600.0})
    for (const double scatter : {0.1, 0.6}) {
      Study study = test::synthetic_study(test::three_orientations);
      study.calibrate.automatic = true;
      study.model.joints.scatter = scatter;
      apply(study.model, "head_tail_MPa", start);
      const auto result = test::fit(study);
      EXPECT_TRUE(result.trusted()) << why_not_trusted(result);
      EXPECT_EQ(test::parameter_of(result, "scatter").value, scatter);
      const double truth = 60.0 * (1.0 - 0.5 * 0.3) / (1.0 - 0.5 * scatter);
      test::expect_within(test::parameter_of(result, "head_tail_MPa"), truth, 0.02);
    }
}

}  // namespace
}  // namespace havers::calib
