#include "sim/structure/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/contact/joint_step.hpp"
#include "sim/quasi_static/intact_structure.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

class SliversInBalance : public testing::TestWithParam<test::SliverWall> {};
INSTANTIATE_TEST_SUITE_P(Wall, SliversInBalance, testing::ValuesIn(test::walls_with_slivers));

// (M1), node by node, of modulus and strain 1: what was dropped leaves no side free.
TEST_P(SliversInBalance, UnderAUniformStress) {
  const AssemblyOptions options = test::assembly_of(GetParam());
  const Assembly assembly = build_assembly(options, Lateral::periodic);
  const Material material{.young = 1.0, .density = 1.0};
  const Bodies bodies(assembly, material, {0.0, 1.0});
  VectorXd u(bodies.dofs());
  for (std::size_t i = 0; i < assembly.nodes.size(); ++i)
    u.segment<2>(static_cast<Index>(2 * i)) << assembly.nodes[i].x(),
        -material.poisson * assembly.nodes[i].y();
  const VectorXd lacking = bodies.stiffness_times(u) -
                           joint_forces_on_nodes(bodies, uniform_stress_forces(assembly, 1.0));
  for (Index i = 0; i < lacking.size(); ++i) {
    if (bodies.held()[static_cast<std::size_t>(i)] != 0) continue;
    EXPECT_LT(std::abs(lacking(i)), 1e-8 * options.fibre_height);
  }
}

TEST(Bodies, HaveFewKindsWhereTheyAreEqual) {
  const Scene scene = test::small_scene(0.0, 30, 21);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::periodic);
  const Bodies bodies(assembly, scene.material, {1e14, 1.0});
  EXPECT_LE(bodies.classes().size(), 16U);
}

}  // namespace
}  // namespace havers::sim
