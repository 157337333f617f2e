#include "sim/outcome.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace havers::sim {
namespace {

Simulation run_with(std::vector<CurvePoint> curve) {
  Simulation simulation;
  simulation.curve = std::move(curve);
  return simulation;
}

CurvePoint row(double strain, double right, double left, int broken = 0) {
  CurvePoint point;
  point.strain = strain;
  point.stress_right = right;
  point.stress_left = left;
  point.broken_joints = broken;
  return point;
}

TEST(HasFailed, NeedsABreakAndBothSidesLow) {
  Simulation simulation = run_with({row(0.001, 10.0, 10.0)});
  take_note_of_strength(simulation);
  EXPECT_FALSE(has_failed(simulation, 0.3));
  simulation.curve.push_back(row(0.002, 2.0, 2.0));
  take_note_of_strength(simulation);
  EXPECT_EQ(simulation.strength, 10.0);
  EXPECT_FALSE(has_failed(simulation, 0.3)) << "nothing has broken";
  simulation.curve.push_back(row(0.003, 2.0, 4.0, 1));
  EXPECT_FALSE(has_failed(simulation, 0.3)) << "the left side still carries";
  simulation.curve.push_back(row(0.004, 2.0, 2.0, 1));
  EXPECT_TRUE(has_failed(simulation, 0.3));
  EXPECT_FALSE(has_failed(simulation, 0.1));
}

TEST(Summarise, ReadsTheCurveAndTheJoints) {
  Simulation simulation = run_with({row(0.0, 0.0, 0.0), row(0.001, 13e6, 13e6),
                                    row(0.002, 24e6, 24e6, 1), row(0.003, 20e6, 20e6, 2)});
  simulation.joints = initial_outcomes({{1.0, 1.0}, {2.0, 1.0}, {3.0, 1.0}});
  for (const std::size_t j : {0U, 2U}) {
    simulation.joints[j].broken = true;
    simulation.joints[j].broken_at_strain = j == 0 ? 0.003 : 0.002;
  }
  summarise(simulation);
  EXPECT_EQ(simulation.strength, 24e6);
  EXPECT_EQ(simulation.failure_strain, 0.002);
  EXPECT_EQ(simulation.first_break_strain, 0.002);
  EXPECT_EQ(simulation.broken_joints, 2);
  EXPECT_DOUBLE_EQ(simulation.modulus, 13e9);
}

TEST(Summarise, TakesTheWholeCurveWhenNothingBroke) {
  Simulation simulation = run_with({row(0.0, 0.0, 0.0), row(0.004, 40e6, 40e6)});
  simulation.joints = initial_outcomes({{1.0, 1.0}});
  summarise(simulation);
  EXPECT_TRUE(std::isnan(simulation.first_break_strain));
  EXPECT_DOUBLE_EQ(simulation.modulus, 10e9);
}

// A viscous stress, constant from the first step on, is none of it.
TEST(Summarise, TakesTheModulusFromTheSlope) {
  Simulation simulation =
      run_with({row(0.0, 0.0, 0.0), row(1e-5, 10.13e6, 0.0), row(0.004, 62e6, 0.0)});
  summarise(simulation);
  EXPECT_NEAR(simulation.modulus, 13e9, 1.0);
  // Nor where that step is a good part of the stretch.
  simulation = run_with({row(0.0, 0.0, 0.0), row(1e-3, 23e6, 0.0), row(0.004, 62e6, 0.0)});
  simulation.regime = Regime::dynamic;
  summarise(simulation);
  EXPECT_NEAR(simulation.modulus, 13e9, 1.0);
}

TEST(Worse, ForgetsNoNumberThatIsNone) {
  EXPECT_EQ(worse(1.0, 2.0), 2.0);
  EXPECT_EQ(worse(2.0, 1.0), 2.0);
  EXPECT_TRUE(std::isnan(worse(worse(1.0, std::nan("")), 2.0)));
}

std::vector<CurvePoint> curve_through(const std::vector<std::pair<double, double>>& points) {
  std::vector<CurvePoint> curve;
  curve.reserve(points.size());
  for (const auto& [strain, stress] : points) curve.push_back(row(strain, stress, 0.0));
  return curve;
}

// A straight curve at σ = 1 with a jump to 3 on its last tenth: of the two stretches of 0.2 the
// jump is the last half of the second, an eighth by a triangle. What is leapt over counts.
TEST(LargestMeanStress, WeighsTwoStretchesOfStrainByATriangle) {
  const auto curve = curve_through({{0.0, 1.0}, {0.9, 1.0}, {0.9 + 1e-12, 3.0}, {1.0, 3.0}});
  EXPECT_NEAR(largest_mean_stress(curve, 0.2), 1.25, 1e-9);
  EXPECT_NEAR(largest_mean_stress(curve, 0.1), 2.0, 1e-9);
  EXPECT_NEAR(largest_mean_stress(curve_through({{0.0, 0.0}, {1.0, 1.0}}), 0.1), 0.9, 1e-12);
  EXPECT_TRUE(std::isnan(largest_mean_stress(curve, 0.6))) << "longer than the curve";
}

// σ = 1 and waves of which so many pass in a stretch: a mean leaves sin(πn)/(πn) of each, a mean of
// means the square of that.
TEST(LargestMeanStress, LeavesLittleOfWaves) {
  for (const double times : {1.0, 3.0, 0.4, 5.5}) {
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i <= 20000; ++i)
      points.emplace_back(5e-5 * i, 1.0 + std::sin(times * 2.0 * std::numbers::pi * 1e-3 * i));
    const double of_one = std::sin(std::numbers::pi * times) / (std::numbers::pi * times);
    EXPECT_NEAR(largest_mean_stress(curve_through(points), 0.05) - 1.0, of_one * of_one, 2e-6)
        << times;
  }
}

// So little of the strain has no digits in the area under the curve, or none in the strain itself.
TEST(LargestMeanStress, OverNextToNoStrainIsTheLargestStress) {
  const auto curve = curve_through({{0.0, 0.0}, {0.003, 40.0}, {0.006, 30.0}});
  for (const double span : {1e-30, 1e-17, 1e-12, 1e-11})
    EXPECT_NEAR(largest_mean_stress(curve, span), 40.0, 1e-4) << span;
  EXPECT_TRUE(std::isnan(largest_mean_stress({}, 1e-17)));
  EXPECT_TRUE(std::isnan(largest_mean_stress(curve_through({{0.0, 1.0}}), 1e-17)));
}

TEST(StressAt, FollowsTheCurveFromTheOriginToWhereItFirstReachesAStrain) {
  const std::vector<CurvePoint> curve{row(0.002, 20.0, 0.0), row(0.002, 10.0, 0.0),
                                      row(0.001, 5.0, 0.0), row(0.004, 35.0, 0.0)};
  EXPECT_DOUBLE_EQ(stress_at(curve, 0.001).value(), 10.0);
  EXPECT_DOUBLE_EQ(stress_at(curve, 0.002).value(), 20.0) << "before the break";
  EXPECT_DOUBLE_EQ(stress_at(curve, 0.003).value(), 25.0) << "beyond where it went back";
  EXPECT_DOUBLE_EQ(stress_at(curve, 0.004).value(), 35.0);
  EXPECT_FALSE(stress_at(curve, 0.005));
}

}  // namespace
}  // namespace havers::sim
