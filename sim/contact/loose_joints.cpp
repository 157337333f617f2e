#include "sim/contact/loose_joints.hpp"

#include <algorithm>
#include <cassert>

namespace havers::sim {

using Eigen::Index;

bool LooseJoints::contains(int joint) const {
  return std::find(joints_.begin(), joints_.end(), joint) != joints_.end();
}

void LooseJoints::add(int joint) {
  assert(!contains(joint));
  const auto first = static_cast<Index>(2 * joints_.size());
  if (first + 2 > stiffness_.cols()) {
    const Index size = std::max<Index>(16, 2 * stiffness_.cols());
    stiffness_.conservativeResize(size, size);
  }
  joints_.push_back(joint);
  responses_.push_back(source_(joint));
  stiffness_.block(first, 0, 2, first + 2) =
      structure_->reactions_between(*responses_.back(), responses_);
}

Eigen::MatrixXd LooseJoints::stiffness() const {
  const auto n = static_cast<Index>(2 * joints_.size());
  Eigen::MatrixXd S(n, n);
  S.triangularView<Eigen::Lower>() = stiffness_.topLeftCorner(n, n);
  S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
  return S;
}

Eigen::VectorXd LooseJoints::reactions_to(const Eigen::VectorXd& y) const {
  if (y.isZero(0.0)) return Eigen::VectorXd::Zero(2 * structure_->joints());
  return structure_->reactions_to_jumps(responses_, y);
}

}  // namespace havers::sim
