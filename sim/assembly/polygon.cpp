#include "sim/assembly/polygon.hpp"

#include <array>

namespace havers::sim {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Distance of a point from one side of the rectangle, positive inside.
struct Side {
  Vector2d inward;
  double offset;
  [[nodiscard]] double distance(const Vector2d& p) const { return inward.dot(p) + offset; }
};

// One step of Sutherland and Hodgman's clipping. Points on the side (within tolerance) are kept as
// they are, so that polygons sharing an edge are cut at the same points.
Polygon clip_by(const Polygon& polygon, const Side& side, double tolerance) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex& from = polygon[i];
    const Vertex& to = polygon[(i + 1) % polygon.size()];
    const double d_from = side.distance(from.position);
    const double d_to = side.distance(to.position);
    const bool crosses =
        (d_from < -tolerance && d_to > tolerance) || (d_from > tolerance && d_to < -tolerance);
    const auto crossing = [&] {
      return Vector2d(from.position + d_from / (d_from - d_to) * (to.position - from.position));
    };
    if (d_from >= -tolerance) {
      const bool leaves =
          d_to < -tolerance && !crosses;  // the rest of this edge runs along the side
      kept.push_back({from.position, leaves ? EdgeOrigin::boundary : from.edge});
      if (crosses) kept.push_back({crossing(), EdgeOrigin::boundary});
    } else if (crosses) {
      kept.push_back({crossing(), from.edge});
    }
  }
  return kept;
}

}  // namespace

double area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i].position - polygon[0].position,
                   polygon[i + 1].position - polygon[0].position);
  return 0.5 * twice;
}

Vector2d mean_corner(const Polygon& polygon) {
  Vector2d sum = Vector2d::Zero();
  for (const Vertex& vertex : polygon) sum += vertex.position;
  return sum / static_cast<double>(polygon.size());
}

Polygon clip(Polygon polygon, double width, double height, double tolerance) {
  const std::array<Side, 4> sides{Side{{1.0, 0.0}, 0.0}, Side{{-1.0, 0.0}, width},
                                  Side{{0.0, 1.0}, 0.0}, Side{{0.0, -1.0}, height}};
  for (const Side& side : sides) polygon = clip_by(polygon, side, tolerance);

  Polygon distinct;  // without edges of no length
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex& next = polygon[(i + 1) % polygon.size()];
    if ((next.position - polygon[i].position).norm() > tolerance) distinct.push_back(polygon[i]);
  }
  return distinct.size() < 3 ? Polygon{} : distinct;
}

}  // namespace havers::sim
