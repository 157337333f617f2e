#include "sim/quasi_static/intact_structure.hpp"

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

TEST(IntactStructure, IsSharedByScenesThatDifferInStrengthAndModulusOnly) {
  Scene scene = test::small_scene(30.0);
  const auto first = intact_structure(scene);
  scene.material.young = 20e9;
  scene.material.density = 1800.0;
  scene.joints.seed = 9;
  scene.joints.scatter = 1.0;
  EXPECT_EQ(intact_structure(scene), first);
  scene.material.poisson = 0.2;
  EXPECT_NE(intact_structure(scene), first);
  scene.material.poisson = 0.33;
  scene.assembly.orientation *= 1.0 + 1e-15;
  EXPECT_NE(intact_structure(scene), first);
}

TEST(IntactStructure, RemembersWhatItWasAsked) {
  const auto intact = intact_structure(test::small_scene(30.0));
  EXPECT_EQ(intact->reactions_to_jump(3), intact->reactions_to_jump(3));
  EXPECT_NE(intact->reactions_to_jump(3), intact->reactions_to_jump(4));
}

}  // namespace
}  // namespace havers::sim
