#include "sim/structure/structure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/sim/structure/dense_structure.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The step that a wave needs for `fibres` fibre lengths.
Shift shift_of(double fibres, const Material& material) {
  const double c = std::sqrt(material.young / material.density), h = fibres * 100e-6 / c;
  return {1.0 / (h * h), 1.0};
}

StructureLoads no_loads(const Bodies& bodies) {
  return {VectorXd::Zero(bodies.dofs()), VectorXd::Zero(bodies.dofs()),
          VectorXd::Zero(2 * static_cast<Index>(bodies.assembly().joints.size()))};
}

StructureLoads random_loads(const Bodies& bodies, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  StructureLoads loads = no_loads(bodies);
  for (Index i = 0; i < bodies.dofs(); ++i) {
    loads.forces(i) = 1e3 * normal(random);
    if (bodies.held()[static_cast<std::size_t>(i)] != 0)
      loads.prescribed(i) = 1e-7 * normal(random);
  }
  for (double& jump : loads.jumps) jump = 1e-7 * normal(random);
  return loads;
}

class PatchProperty : public testing::TestWithParam<std::tuple<double, Lateral>> {};
INSTANTIATE_TEST_SUITE_P(OrientationAndSides, PatchProperty,
                         testing::Combine(testing::ValuesIn(test::orientations),
                                          testing::Values(Lateral::periodic, Lateral::free)));

// (M1): uniform stress is in exact equilibrium with joint forces traction · s. With inertia, the
// field (x, −ν y) takes the body forces αM u.
TEST_P(PatchProperty, HoldsFromSmallToHugeSteps) {
  const auto [degrees, lateral] = GetParam();
  const Scene scene = test::small_scene(degrees);
  const Material& material = scene.material;
  const Assembly assembly = build_assembly(scene.assembly, lateral);
  VectorXd u(2 * static_cast<Index>(assembly.nodes.size()));
  for (std::size_t i = 0; i < assembly.nodes.size(); ++i)
    u.segment<2>(static_cast<Index>(2 * i)) << assembly.nodes[i].x(),
        -material.poisson * assembly.nodes[i].y();
  VectorXd expected(2 * static_cast<Index>(assembly.joints.size()));
  for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
    const Joint& joint = assembly.joints[j];
    const double pull = -material.young * joint.normal.x() * joint.length;
    expected.segment<2>(static_cast<Index>(2 * j)) << pull * joint.normal.x(),
        pull * joint.tangent().x();
  }

  for (const double size : {1e-3, 0.1, 1.0, 30.0, 1e3, 1e6}) {
    const Shift shift = shift_of(size, material);
    const Bodies bodies(assembly, material, shift);
    const Structure structure(bodies);
    ASSERT_TRUE(structure.ok());
    StructureLoads loads = no_loads(bodies);
    loads.forces = shift.alpha * bodies.mass().cwiseProduct(u);
    for (const int node : assembly.right) loads.prescribed(2 * node) = assembly.width;
    const StructureResponse response = structure.solve(loads);
    SCOPED_TRACE(testing::Message() << "h c/L = " << size);
    EXPECT_LT((response.displacements - u).norm() / u.norm(), 1e-8);
    // In small steps the forces of inertia that cancel here are far larger than the joints'.
    const double accuracy = size < 0.1 ? 1e-8 : 1e-9;
    EXPECT_LT((response.reactions - expected).norm() / expected.norm(), accuracy);
    EXPECT_LT(response.tie_forces.size() == 0 ? 0.0 : response.tie_forces.cwiseAbs().maxCoeff(),
              accuracy * expected.cwiseAbs().maxCoeff());
    EXPECT_LT(response.residual, 1e-5);
  }
}

struct Tiny {
  double degrees;
  Lateral lateral;
  double size;  // h c/L
  double layer_contrast = 1.0;
};

class TinyStructure : public testing::TestWithParam<Tiny> {
 protected:
  static Scene scene_of(const Tiny& tiny) {
    Scene scene = test::small_scene(tiny.degrees, 3, 2);
    scene.material.layer_contrast = tiny.layer_contrast;
    return scene;
  }
  Scene scene = scene_of(GetParam());
  Assembly assembly = build_assembly(scene.assembly, GetParam().lateral);
  Shift shift = shift_of(GetParam().size, scene.material);
  Bodies bodies{assembly, scene.material, shift};
  test::DenseStructure dense{assembly, scene.material, shift};
};
INSTANTIATE_TEST_SUITE_P(
    , TinyStructure,
    testing::Values(Tiny{0.0, Lateral::periodic, 0.3}, Tiny{0.0, Lateral::free, 5.0},
                    Tiny{45.0, Lateral::periodic, 1.0}, Tiny{30.0, Lateral::periodic, 1.0, 0.05},
                    Tiny{-25.0, Lateral::free, 20.0}, Tiny{90.0, Lateral::periodic, 20.0}));

