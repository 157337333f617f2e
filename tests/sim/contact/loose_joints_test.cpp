#include "sim/contact/loose_joints.hpp"

#include <gtest/gtest.h>

#include "sim/assembly/assembly.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

// A few, then all of a wall: each time as the refined equations have it.
TEST(LooseJoints, KnowWhatTheyDoToEachOtherAndToTheOthers) {
  const Scene scene = test::small_scene(17.0, 14, 10);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::periodic);
  const Bodies bodies(assembly, scene.material, {1e14, 1.0});
  const Structure structure(bodies);
  LooseJoints loose(structure);
  StructureLoads loads{Eigen::VectorXd::Zero(bodies.dofs()), Eigen::VectorXd::Zero(bodies.dofs()),
                       Eigen::VectorXd::Zero(2 * structure.joints())};
  for (int joint = 0; joint < structure.joints(); ++joint) {
    loose.add(joint);
    const Eigen::VectorXd y = 1e-9 * Eigen::VectorXd::Random(2 * (joint + 1));
    if (joint != 3 && joint + 1 < structure.joints()) continue;
    loads.jumps.head(y.size()) = y;
    const Eigen::VectorXd reactions = structure.solve(loads).reactions;
    EXPECT_LT((structure.reactions_to(loose.jumps(), y) - reactions).norm(),
              1e-9 * reactions.norm())
        << joint;
    EXPECT_LT((loose.stiffness() * y - reactions.head(y.size())).norm(), 1e-9 * reactions.norm())
        << joint;
  }
}

}  // namespace
}  // namespace havers::sim
