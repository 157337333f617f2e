#include "sim/structure/dissection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "sim/structure/disjoint_sets.hpp"
#include "sim/structure/elimination_tree.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

std::vector<std::array<int, 2>> bodies_of_joints(const Assembly& assembly) {
  std::vector<std::array<int, 2>> bodies;
  for (const Joint& joint : assembly.joints) bodies.push_back({joint.body_a, joint.body_b});
  return bodies;
}

class DissectionAt : public testing::TestWithParam<double> {};

// The last cut leaves two parts, one of them at most twice the other.
TEST_P(DissectionAt, PartsAWall) {
  const Scene scene = test::small_scene(GetParam(), 20, 30);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
  const std::vector<int> part = dissection(assembly, bodies_of_joints(assembly));
  ASSERT_EQ(part.size(), assembly.joints.size());
  const int last = *std::max_element(part.begin(), part.end());
  DisjointSets pieces(assembly.bodies.size());
  for (std::size_t j = 0; j < part.size(); ++j)
    if (part[j] != last)
      pieces.unite(static_cast<std::size_t>(assembly.joints[j].body_a),
                   static_cast<std::size_t>(assembly.joints[j].body_b));
  std::vector<std::size_t> sizes(assembly.bodies.size(), 0);
  for (std::size_t body = 0; body < sizes.size(); ++body) ++sizes[pieces.find(body)];
  const auto largest = *std::max_element(sizes.begin(), sizes.end());
  EXPECT_LE(3 * largest, 2 * assembly.bodies.size());
  EXPECT_GT(largest, assembly.bodies.size() / 4);
}

// Of a wall twice as wide and as high: four times as many pieces that are cut no further, and twice
// as many joints in the last cut, as it is a line.
TEST_P(DissectionAt, GoesOnToPiecesOfOneSizeByLines) {
  std::array<int, 2> parts{};
  std::array<double, 2> cut{};
  for (const std::size_t k : {0U, 1U}) {
    const int side = k == 0 ? 20 : 40;
    const Scene scene = test::small_scene(GetParam(), side, side);
    const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
    const std::vector<int> part = dissection(assembly, bodies_of_joints(assembly));
    parts[k] = *std::max_element(part.begin(), part.end()) + 1;
    cut[k] = static_cast<double>(std::count(part.begin(), part.end(), parts[k] - 1));
  }
  EXPECT_GT(parts[1], 3 * parts[0]);
  EXPECT_LT(parts[1], 5 * parts[0]);
  EXPECT_LT(cut[1], 2.2 * cut[0]);
}

// Joints feel those of their two bodies.
Graph graph_of(const std::vector<std::array<int, 2>>& bodies, std::size_t count) {
  std::vector<std::vector<int>> joints(count);
  for (std::size_t j = 0; j < bodies.size(); ++j)
    for (const int body : bodies[j])
      joints[static_cast<std::size_t>(body)].push_back(static_cast<int>(j));
  std::vector<Eigen::Triplet<char>> entries;
  for (const std::vector<int>& own : joints)
    for (const int a : own)
      for (const int b : own)
        if (a >= b) entries.emplace_back(a, b, char{1});
  const auto n = static_cast<Eigen::Index>(bodies.size());
  Graph graph(n, n);
  graph.setFromTriplets(entries.begin(), entries.end(), [](char, char) { return char{1}; });
  return graph;
}

// What it wins is that a factor repeats itself; that costs little.
TEST_P(DissectionAt, FillsLittleMoreThanTheLeastDegree) {
  const Scene scene = test::small_scene(GetParam(), 40, 40);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
  const auto bodies = bodies_of_joints(assembly);
  const Graph graph = graph_of(bodies, assembly.bodies.size());
  const std::vector<int> sizes(bodies.size(), 1);
  const double least = cost_of(graph, least_degree_order(graph), sizes).nonzeros;
  const auto by_parts = least_degree_order(graph, dissection(assembly, bodies));
  EXPECT_LT(cost_of(graph, by_parts, sizes).nonzeros, 1.6 * least);
}

INSTANTIATE_TEST_SUITE_P(Degrees, DissectionAt, testing::Values(0.0, 30.0, 45.0, 90.0));

TEST(Dissection, LeavesASmallWallInOnePart) {
  const Scene scene = test::small_scene(45.0, 4, 4);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
  for (const int part : dissection(assembly, bodies_of_joints(assembly))) EXPECT_EQ(part, 0);
}

}  // namespace
}  // namespace havers::sim
