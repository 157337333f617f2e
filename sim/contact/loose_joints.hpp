// Joints whose gap may change, and how their gaps act on everything else.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "sim/structure/structure.hpp"

namespace havers::sim {

/// Answers of a structure to jumps, made once for each joint that comes loose and reused until the
/// structure changes.
class LooseJoints {
 public:
  /// Reactions of all joints to unit jumps at one, normal and tangential. [N/m²]
  using Reactions = std::shared_ptr<const Eigen::MatrixX2d>;
  /// Where they come from: Structure::reactions_to_jump, or something that remembers its answers.
  using Source = std::function<Reactions(int joint)>;
  LooseJoints(const Structure& structure, Source source);

  [[nodiscard]] std::size_t size() const { return joints_.size(); }
  [[nodiscard]] const std::vector<int>& joints() const { return joints_; }
  [[nodiscard]] bool contains(int joint) const;

  void add(int joint);

  /// S over the loose joints. [N/m²]
  [[nodiscard]] Eigen::MatrixXd stiffness() const;

  /// Reactions of all joints [N/m], when the loose ones get gaps y [m].
  [[nodiscard]] Eigen::VectorXd reactions_with(const Eigen::VectorXd& y,
                                               Eigen::VectorXd reactions) const;

 private:
  const Structure* structure_;
  Source source_;
  std::size_t most_kept_;
  std::vector<int> joints_;
  std::vector<Reactions> reactions_;  // to jumps at each; none where they are too many
  Eigen::MatrixXd stiffness_;         // lower triangle of 2 × 2 blocks; grows by doubling
};

}  // namespace havers::sim
