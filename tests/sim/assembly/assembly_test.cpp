#include "sim/assembly/assembly.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

using Eigen::Vector2d;

const Vector2d& node(const Assembly& assembly, int i) {
  return assembly.nodes[static_cast<std::size_t>(i)];
}

double area_of(const Assembly& assembly, const std::array<int, 3>& nodes) {
  const Vector2d a = node(assembly, nodes[1]) - node(assembly, nodes[0]),
                 b = node(assembly, nodes[2]) - node(assembly, nodes[0]);
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

long count(const Assembly& assembly, JointKind kind) {
  return std::count_if(assembly.joints.begin(), assembly.joints.end(),
                       [&](const Joint& joint) { return joint.kind == kind; });
}

double total_length(const Assembly& assembly) {
  double sum = 0.0;
  for (const Joint& joint : assembly.joints) sum += joint.length;
  return sum;
}

// Edges that belong to one triangle of their body only.
double total_perimeter_of_bodies(const Assembly& assembly) {
  double sum = 0.0;
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : assembly.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  for (const auto& [edge, n] : uses)
    if (n == 1) sum += (node(assembly, edge.first) - node(assembly, edge.second)).norm();
  return sum;
}

TEST(Assembly, HasThePapersCountsAt21By30) {
  const Assembly assembly = build_assembly({.layers = 30, .fibres = 21}, Lateral::periodic);
  EXPECT_EQ(assembly.bodies.size(), 645U);
  EXPECT_EQ(assembly.nodes.size(), 5070U);
  EXPECT_EQ(count(assembly, JointKind::head_tail), 615);
  EXPECT_EQ(count(assembly, JointKind::flank), 1218);
  EXPECT_EQ(assembly.ties.size(), 42U);
  EXPECT_EQ(assembly.dropped, 0);
  const auto halves = std::count_if(assembly.bodies.begin(), assembly.bodies.end(),
                                    [](const Body& body) { return body.triangles == 4; });
  const auto whole = std::count_if(assembly.bodies.begin(), assembly.bodies.end(),
                                   [](const Body& b) { return b.triangles == 8 && b.nodes == 8; });
  EXPECT_EQ(halves, 30);
  EXPECT_EQ(whole, 615);
}

class AssemblyAt : public testing::TestWithParam<std::tuple<double, int>> {
 protected:
  AssemblyOptions options{.layers = 7,
                          .fibres = 5,
                          .orientation = std::get<0>(GetParam()) * test::degree,
                          .refinement = std::get<1>(GetParam())};
  Assembly assembly = build_assembly(options, Lateral::periodic);
  double small = 1e-9 * options.fibre_height;
};
INSTANTIATE_TEST_SUITE_P(OrientationAndMesh, AssemblyAt,
                         testing::Combine(testing::ValuesIn(test::orientations),
                                          testing::Values(1, 2, 4)));
INSTANTIATE_TEST_SUITE_P(Negative, AssemblyAt,
                         testing::Combine(testing::Values(-30.0, -89.0), testing::Values(1, 2)));

TEST_P(AssemblyAt, FillsTheRectangle) {
  double sum = 0.0;
  for (const auto& triangle : assembly.triangles) {
    const double area = area_of(assembly, triangle);
    EXPECT_GT(area, 0.0);
    sum += area;
  }
  EXPECT_NEAR(sum / (options.width() * options.height()), 1.0, 1e-11);
  EXPECT_EQ(assembly.dropped, 0);
}

// Every body's outline is either joined to another body's or part of the rectangle's.
TEST_P(AssemblyAt, JoinsAllThatTouches) {
  const double outside = 2.0 * (options.width() + options.height());
  EXPECT_NEAR(total_perimeter_of_bodies(assembly) / (2.0 * total_length(assembly) + outside), 1.0,
              1e-10);
}

// How two joints at one place share their force would not be determined.
TEST_P(AssemblyAt, HasNoJointTwice) {
  for (std::size_t i = 0; i < assembly.joints.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((assembly.joints[i].position - assembly.joints[j].position).norm(), small);
}

TEST_P(AssemblyAt, HasTheSameEdgeOnBothSidesOfAJoint) {
  for (const Joint& joint : assembly.joints) {
    const Vector2d a0 = node(assembly, joint.edge_a.front()),
                   a1 = node(assembly, joint.edge_a.back()),
                   b0 = node(assembly, joint.edge_b.front()),
                   b1 = node(assembly, joint.edge_b.back());
    const double same = (a0 - b0).norm() + (a1 - b1).norm(),
                 reversed = (a0 - b1).norm() + (a1 - b0).norm();
    EXPECT_LT(std::min(same, reversed), small);
    EXPECT_LT((0.5 * (a0 + a1) - joint.position).norm(), small);
    EXPECT_NEAR((a1 - a0).norm(), joint.length, small);
    EXPECT_NEAR(joint.normal.norm(), 1.0, 1e-14);
    EXPECT_NEAR(joint.normal.dot(a1 - a0), 0.0, small);
  }
}

TEST_P(AssemblyAt, TurnsNormalsFromAToB) {
  for (const Joint& joint : assembly.joints) {
    const auto reach = [&](int index, double sign) {  // how far a body goes to its own side
      const Body& body = assembly.bodies[static_cast<std::size_t>(index)];
      double farthest = 0.0;
      for (int i = body.first_node; i < body.first_node + body.nodes; ++i)
        farthest = std::max(farthest, sign * joint.normal.dot(node(assembly, i) - joint.position));
      return farthest;
    };
    EXPECT_NE(joint.body_a, joint.body_b);
    EXPECT_GT(reach(joint.body_a, -1.0), small);
    EXPECT_LT(reach(joint.body_a, 1.0), small);
    EXPECT_GT(reach(joint.body_b, 1.0), small);
    EXPECT_LT(reach(joint.body_b, -1.0), small);
  }
}

TEST_P(AssemblyAt, KeepsJointsWithinTheFibresSides) {
  const double angle = options.orientation;
  const Vector2d axis(std::cos(angle), std::sin(angle));
  for (const Joint& joint : assembly.joints) {
    const bool head_tail = joint.kind == JointKind::head_tail;
    EXPECT_NEAR(std::abs(joint.normal.dot(axis)), head_tail ? 1.0 : 0.0, 1e-14);
    EXPECT_LE(joint.length,
              (head_tail ? options.fibre_height : 0.5 * options.fibre_length) + small);
  }
}

TEST_P(AssemblyAt, GivesEveryNodeToOneBody) {
  int next_node = 0, next_triangle = 0;
  for (const Body& body : assembly.bodies) {
    EXPECT_EQ(body.first_node, next_node);
    EXPECT_EQ(body.first_triangle, next_triangle);
    next_node += body.nodes;
    next_triangle += body.triangles;
    for (int t = body.first_triangle; t < next_triangle; ++t)
      for (const int i : assembly.triangles[static_cast<std::size_t>(t)]) {
        EXPECT_GE(i, body.first_node);
        EXPECT_LT(i, next_node);
      }
  }
  EXPECT_EQ(next_node, static_cast<int>(assembly.nodes.size()));
  EXPECT_EQ(next_triangle, static_cast<int>(assembly.triangles.size()));
}

// The nodes on a side, but for those of bodies that only touch it with a corner.
TEST_P(AssemblyAt, FindsTheSides) {
  const auto held_on = [&](double x) {
    std::vector<int> nodes;
    for (const Body& body : assembly.bodies) {
      std::vector<int> own;
      for (int i = body.first_node; i < body.first_node + body.nodes; ++i)
        if (std::abs(node(assembly, i).x() - x) < small) own.push_back(i);
      if (own.size() > 1) nodes.insert(nodes.end(), own.begin(), own.end());
    }
    return nodes;
  };
  EXPECT_EQ(assembly.left, held_on(0.0));
  EXPECT_EQ(assembly.right, held_on(options.width()));
  EXPECT_LT(node(assembly, assembly.corner).norm(), small);
}

TEST_P(AssemblyAt, TiesPointsThatFaceEachOther) {
  ASSERT_FALSE(assembly.ties.empty());
  double before = 0.0;
  for (const Tie& tie : assembly.ties) {
    const Vector2d top = tie.weight_top[0] * node(assembly, tie.edge_top[0]) +
                         tie.weight_top[1] * node(assembly, tie.edge_top[1]);
    const Vector2d bottom = tie.weight_bottom[0] * node(assembly, tie.edge_bottom[0]) +
                            tie.weight_bottom[1] * node(assembly, tie.edge_bottom[1]);
    EXPECT_LT((top - bottom - Vector2d(0.0, options.height())).norm(), small);
    EXPECT_GT(top.x(), before);
    before = top.x();
  }
  EXPECT_LT(before, options.width());
  EXPECT_TRUE(build_assembly(options, Lateral::free).ties.empty());
}

TEST(Assembly, JoinsLayersAlongTheirWholeLengthAt0Degrees) {
  const AssemblyOptions options{.layers = 6, .fibres = 4};
  const Assembly assembly = build_assembly(options, Lateral::free);
  double flank = 0.0, head_tail = 0.0;
  for (const Joint& joint : assembly.joints)
    (joint.kind == JointKind::flank ? flank : head_tail) += joint.length;
  EXPECT_NEAR(flank, 5 * options.width(), 1e-15);
  EXPECT_NEAR(head_tail, (3 * 3 + 3 * 4) * options.fibre_height, 1e-15);
}

// A finer mesh is another mesh of the same wall: same fibres, same joints and ties in the same
// order.
TEST_P(AssemblyAt, IsTheSameWallOnEveryMesh) {
  AssemblyOptions coarse = options;
  coarse.refinement = 1;
  const Assembly other = build_assembly(coarse, Lateral::periodic);
  const auto k = static_cast<std::size_t>(options.refinement);
  EXPECT_EQ(assembly.bodies.size(), other.bodies.size());
  EXPECT_EQ(assembly.triangles.size(), k * k * other.triangles.size());
  ASSERT_EQ(assembly.joints.size(), other.joints.size());
  ASSERT_EQ(assembly.ties.size(), other.ties.size());
  for (std::size_t j = 0; j < assembly.joints.size(); ++j) {
    EXPECT_EQ(assembly.joints[j].edge_a.size(), k + 1);
    EXPECT_EQ(assembly.joints[j].body_b, other.joints[j].body_b);
    EXPECT_LT((assembly.joints[j].position - other.joints[j].position).norm(), small);
  }
}

TEST(MeanWeights, GiveTheMeanOfALinearPiecewiseFunction) {
  EXPECT_EQ(mean_weights(2), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(mean_weights(5), (std::vector<double>{0.125, 0.25, 0.25, 0.25, 0.125}));
}

class Slivers : public testing::TestWithParam<test::SliverWall> {};
INSTANTIATE_TEST_SUITE_P(Wall, Slivers, testing::ValuesIn(test::walls_with_slivers));

TEST_P(Slivers, AreDroppedAndTheirPlacesFilled) {
  const AssemblyOptions options = test::assembly_of(GetParam());
  const Assembly assembly = build_assembly(options, Lateral::periodic);
  EXPECT_GT(assembly.dropped, 0);
  double sum = 0.0;
  for (const auto& triangle : assembly.triangles) {
    EXPECT_GT(area_of(assembly, triangle), 0.0);
    sum += area_of(assembly, triangle);
  }
  EXPECT_NEAR(sum / (options.width() * options.height()), 1.0, 1e-9);
  const double outside = 2.0 * (options.width() + options.height());
  EXPECT_NEAR(total_perimeter_of_bodies(assembly) / (2.0 * total_length(assembly) + outside), 1.0,
              1e-9);
}

// At 45 degrees two edges of a sliver are equal: which of them is shifted is not left to rounding.
TEST(Assembly, FillsThePlaceOfSliversAlikeInAllUnits) {
  for (const auto& [fibres, slenderness] : {std::pair{1, 34.01}, {3, 26.67}}) {
    const AssemblyOptions options = test::assembly_of({1, fibres, slenderness, 45.0});
    const Assembly assembly = build_assembly(options, Lateral::free);
    EXPECT_GT(assembly.dropped, 0);
    for (const double unit : {37.48, 0.3, 7.7}) {
      AssemblyOptions scaled = options;
      scaled.fibre_length *= unit;
      scaled.fibre_height *= unit;
      const Assembly same = build_assembly(scaled, Lateral::free);
      ASSERT_EQ(same.nodes.size(), assembly.nodes.size());
      for (std::size_t i = 0; i < same.nodes.size(); ++i)
        EXPECT_LT((same.nodes[i] / unit - assembly.nodes[i]).norm(), 1e-9 * options.fibre_height);
    }
  }
}

// Edges a little off a side lie on it by rounding alone, however high the specimen is.
TEST(Ties, LieOnTheSidesOfAHighSpecimenToo) {
  const auto ties = [](int layers) {
    return build_assembly({.layers = layers, .fibres = 2, .orientation = 2e-5 * test::degree},
                          Lateral::periodic)
        .ties.size();
  };
  EXPECT_EQ(ties(5000), ties(1000));
}

TEST(Assembly, CanBeOneFibre) {
  const Assembly assembly = build_assembly({.layers = 1, .fibres = 1}, Lateral::periodic);
  EXPECT_EQ(assembly.bodies.size(), 1U);
  EXPECT_TRUE(assembly.joints.empty());
  EXPECT_EQ(assembly.ties.size(), 2U);
}

}  // namespace
}  // namespace havers::sim
