// Convex polygons whose edges remember where they came from, and their clipping.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace havers::sim {

/// Where an edge of a half fibre's polygon comes from: a side of the half fibre, or the specimen's
/// boundary.
enum class EdgeOrigin { tail, head, lower, upper, boundary };

/// A vertex and the origin of the edge that starts there.
struct Vertex {
  Eigen::Vector2d position;  ///< [m]
  EdgeOrigin edge;
};

/// Convex, anticlockwise.
using Polygon = std::vector<Vertex>;

/// What of `polygon` lies in the rectangle [0, width] x [0, height]; points nearer to a side than
/// `tolerance` [m] count as on it. Empty when nothing is left.
Polygon clip(Polygon polygon, double width, double height, double tolerance);

double area(const Polygon& polygon);                  ///< [m²]
Eigen::Vector2d mean_corner(const Polygon& polygon);  ///< Inside a convex polygon. [m]

}  // namespace havers::sim