TEST_P(TinyStructure, AnswersRandomLoadsAsTheFullEquationsDo) {
  const Structure structure(bodies);
  for (const unsigned seed : {1U, 2U}) {
    const StructureLoads loads = random_loads(bodies, seed);
    const auto truth = dense.solve(loads);
    const StructureResponse found = structure.solve(loads);
    EXPECT_LT((found.displacements - truth.displacements).norm() / truth.displacements.norm(),
              1e-8);
    EXPECT_LT((found.reactions - truth.reactions).norm() / truth.reactions.norm(), 1e-8);
  }
}

// Every third joint of each way: open with a force that is given, and sliding with friction.
TEST_P(TinyStructure, LetsJointsOpenAndSlide) {
  std::vector<Held> held(assembly.joints.size(), Held::fully);
  StructureLoads loads = random_loads(bodies, 3);
  loads.given = 0.1 * loads.forces.norm() * random_loads(bodies, 6).jumps.normalized();
  loads.friction = VectorXd::Zero(static_cast<Index>(held.size()));
  for (std::size_t j = 0; j < held.size(); ++j) {
    if (j % 3 == 0) held[j] = Held::not_at_all;
    if (j % 3 != 1) continue;
    held[j] = Held::normal;
    loads.friction(static_cast<Index>(j)) = j % 2 == 0 ? 0.8 : -0.3;
  }
  const Structure structure(bodies, held);
  ASSERT_TRUE(structure.ok());
  const auto truth = dense.solve(loads, held);
  const StructureResponse found = structure.solve(loads);
  EXPECT_LT((found.displacements - truth.displacements).norm() / truth.displacements.norm(), 1e-8);
  EXPECT_LT((found.reactions - truth.reactions).norm() / truth.reactions.norm(), 1e-8);

  const StructureResponse bonded = Structure(bodies).solve(random_loads(bodies, 3));
  loads.near = &bonded;  // another structure's
  const StructureResponse from_bonded = structure.solve(loads);
  EXPECT_LT((from_bonded.displacements - truth.displacements).norm() / truth.displacements.norm(),
            1e-8);
  EXPECT_LT((from_bonded.reactions - truth.reactions).norm() / truth.reactions.norm(), 1e-8);
  loads.near = &found;
  EXPECT_LE(structure.solve(loads).solves, found.solves);
}

// Each joint in each way beside its neighbour, with one factor.
TEST_P(TinyStructure, IsCorrectedWhereFewJointsHoldInAnotherWay) {
  std::vector<Held> held(assembly.joints.size());
  for (std::size_t j = 0; j < held.size(); ++j) held[j] = static_cast<Held>((j + j / 3) % 3);
  Structure structure(bodies, held);
  StructureLoads loads = random_loads(bodies, 3);
  for (const double friction : {0.0, 0.3})
    for (std::size_t j = 0; j < held.size(); ++j)
      for (const Held now : {Held::fully, Held::normal, Held::not_at_all}) {
        std::vector<Held> other = held;
        other[j] = now;
        if (j + 1 < held.size()) other[j + 1] = held[j];
        loads.friction = VectorXd::Constant(static_cast<Index>(held.size()), friction);
        if (!structure.hold_nearby(other)) {
          EXPECT_GT(GetParam().size, 10.0) << "single precision loses what inertia holds";
          EXPECT_EQ(structure.held(), held);
          return;
        }
        EXPECT_EQ(structure.is_corrected(), other != held);
        const Structure made(bodies, other);
        const StructureResponse found = structure.solve(loads), expected = made.solve(loads);
        EXPECT_LT((found.reactions - expected.reactions).norm(), 1e-9 * expected.reactions.norm());
        EXPECT_LT((found.gaps - expected.gaps).norm(), 1e-9 * expected.gaps.norm());
        EXPECT_LE(found.solves, expected.solves + 3);  // in single precision, where all hold well
      }
}

TEST(Structure, KeepsItsFactorForFewJointsOnly) {
  const Scene scene = test::small_scene(0.0, 14, 10);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::periodic);
  const Bodies bodies(assembly, scene.material, shift_of(0.3, scene.material));
  std::vector<Held> held(assembly.joints.size(), Held::fully), more = held;
  Structure structure(bodies, held);
  EXPECT_FALSE(structure.hold_nearby(held)) << "nothing slides";
  held[0] = Held::normal;
  structure.hold(held);
  EXPECT_TRUE(structure.hold_nearby(held));
  EXPECT_FALSE(structure.is_corrected());
  std::fill_n(more.begin(), 50, Held::not_at_all);
  EXPECT_TRUE(structure.hold_nearby(more));
  EXPECT_EQ(structure.held(), more);
  const StructureLoads loads = random_loads(bodies, 5);
  const Eigen::VectorXd expected = Structure(bodies, more).solve(loads).reactions;
  EXPECT_LT((structure.solve(loads).reactions - expected).norm(), 1e-9 * expected.norm());
  more[50] = Held::not_at_all;
  EXPECT_FALSE(structure.hold_nearby(more));
  EXPECT_NE(structure.held(), more);
}

