// Where top and bottom are tied. Joints are in assembly_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sim/assembly/assembly.hpp"
#include "tests/support/scenes.hpp"

namespace havers::sim {
namespace {

const Eigen::Vector2d& point_of(const Assembly& assembly, int node) {
  return assembly.nodes[static_cast<std::size_t>(node)];
}

// Corners on a side at that height, from left to right: ends of edges that one triangle has alone.
std::vector<double> corners_at(const Assembly& assembly, double y, double small) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : assembly.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(t[i], t[(i + 1) % 3])];
  std::vector<double> corners;
  for (const auto& [edge, n] : uses)
    for (const int end : {edge.first, edge.second})
      if (n == 1 && std::abs(point_of(assembly, edge.first).y() - y) < small &&
          std::abs(point_of(assembly, edge.second).y() - y) < small)
        corners.push_back(point_of(assembly, end).x());
  return corners;
}

// Wherever a corner of top or bottom lies, another pair of edges faces each other from there on:
// each pair is tied, in the middle of what it has in common, however little that is.
TEST(Ties, JoinEveryPairOfEdgesThatFaceEachOther) {
  for (const double degrees : {0.0, 17.3, 30.0, 45.0, 60.0, 77.7, 90.0, -30.0, -52.5, -89.0}) {
    const AssemblyOptions options{.layers = 7, .fibres = 5, .orientation = degrees * test::degree};
    const Assembly assembly = build_assembly(options, Lateral::periodic);
    const double small = 1e-7 * options.fibre_height;
    std::vector<double> corners = corners_at(assembly, 0.0, small);
    for (const double x : corners_at(assembly, options.height(), small)) corners.push_back(x);
    std::ranges::sort(corners);
    std::vector<double> middles;
    for (std::size_t i = 1; i < corners.size(); ++i)
      if (corners[i] - corners[i - 1] > small)
        middles.push_back(0.5 * (corners[i - 1] + corners[i]));
    ASSERT_EQ(assembly.ties.size(), middles.size()) << degrees;
    for (std::size_t i = 0; i < middles.size(); ++i) {
      const Tie& tie = assembly.ties[i];
      EXPECT_NEAR(tie.weight_top[0] * point_of(assembly, tie.edge_top[0]).x() +
                      tie.weight_top[1] * point_of(assembly, tie.edge_top[1]).x(),
                  middles[i], small)
          << degrees;
    }
  }
}

}  // namespace
}  // namespace havers::sim
