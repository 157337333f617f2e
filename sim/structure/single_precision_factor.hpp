// A sparse factor in single precision, laid out for what is solved with it again and again.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sim/structure/sparse_factor.hpp"

namespace havers::sim {

/// A copy of a factor. Its panels are cut into strips of up to 16 columns, filled up with zeros to
/// 4, 8 or 16, which are kept row by row with the inverse of their leading square in its place:
/// nothing in a strip waits for another column of it.
class SinglePrecisionFactor {
 public:
  /// @param factor  outlives this
  explicit SinglePrecisionFactor(const SparseFactor& factor);

  // Both to six digits or so of the largest entries. They may be called by several threads at once.
  /// L⁻¹ P b, in the order of elimination.
  [[nodiscard]] Eigen::VectorXf halve(const Eigen::VectorXd& b) const;
  /// As SparseFactor does, of one load.
  [[nodiscard]] Eigen::VectorXf complete(const Eigen::Ref<const Eigen::VectorXd>& half) const;

 private:
  struct Strip {
    std::size_t rows;     // in the tree, from its own first one on
    int height, columns;  // of its own
    std::size_t values;
  };
  void copy(const Panel& panel, std::size_t first_strip);
  void substitute(Eigen::VectorXf& x) const;
  void eliminate(Eigen::VectorXf& x) const;

  const SparseFactor* factor_;
  std::vector<Strip> strips_;  // in the order of elimination
  std::vector<float> values_;  // of all strips, once of panels that share them
};

}  // namespace havers::sim
