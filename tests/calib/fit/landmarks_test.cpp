#include "calib/fit/landmarks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace havers::calib {
namespace {

struct Curve {
  std::vector<double> strain, stress;
};

// σ/σ_max = 2x − x² with x = ε/ε_max, up to the peak.
Curve parabola(int rows) {
  Curve curve;
  for (int i = 0; i <= rows; ++i) {
    const double x = static_cast<double>(i) / rows;
    curve.strain.push_back(0.01 * x);
    curve.stress.push_back(80e6 * (2.0 * x - x * x));
  }
  return curve;
}

TEST(Landmarks, OfAStraightCurveAreZero) {
  const std::vector<double> strain{0.0, 0.002, 0.01, 0.01}, stress{0.0, 16e6, 80e6, 0.0};
  const Landmarks shape = shape_of(strain, stress);
  EXPECT_NEAR(shape[pre_peak], 0.0, 1e-12);
  EXPECT_NEAR(shape[energy], 0.0, 1e-12);
  EXPECT_NEAR(shape[post_peak], 0.0, 1e-12);
}

// Of the parabola at seven equal parts of its arc, whose length from the peak back to a slope u is
// ¼ (u √(1 + u²) + asinh u), as u = 2 (1 − x). The height over the chord is x − x².
double mean_height_of_parabola() {
  const auto back_to = [](double u) { return 0.25 * (u * std::hypot(1.0, u) + std::asinh(u)); };
  double sum = 0.0;
  for (int k = 1; k <= 7; ++k) {
    double low = 0.0, high = 2.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (back_to(middle) < back_to(2.0) * k / 8.0 ? low : high) = middle;
    }
    const double x = 1.0 - 0.5 * low;
    sum += x - x * x;
  }
  return sum / 7.0;
}

// ∫ (2x − x²) dx = 2/3, so that 2W/(σε) = 4/3.
TEST(Landmarks, KnowEnergyAndHeightOfAParabola) {
  for (const int rows : {60, 1000, 20000}) {
    const Curve curve = parabola(rows);
    const Landmarks shape = shape_of(curve.strain, curve.stress);
    EXPECT_NEAR(shape[energy], std::log(4.0 / 3.0), 2e-3) << rows;
    EXPECT_NEAR(shape[pre_peak], mean_height_of_parabola(), 1e-3) << rows;
  }
}

TEST(Landmarks, DoNotDependOnTheScalesOfStressAndStrain) {
  Curve curve = parabola(200);
  const Landmarks shape = shape_of(curve.strain, curve.stress);
  for (double& strain : curve.strain) strain *= 3.0;
  for (double& stress : curve.stress) stress *= 0.1;
  EXPECT_TRUE(shape.isApprox(shape_of(curve.strain, curve.stress), 1e-12));
}

// Noise makes a curve longer everywhere alike: its normalised arc length hardly knows it.
TEST(Landmarks, AreHardlyMovedByNoise) {
  Curve curve = parabola(5000);
  const Landmarks clean = shape_of(curve.strain, curve.stress);
  for (std::size_t i = 0; i < curve.stress.size(); ++i)
    curve.stress[i] += 80e4 * std::sin(12.9898 * static_cast<double>(i));
  const Landmarks noisy = shape_of(curve.strain, curve.stress);
  EXPECT_NEAR(noisy[pre_peak], clean[pre_peak], 0.02);
  EXPECT_NEAR(noisy[energy], clean[energy], 0.02);
}

TEST(Landmarks, TellHowFarTheStressFallsAfterThePeak) {
  const std::vector<double> strain{0.0, 0.010, 0.011, 0.012, 0.013};
  const std::vector<double> stress{0.0, 80e6, 60e6, 30e6, 0.0};
  EXPECT_NEAR(shape_of(strain, stress)[post_peak], 0.2, 1e-12);
}

TEST(Landmarks, OfNoCurveAreZero) {
  EXPECT_TRUE((shape_of({}, {}) == 0.0).all());
}

TEST(Landmarks, HaveNamesOfTheirOwn) {
  EXPECT_EQ(name_of(modulus), "modulus");
  EXPECT_EQ(name_of(post_peak), "post-peak drop");
}

}  // namespace
}  // namespace havers::calib
