// Start from rest: a wave runs from the right at the speed sqrt(E/ρ), and doubles at the fixed end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// ν = 0: the specimen is a bar. The right side's speed is V = ε̇ W.
Scene bar(double orientation_deg, double step) {
  Scene scene = test::small_scene(orientation_deg, 10, 6);
  scene.solver.regime = Regime::dynamic;
  scene.solver.step = step;
  scene.material.poisson = 0.0;
  scene.loading.start = Start::rest;
  scene.loading.strain_rate = 1000.0;
  scene.joints.head_tail = scene.joints.flank = 1e12;  // nothing breaks
  return scene;
}

double speed(const Scene& scene) {
  return std::sqrt(scene.material.young / scene.material.density);
}

double mean_stress(const Simulation& simulation, double from, double to,
                   double CurvePoint::*stress) {
  double sum = 0.0;
  int rows = 0;
  for (const CurvePoint& point : simulation.curve)
    if (point.time >= from && point.time <= to) {
      sum += point.*stress;
      ++rows;
    }
  return sum / rows;
}

class Waves : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Orientation, Waves, testing::Values(0.0, 45.0, 90.0));

TEST_P(Waves, TravelAtTheBarSpeedAndDoubleTheShocksStressAtTheFixedEnd) {
  Scene scene = bar(GetParam(), 1e-9);
  const double transit = scene.assembly.width() / speed(scene);
  scene.loading.max_strain = 2.0 * transit * scene.loading.strain_rate;
  const Simulation simulation = simulate(scene);
  const double shock = scene.material.density * speed(scene) * scene.loading.strain_rate *
                       scene.assembly.width();  // ρ c V
  // Half of the doubled stress marks the front; numerical damping has smeared it.
  const auto arrival =
      std::find_if(simulation.curve.begin(), simulation.curve.end(),
                   [&](const CurvePoint& point) { return point.stress_left > shock; });
  ASSERT_NE(arrival, simulation.curve.end());
  EXPECT_NEAR(arrival->time / transit, 1.0, 0.03);
  EXPECT_NEAR(
      mean_stress(simulation, 0.3 * transit, 1.7 * transit, &CurvePoint::stress_right) / shock, 1.0,
      0.03);
  EXPECT_NEAR(
      mean_stress(simulation, 1.3 * transit, 1.9 * transit, &CurvePoint::stress_left) / shock, 2.0,
      0.06);
  EXPECT_NEAR(mean_stress(simulation, 0.0, 0.7 * transit, &CurvePoint::stress_left) / shock, 0.0,
              0.01);
}

// A viscous bar that is pulled at one end, by its modes: a uniform stretch and sines, each damped.
// Stress at the fixed end over ρ c V.
double exact_stress_left(const Scene& scene, double time) {
  const double c = speed(scene), width = scene.assembly.width(), tau = scene.material.viscosity;
  double sum = c / width * (time + tau);
  for (int k = 1; k <= 400; ++k) {
    const double wave = k * std::numbers::pi / width, omega = wave * c;
    const std::complex<double> half = 0.5 * tau * omega * omega,
                               root = std::sqrt(half * half - omega * omega);
    const std::complex<double> one = -half + root, two = -half - root;
    const auto of = [&](std::complex<double> s) { return std::exp(s * time) * (1.0 + tau * s); };
    sum += (k % 2 == 0 ? 2.0 : -2.0) * c / width * ((of(one) - of(two)) / (one - two)).real();
  }
  return sum;
}

// Mean error of the stress at the fixed end, over ρ c V, until a wave has been there twice: speed,
// height and doubling together.
double error_of(const Scene& scene) {
  double sum = 0.0;
  const Simulation run = simulate(scene);
  const double shock =
      scene.material.density * speed(scene) * scene.loading.strain_rate * scene.assembly.width();
  for (std::size_t i = 1; i < run.curve.size(); ++i)
    sum += std::abs(run.curve[i].stress_left / shock - exact_stress_left(scene, run.curve[i].time));
  return sum / static_cast<double>(run.curve.size() - 1);
}

// Towards the closed form with first order in h, on a mesh whose own error is small beside that.
TEST_P(Waves, ComeNearerToTheBarsWithFirstOrderInTheStep) {
  std::vector<double> errors;
  for (const double step : {6e-9, 3e-9, 1.5e-9}) {
    Scene scene = bar(GetParam(), step);
    scene.assembly.refinement = 2;
    scene.material.viscosity = 8e-8;
    scene.loading.max_strain =
        4.0 * scene.assembly.width() / speed(scene) * scene.loading.strain_rate;
    errors.push_back(error_of(scene));
  }
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 1.0, 0.1);
  EXPECT_LT(errors.back(), 0.005);
}

}  // namespace
}  // namespace havers::sim
