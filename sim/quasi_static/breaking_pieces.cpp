// What of a breaking specimen hangs together.
#include "sim/quasi_static/breaking_run.hpp"
#include "sim/structure/pieces.hpp"

namespace havers::sim {

DisjointSets BreakingRun::pieces() const {
  return pieces_of(intact_->assembly(), intact_->end_bodies(),
                   [this](std::size_t joint) { return !joints_[joint].broken; });
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
