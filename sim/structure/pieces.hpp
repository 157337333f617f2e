// What of a specimen hangs together.
#pragma once

#include <array>
#include <vector>

#include "sim/assembly/assembly.hpp"
#include "sim/structure/disjoint_sets.hpp"

namespace havers::sim {

/// Bodies at the left and at the right side.
std::array<std::vector<int>, 2> end_bodies(const Assembly& assembly);

/// Joints of each body.
std::vector<std::vector<int>> joints_of_bodies(const Assembly& assembly);

/// Bodies that bonded joints connect to each other, and after them the left and the right end.
/// @param ends  end_bodies(assembly)
/// @param is_bonded  whether a joint is, by its index
template <class IsBonded>
DisjointSets pieces_of(const Assembly& assembly, const std::array<std::vector<int>, 2>& ends,
                       const IsBonded& is_bonded) {
  const std::size_t left = assembly.bodies.size();
  DisjointSets pieces(left + 2);
  for (const std::size_t end : {0U, 1U})
    for (const int body : ends[end]) pieces.unite(left + end, static_cast<std::size_t>(body));
  for (std::size_t j = 0; j < assembly.joints.size(); ++j)
    if (is_bonded(j))
      pieces.unite(static_cast<std::size_t>(assembly.joints[j].body_a),
                   static_cast<std::size_t>(assembly.joints[j].body_b));
  return pieces;
}

}  // namespace havers::sim
