// What of a breaking specimen hangs together.
#include "sim/quasi_static/breaking_run.hpp"

namespace havers::sim {

// Bodies that bonded joints connect to each other, and after them the left and the right end.
DisjointSets BreakingRun::pieces() const {
  const Assembly& assembly = intact_->assembly();
  const std::size_t left = assembly.bodies.size();
  DisjointSets pieces(left + 2);
  for (const std::size_t end : {0U, 1U})
    for (const int body : intact_->end_bodies()[end])
      pieces.unite(left + end, static_cast<std::size_t>(body));
  for (std::size_t j = 0; j < joints_.size(); ++j)
    if (!joints_[j].broken)
      pieces.unite(static_cast<std::size_t>(assembly.joints[j].body_a),
                   static_cast<std::size_t>(assembly.joints[j].body_b));
  return pieces;
}

// Whether nothing leads from end to end, not even joints that are pressed together.
bool BreakingRun::severed() const {
  DisjointSets all = pieces();
  for (std::size_t i = 0; i < loose_.size(); ++i) {
    if (system_.states()[i] == JointState::open) continue;
    const Joint& between = intact_->assembly().joints[static_cast<std::size_t>(loose_.joints()[i])];
    all.unite(static_cast<std::size_t>(between.body_a), static_cast<std::size_t>(between.body_b));
  }
  const std::size_t left = intact_->assembly().bodies.size();
  return all.find(left) != all.find(left + 1);
}

// Loose joints at a body that no chain of bonded joints connects to an end: 1. Such a body carries
// nothing, and without inertia its position is not determined, so neither is what it touches.
std::vector<char> BreakingRun::apart() const {
  const Assembly& assembly = intact_->assembly();
  DisjointSets pieces = this->pieces();
  const std::size_t left = assembly.bodies.size();
  const auto carries = [&](int body) {
    const std::size_t piece = pieces.find(static_cast<std::size_t>(body));
    return piece == pieces.find(left) || piece == pieces.find(left + 1);
  };
  std::vector<char> apart;
  for (const int joint : loose_.joints()) {
    const Joint& between = assembly.joints[static_cast<std::size_t>(joint)];
    apart.push_back(carries(between.body_a) && carries(between.body_b) ? 0 : 1);
  }
  return apart;
}

}  // namespace havers::sim
