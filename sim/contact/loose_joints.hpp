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
  using Response = std::shared_ptr<const JumpResponse>;
  /// Where they come from: Structure::respond_to_jump, or something that remembers its answers.
  using Source = std::function<Response(int joint)>;
  LooseJoints(const Structure& structure, Source source)
      : structure_(&structure), source_(std::move(source)) {}

  [[nodiscard]] std::size_t size() const { return joints_.size(); }
  [[nodiscard]] const std::vector<int>& joints() const { return joints_; }
  [[nodiscard]] bool contains(int joint) const;

  void add(int joint);

  /// S over the loose joints. [N/m²]
  [[nodiscard]] Eigen::MatrixXd stiffness() const;

  /// Change of all reactions by gaps y of the loose joints: S y. [N/m]
  [[nodiscard]] Eigen::VectorXd reactions_to(const Eigen::VectorXd& y) const;

 private:
  const Structure* structure_;
  Source source_;
  std::vector<int> joints_;
  std::vector<Response> responses_;  // of each
  Eigen::MatrixXd stiffness_;        // lower triangle of 2 × 2 blocks; grows by doubling
};

}  // namespace havers::sim
