#include "sim/structure/dissection.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/structure/disjoint_sets.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

std::vector<std::array<int, 2>> bodies_of_joints(const Assembly& assembly) {
  std::vector<std::array<int, 2>> bodies;
  for (const Joint& joint : assembly.joints) bodies.push_back({joint.body_a, joint.body_b});
  return bodies;
}

class DissectionAt : public testing::TestWithParam<double> {};

// The last cut leaves two parts, one of them at most twice the other, and is about as short as the
// wall is wide.
TEST_P(DissectionAt, PartsAWall) {
  const Scene scene = test::small_scene(GetParam(), 20, 30);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
  const std::vector<int> part = dissection(assembly, bodies_of_joints(assembly));
  ASSERT_EQ(part.size(), assembly.joints.size());
  const int last = *std::max_element(part.begin(), part.end());
  EXPECT_GT(last, 4);
  EXPECT_LT(std::count(part.begin(), part.end(), last), 3 * 20);

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

INSTANTIATE_TEST_SUITE_P(Degrees, DissectionAt, testing::Values(0.0, 30.0, 45.0, 90.0));

TEST(Dissection, LeavesASmallWallInOnePart) {
  const Scene scene = test::small_scene(45.0, 4, 4);
  const Assembly assembly = build_assembly(scene.assembly, Lateral::free);
  for (const int part : dissection(assembly, bodies_of_joints(assembly))) EXPECT_EQ(part, 0);
}

}  // namespace
}  // namespace havers::sim
