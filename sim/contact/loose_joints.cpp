#include "sim/contact/loose_joints.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace havers::sim {

using Eigen::Index;

namespace {

// Columns with more than this many times the factor's nonzeros would fill the memory of a large
// wall: a solve takes their place, at about their cost. [-]
constexpr long columns_of_a_solve = 6;

}  // namespace

LooseJoints::LooseJoints(const Structure& structure, Source source)
    : structure_(&structure),
      source_(std::move(source)),
      most_kept_(structure.joints() == 0 || !structure.ok()
                     ? 0
                     : static_cast<std::size_t>(columns_of_a_solve * structure.factor().nonzeros() /
                                                (4 * structure.joints()))) {}

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
  const Reactions reactions = source_(joint);
  for (std::size_t i = 0; i < joints_.size(); ++i)
    stiffness_.block<2, 2>(first, static_cast<Index>(2 * i)) =
        reactions->middleRows<2>(2 * static_cast<Index>(joints_[i])).transpose();
  reactions_.push_back(reactions);
  if (joints_.size() > most_kept_) reactions_.clear();
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
  if (joints_.size() <= most_kept_) {
    for (std::size_t i = 0; i < joints_.size(); ++i)
      reactions.noalias() += *reactions_[i] * y.segment<2>(2 * static_cast<Index>(i));
    return reactions;
  }
  Eigen::VectorXd jumps = Eigen::VectorXd::Zero(reactions.size());
  for (std::size_t i = 0; i < joints_.size(); ++i)
    jumps.segment<2>(2 * static_cast<Index>(joints_[i])) = y.segment<2>(2 * static_cast<Index>(i));
  return reactions + structure_->reactions_to_jumps(jumps);
}

}  // namespace havers::sim
