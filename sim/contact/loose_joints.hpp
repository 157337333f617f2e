// Joints whose gap may change, and how their gaps act on everything else.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "sim/structure/structure.hpp"

namespace havers::sim {

/// Half a solve of a structure for each joint that comes loose, made once and reused until the
/// structure changes.
class LooseJoints {
 public:
  /// Where they come from: Structure::jump, or something that remembers its answers.
  using Source = std::function<SharedJump(int joint)>;
  LooseJoints(const Structure& structure, Source source);
  /// For a structure that is not kept for long.
  explicit LooseJoints(const Structure& structure);

  [[nodiscard]] std::size_t size() const { return joints_.size(); }
  /// In the order in which they came loose, which is that of all rows and columns here.
  [[nodiscard]] const std::vector<int>& joints() const { return joints_; }
  /// Their rows in a vector over all joints, normal and tangential of each.
  [[nodiscard]] const std::vector<Eigen::Index>& rows() const { return rows_; }
  /// Unit jumps at them, solved for half way (S8).
  [[nodiscard]] const std::vector<SharedJump>& jumps() const { return jumps_; }
  [[nodiscard]] bool contains(int joint) const {
    return is_loose_[static_cast<std::size_t>(joint)] != 0;
  }

  /// Lets a joint come loose that the structure holds fully. Costs half a solve, and a product with
  /// each of those before.
  void add(int joint);

  /// Reactions of a joint that holds to unit gaps of the loose ones, a column each. [N/m²]
  [[nodiscard]] const Eigen::Matrix2Xd& reactions_of(int joint);

  /// S over the loose joints, symmetric; a view. [N/m²]
  [[nodiscard]] auto stiffness() const {
    const auto n = static_cast<Eigen::Index>(2 * joints_.size());
    return stiffness_.topLeftCorner(n, n);
  }

 private:
  const Structure* structure_;
  Source source_;
  std::vector<int> joints_;
  std::vector<Eigen::Index> rows_;
  std::vector<char> is_loose_;     // of all joints
  std::vector<SharedJump> jumps_;  // at each
  SharedJump held_;                // what was last asked about; none since joints have come
  Eigen::Matrix2Xd of_held_;       // its reactions
  Eigen::MatrixXd stiffness_;      // in its first rows and columns; grows by doubling
};

}  // namespace havers::sim
