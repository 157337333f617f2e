// What the specimens do not tell: where it stays, and what it costs the others.
#include "calib/fit/left_out.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "calib/fit/calibrate.hpp"
#include "tests/support/slow.hpp"
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
    moved.joints.head_tail *= std::exp(effect * test::normal_of(scene.joints.seed + 77) *
                                       std::log(sim::ratio(scene.assembly, scene.joints)));
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
  HAVERS_SLOW;
  int held = 0;
  for (unsigned draw = 1; draw <= 40; ++draw) {
    const auto with = fit_with_effect_of_ratio(1e-9, draw),
               without = fit_with_effect_of_ratio(0.0, draw);
    ASSERT_FALSE(test::parameter_of(with, "ratio").identifiable);
    const auto [low, high] = test::parameter_of(with, "head_tail_MPa").interval_95;
    const auto [lower, higher] = test::parameter_of(without, "head_tail_MPa").interval_95;
    EXPECT_NEAR(low, lower, 1e-3 * lower);
    EXPECT_NEAR(high, higher, 1e-3 * higher);
    held += low <= 60.0 && 60.0 <= high ? 1 : 0;
  }
  RecordProperty("held", held);
  EXPECT_GE(held, 32);
}

// Strengths that scatter as the joints do, by 0.2 d: that of four bars tells how far d may be from
// 0.3, and so σ₁ from 60 MPa, beside any d that the study has.
TEST(LeftOut, HoldsTheThresholdByEachScatterThatIsLikely) {
  HAVERS_SLOW;
  constexpr int draws = 40;
  const auto scattered = [](std::uint64_t seed, double scatter) {
    return std::exp(0.2 * scatter * test::normal_of(seed + 7));
  };
  const auto simulator = test::altered([&](Response& response, const sim::Scene& scene) {
    const double factor = scattered(scene.joints.seed, scene.joints.scatter);
    response.strength *= factor;
    response.failure_strain *= factor;
    for (double& stress : response.stress) stress *= factor;
    for (double& strain : response.strain) strain *= factor;
  });
  for (const double scatter_of_study : {0.1, 1.0}) {
    int held = 0;
    double width = 0.0;
    for (unsigned draw = 1; draw <= draws; ++draw) {
      Study study = test::synthetic_study({0.0, 0.0, 0.0, 0.0});
      for (std::size_t k = 0; k < study.specimens.size(); ++k) {
        const MeasuredTest& mean = study.specimens[k].test;
        study.specimens[k].test =
            test::straight_test(mean.modulus, mean.strength * scattered(97 * draw + k, 0.3));
      }
      study.calibrate.parameters = {"young_GPa", "head_tail_MPa", "scatter"};
      study.calibrate.profiles = false;
      study.calibrate.replicates = 8;
      study.model.joints.scatter = scatter_of_study;
      const auto fitted = test::parameter_of(calibrate_with(simulator, study), "head_tail_MPa");
      const auto [low, high] = fitted.interval_95;
      held += low <= 60.0 && 60.0 <= high ? 1 : 0;
      width += std::log(high / low) / draws;
    }
    const std::string beside = " beside " + std::to_string(scatter_of_study);
    RecordProperty("held" + beside, held);
    RecordProperty("width" + beside, std::to_string(width));
    EXPECT_GE(held, 34) << scatter_of_study;
    EXPECT_LE(width, 1.0) << scatter_of_study;
  }
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
