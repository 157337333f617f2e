#include "sim/dynamics/energy.hpp"

#include <gtest/gtest.h>

namespace havers::sim {
namespace {

using Eigen::VectorXd;

// One mass on a spring (and dashpot), pulled by a force, by implicit Euler.
class Oscillator : public testing::Test {
 protected:
  static constexpr double stiffness = 3.0, viscosity = 0.02, h = 0.1, pull = 0.7;
  VectorXd mass = VectorXd::Constant(1, 2.0);

  [[nodiscard]] static Motion at(double q, double v) {
    const auto one = [](double x) { return VectorXd::Constant(1, x); };
    return {one(q), one(v), one(stiffness * q), one(stiffness * v)};
  }
  [[nodiscard]] Motion next(const Motion& now) const {
    const double q = now.q(0), v = now.v(0);
    const double change = (h * pull - h * stiffness * (q + h * v) - h * viscosity * stiffness * v) /
                          (mass(0) + h * viscosity * stiffness + h * h * stiffness);
    return at(q + h * (v + change), v + change);
  }
};

TEST_F(Oscillator, BalancesItsEnergyEachStep) {
  Motion motion = at(1.0, -0.5);
  EnergyBalance energy;
  energy.start(motion, mass);
  const double at_start = 0.5 * 2.0 * 0.25 + 0.5 * 3.0;
  EXPECT_DOUBLE_EQ(energy.kinetic + energy.elastic, at_start);
  for (int step = 0; step < 500; ++step) {
    const Motion after = next(motion);
    energy.add({h, viscosity, pull * h * after.v(0), 0.0}, motion, after, mass);
    motion = after;
  }
  EXPECT_LT(energy.relative_defect, 1e-14);
  EXPECT_NEAR(energy.external, energy.kinetic + energy.elastic + energy.viscous + energy.numerical,
              1e-12);
  EXPECT_GT(energy.viscous, 0.0);
  EXPECT_GT(energy.numerical, 0.0);
  EXPECT_NEAR(motion.q(0), pull / stiffness, 0.01);  // at rest in the end
}

// As after a leap, whose viscous work is known.
TEST_F(Oscillator, StartsAgainWithTheWorkOfWhatWasTaken) {
  Motion motion = at(1.0, -0.5);
  EnergyBalance energy;
  energy.start(motion, mass);
  for (int step = 0; step < 10; ++step) {
    const Motion after = next(motion);
    energy.add({h, viscosity, pull * h * after.v(0), 0.0}, motion, after, mass);
    motion = after;
  }
  energy.viscous += 0.3;
  energy.start(motion, mass);
  EXPECT_DOUBLE_EQ(energy.external,
                   energy.kinetic + energy.elastic + energy.viscous + energy.numerical);
}

TEST_F(Oscillator, MissesWorkThatIsNotAccountedFor) {
  const Motion before = at(1.0, -0.5), after = next(before);
  EnergyBalance energy;
  energy.start(before, mass);
  energy.add({h, viscosity, pull * h * after.v(0) + 0.01, 0.0}, before, after, mass);
  EXPECT_NEAR(energy.relative_defect, 0.01 / 1.75, 1e-12);
}

}  // namespace
}  // namespace havers::sim
