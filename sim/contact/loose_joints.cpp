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
  if (first + 2 > columns_.cols())
    columns_.conservativeResize(2 * structure_->joints(), std::max<Index>(16, 2 * columns_.cols()));
  for (const int component : {0, 1})
    columns_.col(first + component) = structure_->reactions_to_jump(joint, component);
  joints_.push_back(joint);
}

Eigen::MatrixXd LooseJoints::stiffness() const {
  const auto n = static_cast<Index>(2 * joints_.size());
  Eigen::MatrixXd S(n, n);
  for (Index i = 0; i < n; i += 2)
    S.middleRows(i, 2) = columns_.block(2 * joints_[static_cast<std::size_t>(i / 2)], 0, 2, n);
  return 0.5 * (S + S.transpose());
}

Eigen::VectorXd LooseJoints::reactions_to(const Eigen::VectorXd& y) const {
  if (y.size() == 0) return Eigen::VectorXd::Zero(2 * structure_->joints());
  return columns_.leftCols(y.size()) * y;
}

}  // namespace havers::sim
