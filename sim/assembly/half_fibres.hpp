// The grid of half fibres that the running bond is made of, shared by the sources of this folder.
#pragma once

#include <map>
#include <utility>

#include "sim/assembly/assembly.hpp"
#include "sim/assembly/polygon.hpp"

namespace havers::sim {

/// A half fibre after clipping, and where it went. Column m and layer k: ξ in [m, m+1] L/2, η in
/// [k, k+1] l.
struct HalfFibre {
  Polygon polygon;
  int body = -1;
  std::vector<int> outline;  ///< Nodes around it; those of edge i begin at i times the refinement.

  /// Nodes along the edge of that origin, both ends included; none when the clipping left none.
  [[nodiscard]] std::vector<int> edge(EdgeOrigin origin) const;
  /// Nodes along the edge that starts at vertex i.
  [[nodiscard]] std::vector<int> edge(std::size_t i) const;
};

/// Keyed by (layer, column), in the order in which bodies and joints are numbered.
using HalfFibres = std::map<std::pair<int, int>, HalfFibre>;

/// Whether the half fibre of that layer and column is the first of its fibre: odd layers are
/// shifted by L/2.
bool is_first_half(int layer, int column);

/// What the specimen's sides leave of them.
/// @param dropped  counts those of which less than 1e-6 is left; their neighbours fill the place
HalfFibres clipped_half_fibres(const AssemblyOptions& options, int& dropped);

/// Joints between the half fibres of different bodies. Section 1.
void add_joints(const AssemblyOptions& options, const HalfFibres& halves, Assembly& assembly);

/// Ties between facing points of top and bottom. Section 5.
/// @param tolerance  how far from the side an edge may lie. [m]
void add_ties(const HalfFibres& halves, double tolerance, Assembly& assembly);

/// Lengths below this are rounding, not geometry. [m]
double geometric_tolerance(const AssemblyOptions& options);

}  // namespace havers::sim
