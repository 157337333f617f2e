#include "sim/structure/pieces.hpp"

#include <algorithm>

namespace havers::sim {

std::array<std::vector<int>, 2> end_bodies(const Assembly& assembly) {
  const auto touches = [](const Body& body, const std::vector<int>& side) {
    return std::any_of(side.begin(), side.end(), [&](int node) {
      return node >= body.first_node && node < body.first_node + body.nodes;
    });
  };
  std::array<std::vector<int>, 2> ends;
  for (std::size_t b = 0; b < assembly.bodies.size(); ++b)
    for (const std::size_t end : {0U, 1U})
      if (touches(assembly.bodies[b], end == 0 ? assembly.left : assembly.right))
        ends[end].push_back(static_cast<int>(b));
  return ends;
}

std::vector<std::vector<int>> joints_of_bodies(const Assembly& assembly) {
  std::vector<std::vector<int>> joints(assembly.bodies.size());
  for (std::size_t j = 0; j < assembly.joints.size(); ++j)
    for (const int body : {assembly.joints[j].body_a, assembly.joints[j].body_b})
      joints[static_cast<std::size_t>(body)].push_back(static_cast<int>(j));
  return joints;
}

}  // namespace havers::sim
