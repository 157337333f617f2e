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
  reactions_.push_back(source_(joint));
  for (std::size_t i = 0; i < joints_.size(); ++i)
    stiffness_.block<2, 2>(first, static_cast<Index>(2 * i)) =
        reactions_.back()->middleRows<2>(2 * static_cast<Index>(joints_[i])).transpose();
}

Eigen::MatrixXd LooseJoints::stiffness() const {
  const auto n = static_cast<Index>(2 * joints_.size());
  Eigen::MatrixXd S(n, n);
  S.triangularView<Eigen::Lower>() = stiffness_.topLeftCorner(n, n);
  S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
  return S;
}

Eigen::VectorXd LooseJoints::reactions_with(const Eigen::VectorXd& y,
                                            Eigen::VectorXd reactions) const {
  for (std::size_t i = 0; i < reactions_.size(); ++i)
    reactions.noalias() += *reactions_[i] * y.segment<2>(2 * static_cast<Index>(i));
  return reactions;
}

}  // namespace havers::sim
