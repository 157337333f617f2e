// What of a specimen hangs together.
#pragma once

#include <vector>

#include "sim/assembly/assembly.hpp"
#include "sim/structure/disjoint_sets.hpp"

namespace havers::sim {

/// The body that a node belongs to. O(log of the bodies).
std::size_t body_of(const Assembly& assembly, int node);

/// Joints of each body, those at its a and at its b sides, in the order of their index.
std::vector<std::vector<int>> joints_of_bodies(const Assembly& assembly);

/// Bodies that bonded joints connect to each other, and after them the left and the right end, as
/// members of their own: bodies that the machine holds are one piece with its end. Ties hold
/// nothing together here.
/// @param is_bonded  whether a joint is, by its index
template <class IsBonded>
DisjointSets pieces_of(const Assembly& assembly, const IsBonded& is_bonded) {
  const std::size_t left = assembly.bodies.size();
  DisjointSets pieces(left + 2);
  for (const int node : assembly.left) pieces.unite(left, body_of(assembly, node));
  for (const int node : assembly.right) pieces.unite(left + 1, body_of(assembly, node));
  for (std::size_t j = 0; j < assembly.joints.size(); ++j)
    if (is_bonded(j))
      pieces.unite(static_cast<std::size_t>(assembly.joints[j].body_a),
                   static_cast<std::size_t>(assembly.joints[j].body_b));
  return pieces;
}

/// Whether these pieces lead from end to end.
bool ends_hang_together(const Assembly& assembly, DisjointSets& pieces);

/// Whether a body is of a piece that hangs on an end.
bool hangs_on_an_end(const Assembly& assembly, DisjointSets& pieces, std::size_t body);

}  // namespace havers::sim