TEST_P(TinyStructure, HeldInAnotherWayIsAsOneMadeForThat) {
  std::vector<Held> held(assembly.joints.size(), Held::fully);
  for (std::size_t j = 0; j < held.size(); j += 3) held[j] = Held::not_at_all;
  held[1] = Held::normal;
  Structure structure(bodies);
  const StructureLoads loads = random_loads(bodies, 7);
  for (const auto& now : {held, std::vector<Held>(held.size(), Held::not_at_all), held}) {
    structure.hold(now);
    const Structure made(bodies, now);
    ASSERT_TRUE(structure.ok() && made.ok());
    EXPECT_EQ(structure.held(), now);
    EXPECT_EQ(structure.solve(loads).reactions, made.solve(loads).reactions);
  }
}

// There is nothing to correct, and no correction to be smaller than.
TEST_P(TinyStructure, BearsNothingWhereNothingActsWhereverItStarts) {
  const Structure structure(bodies);
  StructureLoads loads = no_loads(bodies);
  const StructureResponse first = structure.solve(loads);
  loads.near = &first;
  for (const StructureResponse& found : {first, structure.solve(loads)}) {
    EXPECT_EQ(found.reactions.norm(), 0.0);
    EXPECT_EQ(found.residual, 0.0);
  }
}

// What it says of its error is not far below what that is, however little accuracy is asked for.
// Friction in every second joint makes corrections many.
TEST_P(TinyStructure, ErrsByLittleMoreThanItSays) {
  std::vector<Held> held(assembly.joints.size(), Held::fully);
  StructureLoads loads = random_loads(bodies, 1);
  loads.friction = VectorXd::Zero(static_cast<Index>(held.size()));
  for (std::size_t j = 1; j < held.size(); j += 2) {
    held[j] = Held::normal;
    loads.friction(static_cast<Index>(j)) = j % 4 == 1 ? 0.3 : -0.3;
  }
  const VectorXd truth = dense.solve(loads, held).reactions;
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    loads.accuracy = accuracy;
    const StructureResponse found = Structure(bodies, held).solve(loads);
    EXPECT_LT((found.reactions - truth).norm(), (10.0 * found.residual + 1e-10) * truth.norm());
  }
}

TEST_P(TinyStructure, HoldsNothingTogetherWhenAllIsDetached) {
  const std::vector<Held> all(assembly.joints.size(), Held::not_at_all);
  const Structure structure(bodies, all);
  ASSERT_TRUE(structure.ok());
  const StructureLoads loads = random_loads(bodies, 4);
  const auto truth = dense.solve(loads, all);
  const StructureResponse found = structure.solve(loads);
  EXPECT_EQ(found.reactions.norm(), 0.0);
  EXPECT_LT((found.displacements - truth.displacements).norm() / truth.displacements.norm(), 1e-8);
}

// Unit jumps, with gaps of detached joints that follow.
TEST_P(TinyStructure, AnswersJumpsAsTheFullEquationsDo) {
  std::vector<Held> held(assembly.joints.size(), Held::fully);
  held.front() = Held::not_at_all;
  const Structure structure(bodies, held);
  const auto jump_at = [&](int joint) {
    return std::make_shared<const Jump>(structure.jump(joint));
  };
  const SharedJump other = jump_at(3);
  for (const int joint : {1, 2, static_cast<int>(held.size()) - 1}) {
    const SharedJump jump = jump_at(joint);
    const Eigen::MatrixXd reactions = structure.reactions_to({jump}, Eigen::Matrix2d::Identity());
    for (const SharedJump& to : {jump, other}) {
      const Eigen::Matrix2d at_once = structure.reactions_of(*to, {jump});
      EXPECT_LT((at_once - reactions.middleRows<2>(2 * to->joint)).norm(), 1e-9 * at_once.norm());
    }
    for (const Index component : {0, 1}) {
      StructureLoads loads = no_loads(bodies);
      loads.jumps(2 * joint + component) = 1.0;
      const auto truth = dense.solve(loads, held);
      const VectorXd gaps = (dense.C * truth.displacements).head(loads.jumps.size());
      EXPECT_LT((reactions.col(component) - truth.reactions).norm(), 1e-8 * truth.reactions.norm());
      EXPECT_LT((structure.solve(loads).gaps - gaps).norm(), 1e-8 * gaps.norm());
    }
  }
}

TEST_P(TinyStructure, SharesOperatorsWithoutChangingTheAnswer) {
  const Bodies apart(assembly, scene.material, shift, false);
  EXPECT_EQ(apart.classes().size(), assembly.bodies.size());
  const StructureLoads loads = random_loads(bodies, 5);
  const VectorXd shared = Structure(bodies).solve(loads).reactions,
                 own = Structure(apart).solve(loads).reactions;
  EXPECT_LT((shared - own).norm() / own.norm(), 1e-9);
}

TEST_P(TinyStructure, MultipliesByTheMatricesOfTheWhole) {
  const VectorXd q = VectorXd::Random(bodies.dofs());
  EXPECT_LT((bodies.stiffness_times(q) - dense.K * q).norm(), 1e-13 * (dense.K * q).norm());
  EXPECT_LT((bodies.shifted_times(q) - dense.A * q).norm(), 1e-13 * (dense.A * q).norm());
}

}  // namespace
}  // namespace havers::sim
