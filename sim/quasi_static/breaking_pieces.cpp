// What of a breaking specimen hangs together.
#include <algorithm>
#include <span>

#include "sim/quasi_static/breaking_run.hpp"
#include "sim/structure/pieces.hpp"

namespace havers::sim {

DisjointSets BreakingRun::pieces() const {
  return pieces_of(intact_->assembly(),
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
  return !ends_hang_together(intact_->assembly(), all);
}

// Whether few bonded joints lead from one side of a broken joint to the other, so that no piece has
// come off by it.
bool BreakingRun::has_detour(const Joint& broken) const {
  constexpr std::size_t few = 32;  // bodies
  std::vector<int> reached{broken.body_a};
  for (std::size_t i = 0; i < reached.size() && reached.size() < few; ++i)
    for (const int joint : intact_->joints_of(reached[i])) {
      if (joints_[static_cast<std::size_t>(joint)].broken) continue;
      const Joint& on = intact_->assembly().joints[static_cast<std::size_t>(joint)];
      const int next = on.body_a == reached[i] ? on.body_b : on.body_a;
      if (next == broken.body_b) return true;
      if (std::ranges::find(reached, next) == reached.end()) reached.push_back(next);
    }
  return false;
}

// Loose joints at a body that no chain of bonded joints connects to an end: 1. Such a body carries
// nothing, and without inertia its position is not determined, so neither is what it touches.
std::vector<char> BreakingRun::apart() {
  const Assembly& assembly = intact_->assembly();
  const auto broken_since = std::span(loose_.joints()).subspan(joints_in_pieces_);
  // Where there is a way around each joint that has broken since, the pieces are what they were.
  const bool as_before = joints_in_pieces_ > 0 && std::ranges::all_of(broken_since, [&](int joint) {
                           return has_detour(assembly.joints[static_cast<std::size_t>(joint)]);
                         });
  joints_in_pieces_ = loose_.size();
  if (!as_before) {
    DisjointSets pieces = this->pieces();
    adrift_.clear();
    for (std::size_t body = 0; body < assembly.bodies.size(); ++body)
      adrift_.push_back(hangs_on_an_end(assembly, pieces, body) ? 0 : 1);
  }
  std::vector<char> apart;
  apart.reserve(loose_.size());
  for (const int joint : loose_.joints()) apart.push_back(is_adrift(joint) ? 1 : 0);
  return apart;
}

bool BreakingRun::is_adrift(int joint) const {
  const Joint& on = intact_->assembly().joints[static_cast<std::size_t>(joint)];
  return !adrift_.empty() && (adrift_[static_cast<std::size_t>(on.body_a)] != 0 ||
                              adrift_[static_cast<std::size_t>(on.body_b)] != 0);
}

}  // namespace havers::sim
