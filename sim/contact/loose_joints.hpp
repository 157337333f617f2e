// Joints whose gap may change, and how their gaps act on everything else.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "sim/structure/structure.hpp"

namespace havers::sim {

/// Influence columns of a structure, made once for each joint that comes loose and reused until the
/// structure changes.
class LooseJoints {
 public:
  /// Where columns come from: Structure::respond_to_jump, or something that remembers its answers.
  using Source = std::function<JumpResponse(int joint)>;
  LooseJoints(Eigen::Index joints, Source source)
      : joint_count_(joints), source_(std::move(source)) {}

  [[nodiscard]] std::size_t size() const { return joints_.size(); }
  [[nodiscard]] const std::vector<int>& joints() const { return joints_; }
  [[nodiscard]] bool contains(int joint) const;

  void add(int joint);

  /// S over the loose joints. [N/m²]
  [[nodiscard]] Eigen::MatrixXd stiffness() const;

  /// Change of all reactions by gaps y of the loose joints: S y. [N/m]
  [[nodiscard]] Eigen::VectorXd reactions_to(const Eigen::VectorXd& y) const {
    return times(reactions_, y);
  }

  /// Change of all gaps: y itself at the loose joints, nothing at bonded ones, and what detached
  /// ones do. [m]
  [[nodiscard]] Eigen::VectorXd gaps_to(const Eigen::VectorXd& y) const { return times(gaps_, y); }

 private:
  [[nodiscard]] Eigen::VectorXd times(const Eigen::MatrixXd& columns,
                                      const Eigen::VectorXd& y) const;

  Eigen::Index joint_count_;
  Source source_;
  std::vector<int> joints_;
  Eigen::MatrixXd reactions_, gaps_;  // two columns a joint; grow by doubling
};

}  // namespace havers::sim
