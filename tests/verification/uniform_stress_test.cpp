// What the theory promises of a whole run before anything breaks. Nothing is left out: the limit
// would take the uniform stress, which it knows, for what it has solved for.
#include <gtest/gtest.h>

#include <vector>

#include "sim/simulation.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

class UniformStress : public testing::TestWithParam<double> {
 protected:
  // In both regimes.
  static std::vector<Scene> scenes() {
    std::vector<Scene> both{test::small_scene(GetParam()), test::dynamic_scene(GetParam())};
    for (Scene& scene : both) {
      scene.solver.leave_out = false;
      scene.loading.max_strain = 2e-4;
    }
    return both;
  }
};
INSTANTIATE_TEST_SUITE_P(Orientation, UniformStress, testing::ValuesIn(test::orientations));

// (M1): σ = E ε for every orientation, in both regimes and on both kinds of sides.
TEST_P(UniformStress, HasTheModulusOfTheMaterial) {
  for (Scene scene : scenes())
    for (const Lateral lateral : {Lateral::periodic, Lateral::free}) {
      scene.loading.lateral = lateral;
      const Simulation simulation = simulate(scene);
      EXPECT_EQ(simulation.status, SimulationStatus::strain_limit);
      EXPECT_NEAR(simulation.modulus / scene.material.young, 1.0, 1e-10);
      for (const CurvePoint& point : simulation.curve) {
        EXPECT_NEAR(point.stress_right, scene.material.young * point.strain, 1e-10 * 2.6e6);
        EXPECT_NEAR(point.stress_left, point.stress_right, 1e-10 * 2.6e6);
      }
      EXPECT_LT(simulation.worst_penetration, 1e-15);
    }
}

// (M1) on finer meshes: joints take the mean of their edges, so a uniform stress stays uniform.
TEST_P(UniformStress, DoesNotDependOnTheMesh) {
  for (Scene scene : scenes())
    for (const int refinement : {2, 4}) {
      scene.assembly.refinement = refinement;
      const Simulation simulation = simulate(scene);
      EXPECT_NEAR(simulation.modulus / scene.material.young, 1.0, 1e-10);
      for (const CurvePoint& point : simulation.curve)
        EXPECT_NEAR(point.stress_left, scene.material.young * point.strain, 1e-10 * 2.6e6);
    }
}

TEST_P(UniformStress, IsStifferInPlaneStrain) {
  for (Scene scene : scenes()) {
    scene.material.plane = Plane::strain;
    const double nu = scene.material.poisson;
    EXPECT_NEAR(simulate(scene).modulus * (1.0 - nu * nu) / scene.material.young, 1.0, 1e-10);
  }
}

}  // namespace
}  // namespace havers::sim
