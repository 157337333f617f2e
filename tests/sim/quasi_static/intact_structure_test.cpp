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
  EXPECT_EQ(intact->jump(3), intact->jump(3));
  EXPECT_NE(intact->jump(3), intact->jump(4));
}

// Those of few by columns of their own, of many by one solve.
TEST(IntactStructure, AddsUpWhatJumpsDoHoweverMany) {
  const auto intact = intact_structure(test::small_scene(17.0, 14, 10));
  const auto joints = static_cast<int>(intact->structure().joints());
  std::vector<SharedJump> jumps;
  for (int joint = 0; joint < joints; ++joint) {
    jumps.push_back(intact->jump(joint));
    if (joint != 3 && joint + 1 < joints) continue;
    const Eigen::VectorXd y = Eigen::VectorXd::Random(2 * (joint + 1));
    const Eigen::VectorXd reactions = intact->reactions_to(jumps, y),
                          solved = intact->structure().reactions_to(jumps, y);
    EXPECT_LT((reactions - solved).norm(), 1e-11 * solved.norm()) << joint;
  }
}

}  // namespace
}  // namespace havers::sim
