#include "sim/assembly/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace havers::sim {
namespace {

using Eigen::Vector2d;

constexpr double tolerance = 1e-12;

Polygon turned_rectangle(const Vector2d& corner, double angle, double length, double height) {
  const Vector2d axis(std::cos(angle), std::sin(angle)), across(-axis.y(), axis.x());
  return {{corner, EdgeOrigin::lower},
          {corner + length * axis, EdgeOrigin::head},
          {corner + length * axis + height * across, EdgeOrigin::upper},
          {corner + height * across, EdgeOrigin::tail}};
}

std::vector<EdgeOrigin> origins(const Polygon& polygon) {
  std::vector<EdgeOrigin> list;
  for (const Vertex& vertex : polygon) list.push_back(vertex.edge);
  std::sort(list.begin(), list.end());
  return list;
}

TEST(Clip, LeavesWhatIsInsideAsItIs) {
  const Polygon whole = turned_rectangle({2.0, 1.0}, 0.3, 3.0, 1.0);
  const Polygon clipped = clip(whole, 10.0, 10.0, tolerance);
  ASSERT_EQ(clipped.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(clipped[i].position, whole[i].position);
    EXPECT_EQ(clipped[i].edge, whole[i].edge);
  }
}

TEST(Clip, LeavesNothingOfWhatIsOutside) {
  EXPECT_TRUE(clip(turned_rectangle({11.0, 1.0}, 0.3, 3.0, 1.0), 10.0, 10.0, tolerance).empty());
  EXPECT_TRUE(clip(turned_rectangle({1.0, -2.0}, 0.0, 3.0, 1.0), 10.0, 10.0, tolerance).empty());
}

TEST(Clip, LeavesNothingOfWhatOnlyTouches) {
  EXPECT_TRUE(clip(turned_rectangle({10.0, 1.0}, 0.0, 3.0, 1.0), 10.0, 10.0, tolerance).empty());
}

// The pieces in the cells of a grid make up the whole.
TEST(Clip, LosesNoAreaOverAGridOfRectangles) {
  for (const double angle : {0.0, 0.1, 0.7853981633974483, 1.2, 1.5707963267948966, 2.5}) {
    const Polygon whole = turned_rectangle({3.6, 2.0}, angle, 3.0, 1.5);
    double sum = 0.0;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 6; ++j) {
        const Vector2d cell(i, j);
        Polygon moved = whole;
        for (Vertex& vertex : moved) vertex.position -= cell;
        const Polygon piece = clip(moved, 1.0, 1.0, tolerance);
        if (piece.empty()) continue;
        sum += area(piece);
      }
    EXPECT_NEAR(sum, 4.5, 1e-10);
  }
}

TEST(Clip, RemembersWhichEdgesAreTheFibresOwn) {
  const Polygon cut = clip(turned_rectangle({-1.0, 4.0}, 0.0, 3.0, 1.0), 10.0, 10.0, tolerance);
  EXPECT_EQ(origins(cut), (std::vector{EdgeOrigin::head, EdgeOrigin::lower, EdgeOrigin::upper,
                                       EdgeOrigin::boundary}));
  EXPECT_DOUBLE_EQ(area(cut), 2.0);
}

// A corner on the side itself: the edge that goes on outside is the boundary's from there.
TEST(Clip, HandsTheEdgeThatLeavesAtACornerToTheBoundary) {
  const Polygon diamond{{{0.0, 2.0}, EdgeOrigin::lower},
                        {{2.0, 0.0}, EdgeOrigin::head},
                        {{4.0, 2.0}, EdgeOrigin::upper},
                        {{2.0, 4.0}, EdgeOrigin::tail}};
  const Polygon lower = clip(diamond, 10.0, 2.0, tolerance);
  EXPECT_EQ(origins(lower),
            (std::vector{EdgeOrigin::head, EdgeOrigin::lower, EdgeOrigin::boundary}));
  EXPECT_DOUBLE_EQ(area(lower), 4.0);
}

TEST(Clip, TakesWhatIsNearerThanTheToleranceToLieOnTheSide) {
  const Polygon over = turned_rectangle({0.0, -1e-13}, 0.0, 1.0, 1.0);
  const Polygon clipped = clip(over, 1.0, 2.0, tolerance);
  ASSERT_EQ(clipped.size(), 4U);
  EXPECT_EQ(clipped[0].edge, EdgeOrigin::lower);
}

TEST(Polygon, KnowsAreaAndMiddleOfATriangle) {
  const Polygon triangle{{{1.0, 1.0}, EdgeOrigin::lower},
                         {{4.0, 1.0}, EdgeOrigin::head},
                         {{1.0, 3.0}, EdgeOrigin::tail}};
  EXPECT_DOUBLE_EQ(area(triangle), 3.0);
  EXPECT_LT((mean_corner(triangle) - Vector2d(2.0, 5.0 / 3.0)).norm(), 1e-15);
}

}  // namespace
}  // namespace havers::sim
