#include "sim/quasi_static/intact_structure.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/support/scenes.hpp"
#include "tests/support/slow.hpp"

namespace havers::sim {
namespace {

TEST(IntactStructure, IsSharedByScenesThatDifferInStrengthAndModulusOnly) {
  const Scene scene = test::small_scene(30.0);
  const auto first = intact_structure(scene);
  Scene stronger = scene;
  stronger.material.young = 20e9;
  stronger.material.density = 1800.0;
  stronger.material.viscosity = 1e-8;
  stronger.joints.seed = 9;
  stronger.joints.scatter = 1.0;
  stronger.joints.friction = 0.6;
  stronger.joints.missing = 0.1;
  stronger.loading.strain_rate = 2.0;
  EXPECT_EQ(intact_structure(stronger), first);
}

// Two walls of one key would bear each other's forces.
TEST(IntactStructure, IsNotSharedByScenesThatDifferInAnythingElse) {
  using Change = void (*)(Scene&);
  const Scene scene = test::small_scene(30.0, 3, 2);
  const std::vector<std::pair<const char*, Change>> changes{
      {"layers", [](Scene& s) { s.assembly.layers += 1; }},
      {"fibres", [](Scene& s) { s.assembly.fibres += 1; }},
      {"refinement", [](Scene& s) { s.assembly.refinement = 2; }},
      {"fibre length", [](Scene& s) { s.assembly.fibre_length *= 1.0 + 1e-15; }},
      {"fibre height", [](Scene& s) { s.assembly.fibre_height *= 1.0 + 1e-15; }},
      {"orientation", [](Scene& s) { s.assembly.orientation *= 1.0 + 1e-15; }},
      {"sides", [](Scene& s) { s.loading.lateral = Lateral::free; }},
      {"Poisson's ratio", [](Scene& s) { s.material.poisson = 0.2; }},
      {"plane", [](Scene& s) { s.material.plane = Plane::strain; }},
      {"layers' contrast", [](Scene& s) { s.material.layer_contrast = 0.5; }},
      {"what is left out", [](Scene& s) { s.solver.leave_out = false; }}};
  for (const auto& [what, change] : changes) {
    const auto first = intact_structure(scene);  // again: of many the last ones are kept
    Scene other = scene;
    change(other);
    EXPECT_NE(intact_structure(other), first) << what;
    EXPECT_EQ(intact_structure(scene), first) << what;
  }
}

// (M1): moved sides press on bodies by 1/(1 − 2ν) harder than these bear. With nothing left out the
// force is the one that was solved for.
TEST(IntactStructure, BearsTheUniformStressNearlyIncompressible) {
  for (const double angle : {0.0, 30.0, 90.0})
    for (const double poisson : {0.3, 0.499, 0.4999}) {
      Scene scene = test::small_scene(angle, 1, 2);
      scene.loading.lateral = Lateral::free;
      scene.material.plane = Plane::strain;
      scene.material.poisson = poisson;
      EXPECT_TRUE(intact_structure(scene)->stress_is_known()) << angle << ", " << poisson;
      scene.solver.leave_out = false;
      const auto intact = intact_structure(scene);
      const double expected = intact->assembly().height / (1.0 - poisson * poisson);
      EXPECT_NEAR(intact->answer().force / expected, 1.0, 2e-12 / (1.0 - 2.0 * poisson))
          << angle << ", " << poisson;
    }
}

// Facing edges of a periodic wall then overlap all but for 1e-8 of their length.
TEST(IntactStructure, BearsTheUniformStressWhereFibresAreAllButAlongASide) {
  for (const double degrees : {1e-9, 1e-8, 1e-7, 1e-6, 89.99999999, 89.9999999}) {
    SCOPED_TRACE(degrees);
    Scene scene = test::small_scene(degrees);
    ASSERT_TRUE(intact_structure(scene)->structure().ok());
    EXPECT_TRUE(intact_structure(scene)->stress_is_known());
    scene.solver.leave_out = false;  // what was solved for
    const auto intact = intact_structure(scene);
    EXPECT_FALSE(intact->stress_is_known());
    const Eigen::VectorXd exact = uniform_stress_forces(intact->assembly(), 1.0);
    EXPECT_LT((intact->answer().reactions - exact).norm(), 1e-8 * exact.norm());
  }
}

// Large enough for nested dissection; by minimum degree there are 84 nonzeros a row. Its sides are
// tied, and the distance common to all ties comes last.
TEST(IntactStructure, OfALargeWallFillsLessWhereBodiesAreHalved) {
  HAVERS_SLOW;
  const auto intact = intact_structure(test::small_scene(30.0, 70, 50));
  ASSERT_TRUE(intact->structure().ok());
  ASSERT_FALSE(intact->assembly().ties.empty());
  EXPECT_LT(intact->structure().factor().nonzeros(), 78 * intact->structure().factor().rows());
  EXPECT_LT(intact->answer().residual, 1e-12);
  EXPECT_TRUE(intact->stress_is_known());
}

// All fibres of one oblique layer are cut off, and each is tied to several others.
TEST(IntactStructure, OfAThinObliqueWallFillsByItsLength) {
  const auto nonzeros = [](int fibres) {
    return static_cast<double>(
        intact_structure(test::small_scene(30.0, 1, fibres))->structure().factor().nonzeros());
  };
  EXPECT_LT(nonzeros(60) / nonzeros(30), 2.3);
}

TEST(IntactStructure, OfALargeWallKeepsWhatRepeatsItselfOnce) {
  HAVERS_SLOW;
  for (const auto& [degrees, part] : {std::pair{0.0, 0.5}, {30.0, 0.8}, {90.0, 0.8}}) {
    SCOPED_TRACE(degrees);
    Scene scene = test::small_scene(degrees, 70, 50);
    const auto intact = intact_structure(scene);
    scene.solver.leave_out = false;
    const auto all = intact_structure(scene);
    EXPECT_LT(static_cast<double>(intact->structure().factor().values()),
              part * static_cast<double>(all->structure().factor().values()));
    const auto reactions_of = [](const IntactStructure& wall) {
      return wall.structure().reactions_to({wall.jump(7)}, Eigen::Vector2d(1.0, -0.5));
    };
    EXPECT_LT((reactions_of(*intact) - reactions_of(*all)).norm(),
              1e-9 * reactions_of(*all).norm());
  }
}

TEST(IntactStructure, RemembersWhatItWasAsked) {
  const auto intact = intact_structure(test::small_scene(30.0));
  EXPECT_EQ(intact->jump(3), intact->jump(3));
  EXPECT_NE(intact->jump(3), intact->jump(4));
}

TEST(IntactStructure, SeesHowFarSinglePrecisionMisses) {
  for (const double degrees : test::orientations) {
    SCOPED_TRACE(degrees);
    const auto intact = intact_structure(test::small_scene(degrees, 14, 10));
    std::vector<SharedJump> jumps;
    for (int joint = 0; joint < static_cast<int>(intact->structure().joints()); joint += 3)
      jumps.push_back(intact->jump(joint));
    const Eigen::VectorXd y = Eigen::VectorXd::Random(2 * static_cast<Eigen::Index>(jumps.size()));
    const Eigen::VectorXd exact = intact->structure().reactions_to(jumps, y);
    const auto [nearly, off_balance] = intact->nearly_reactions_to(jumps, y);
    EXPECT_GT(off_balance, 0.0);
    EXPECT_LT(off_balance, 1e-3 * exact.lpNorm<Eigen::Infinity>());
    EXPECT_LT((nearly.cast<double>() - exact).lpNorm<Eigen::Infinity>(), 3.0 * off_balance);
  }
}

// Nothing the first time, and only what is wanted from then on.
TEST(IntactStructure, MakesColumnsOfWhatIsAskedForAgain) {
  const auto intact = intact_structure(test::small_scene(17.0, 14, 10));
  const SharedJump jump = intact->jump(7);
  EXPECT_EQ(intact->column(jump, true), nullptr);
  EXPECT_EQ(intact->column(jump, false), nullptr);
  const IntactStructure::SharedColumn column = intact->column(jump, true);
  ASSERT_NE(column, nullptr);
  EXPECT_EQ(intact->column(jump, false), column);
  const Eigen::Vector2d y(1.0, -0.5);
  const Eigen::VectorXd exact = intact->structure().reactions_to({jump}, y);
  EXPECT_LT((column->reactions.cast<double>() * y - exact).lpNorm<Eigen::Infinity>(),
            3.0 * column->off_balance * y.lpNorm<1>());
  EXPECT_GT(intact->columns_of_a_glance(), 10);
  EXPECT_LT(intact->columns_of_a_glance(), intact->structure().joints());
}

}  // namespace
}  // namespace havers::sim
