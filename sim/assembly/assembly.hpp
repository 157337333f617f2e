// Fibres, their triangles, and the joints between them. Section 1 of sim/README.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/scene.hpp"

namespace havers::sim {

/// Where two fibres of a layer meet, n along the fibre, or two layers, n across it.
enum class JointKind { head_tail, flank };

/// A fibre or what the clipping leaves of it. Bodies share no nodes.
struct Body {
  int first_node = 0, nodes = 0;          ///< Nodes follow each other.
  int first_triangle = 0, triangles = 0;  ///< Triangles likewise.
  int layer = 0;                          ///< Of the running bond; 0 lies on the lower left corner.
  int column = 0;  ///< Of its first half fibre, also where the clipping left none of that.
};

/// An edge between two bodies, bonded at its midpoint. Side a lies where −n points, side b where n
/// points: the gap is (u_b − u_a)·n and the slip (u_b − u_a)·t, u being the mean along the edge.
struct Joint {
  JointKind kind = JointKind::flank;
  int body_a = 0, body_b = 0;
  std::vector<int> edge_a, edge_b;     ///< Nodes along the edge on either side.
  Eigen::Vector2d position{0.0, 0.0};  ///< Midpoint. [m]
  Eigen::Vector2d normal{1.0, 0.0};    ///< n, unit. The tangent t is n turned by +90°. [-]
  double length = 0.0;                 ///< s. [m]

  [[nodiscard]] Eigen::Vector2d tangent() const { return {-normal.y(), normal.x()}; }
};

/// A pair of facing points on top and bottom whose vertical distance is tied (periodic sides).
/// Section 5.
struct Tie {
  int body_top = 0, body_bottom = 0;
  std::array<int, 2> edge_top{}, edge_bottom{};         ///< Nodes of the facing edges.
  std::array<double, 2> weight_top{}, weight_bottom{};  ///< Linear interpolation on them.
};

/// The discrete specimen, in the undeformed state.
struct Assembly {
  std::vector<Eigen::Vector2d> nodes;         ///< [m]
  std::vector<std::array<int, 3>> triangles;  ///< Nodes, anticlockwise.
  std::vector<Body> bodies;
  std::vector<Joint> joints;         ///< The index of a joint is the one its threshold is drawn by.
  std::vector<Tie> ties;             ///< Empty with free sides.
  std::vector<int> left, right;      ///< Nodes on the sides x = 0 and x = W.
  int corner = 0;                    ///< The node at (0, 0), held in y as well.
  double width = 0.0, height = 0.0;  ///< [m]
  int dropped = 0;  ///< Half fibres left out, as less than 1e-6 of their area is inside.
};

/// Weights of an edge's nodes in the mean of what is linear between neighbours. [-]
std::vector<double> mean_weights(std::size_t nodes);

/// Lays the running bond, turns it by θ, clips it, cuts it into triangles (8 k² a fibre)
/// and finds the joints.
Assembly build_assembly(const AssemblyOptions& options, Lateral lateral);

}  // namespace havers::sim
