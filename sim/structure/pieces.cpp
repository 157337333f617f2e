#include "sim/structure/pieces.hpp"

#include <algorithm>

namespace havers::sim {

std::size_t body_of(const Assembly& assembly, int node) {
  // Bodies have their nodes one after the other: O(log of the bodies).
  const auto next = std::ranges::upper_bound(assembly.bodies, node, {}, &Body::first_node);
  return static_cast<std::size_t>(next - assembly.bodies.begin()) - 1;
}

std::vector<std::vector<int>> joints_of_bodies(const Assembly& assembly) {
  std::vector<std::vector<int>> joints(assembly.bodies.size());
  for (std::size_t j = 0; j < assembly.joints.size(); ++j)
    for (const int body : {assembly.joints[j].body_a, assembly.joints[j].body_b})
      joints[static_cast<std::size_t>(body)].push_back(static_cast<int>(j));
  return joints;
}

bool ends_hang_together(const Assembly& assembly, DisjointSets& pieces) {
  // The ends follow the bodies: left, then right.
  const std::size_t left = assembly.bodies.size();
  return pieces.find(left) == pieces.find(left + 1);
}

bool hangs_on_an_end(const Assembly& assembly, DisjointSets& pieces, std::size_t body) {
  const std::size_t left = assembly.bodies.size(), piece = pieces.find(body);
  return piece == pieces.find(left) || piece == pieces.find(left + 1);
}

}  // namespace havers::sim
