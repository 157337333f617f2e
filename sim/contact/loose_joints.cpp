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
  if (first + 2 > reactions_.cols()) {
    const Index columns = std::max<Index>(16, 2 * reactions_.cols());
    reactions_.conservativeResize(2 * joint_count_, columns);
    gaps_.conservativeResize(2 * joint_count_, columns);
  }
  const JumpResponse response = source_(joint);
  reactions_.middleCols<2>(first) = response.reactions;
  gaps_.middleCols<2>(first) = response.gaps;
  joints_.push_back(joint);
}

Eigen::MatrixXd LooseJoints::stiffness() const {
  const auto n = static_cast<Index>(2 * joints_.size());
  Eigen::MatrixXd S(n, n);
  for (Index i = 0; i < n; i += 2)
    S.middleRows(i, 2) = reactions_.block(2 * joints_[static_cast<std::size_t>(i / 2)], 0, 2, n);
  return 0.5 * (S + S.transpose());
}

Eigen::VectorXd LooseJoints::times(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) const {
  if (y.size() == 0) return Eigen::VectorXd::Zero(2 * joint_count_);
  return columns.leftCols(y.size()) * y;
}

}  // namespace havers::sim
