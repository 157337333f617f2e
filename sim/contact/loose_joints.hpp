// Joints whose gap may change, and how their gaps act on all reactions.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/structure/structure.hpp"

namespace havers::sim {

/// Influence columns of a structure, made once for each joint that comes loose and reused until the structure
/// changes.
class LooseJoints {
 public:
  explicit LooseJoints(const Structure& structure) : structure_(&structure) {}

  [[nodiscard]] std::size_t size() const { return joints_.size(); }
  [[nodiscard]] const std::vector<int>& joints() const { return joints_; }
  [[nodiscard]] bool contains(int joint) const;

  /// Makes a joint loose: two triangular solves.
  void add(int joint);

  /// S over the loose joints. [N/m²]
  [[nodiscard]] Eigen::MatrixXd stiffness() const;

  /// Change of all reactions by gaps y of the loose joints: S y. [N/m]
  [[nodiscard]] Eigen::VectorXd reactions_to(const Eigen::VectorXd& y) const;

 private:
  const Structure* structure_;
  std::vector<int> joints_;
  Eigen::MatrixXd columns_;  // reactions of all joints to unit gaps, two columns a joint; grows by doubling
};

}  // namespace havers::sim
