// S grows with the joints that come loose (S8): nothing of it is solved for twice.
#include "sim/contact/loose_joints.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>

namespace havers::sim {

using Eigen::Index;

LooseJoints::LooseJoints(const Structure& structure, Source source)
    : structure_(&structure),
      source_(std::move(source)),
      is_loose_(static_cast<std::size_t>(structure.joints()), 0) {}

LooseJoints::LooseJoints(const Structure& structure)
    : LooseJoints(structure, [&structure](int joint) {
        return std::make_shared<const Jump>(structure.jump(joint));
      }) {}

void LooseJoints::add(int joint) {
  assert(!contains(joint));
  const auto first = static_cast<Index>(2 * joints_.size());
  if (first + 2 > stiffness_.cols()) {
    const Index size = std::max<Index>(16, 2 * stiffness_.cols());
    stiffness_.conservativeResize(size, size);
  }
  // The second call costs nothing, as what was last asked for is kept.
  stiffness_.block(first, 0, 2, first) = reactions_of(joint);
  stiffness_.block(0, first, first, 2) = reactions_of(joint).transpose();
  stiffness_.block<2, 2>(first, first) = structure_->reactions_of(*held_, {held_});
  joints_.push_back(joint);
  for (const Index row : {2 * joint, 2 * joint + 1}) rows_.push_back(row);
  is_loose_[static_cast<std::size_t>(joint)] = 1;
  jumps_.push_back(std::move(held_));
}

// The last answer is kept, as a joint that is looked at is often the next to come loose.
const Eigen::Matrix2Xd& LooseJoints::reactions_of(int joint) {
  if (held_ && held_->joint == joint) return of_held_;
  held_ = source_(joint);
  of_held_ = structure_->reactions_of(*held_, jumps_);
  return of_held_;
}

}  // namespace havers::sim
