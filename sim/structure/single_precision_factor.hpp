// A sparse factor in single precision, laid out for what is solved with it again and again.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "sim/structure/sparse_factor.hpp"

namespace havers::sim {

/// Panels are cut into strips of up to 16 columns, filled up with zeros to 4, 8 or 16, which are
/// kept row by row with the inverse of their leading square in its place: nothing in a strip waits
/// for another column of it.
class SinglePrecisionFactor {
 public:
  /// A copy.
  explicit SinglePrecisionFactor(const SparseFactor& factor);
  /// Found in single precision; otherwise as SparseFactor is.
  SinglePrecisionFactor(const ElementMatrices& A, std::shared_ptr<const EliminationTree> tree,
                        const Pivots& pivots);

  /// Whether pivots were large enough; only then may anything be solved.
  [[nodiscard]] bool ok() const {
    return static_cast<std::size_t>(inverse_pivots_.size()) == tree_->place.size();
  }

  // All to six digits or so of the largest entries. They may be called by several threads at once.
  /// L⁻¹ P b, in the order of elimination.
  [[nodiscard]] Eigen::VectorXf halve(const Eigen::VectorXd& b) const;
  /// As SparseFactor does, of one load.
  [[nodiscard]] Eigen::VectorXf complete(const Eigen::Ref<const Eigen::VectorXd>& half) const;
  /// As SparseFactor does.
  [[nodiscard]] Eliminated eliminate(std::vector<int> rows, const Eigen::MatrixX2d& values) const;
  [[nodiscard]] Eliminated over_pivots(Eliminated half) const;

 private:
  // Columns of a panel, with what is below them.
  struct Strip {
    std::size_t rows;     // in the tree, from its own first one on
    int height, columns;  // of its own
    std::size_t values;   // where its values begin
  };
  // Says where strips and their values are; all values are zero until `copy` fills them in.
  void lay_out();
  template <class Scalar>
  void copy(const Panel& panel, const Eigen::Map<const Eigen::MatrixX<Scalar>>& from);
  // x ← L⁻ᵀ x, and x ← L⁻¹ x by one strip; x is longer than the matrix by the widest strip.
  void substitute(Eigen::VectorXf& x) const;
  void eliminate(const Strip& strip, Eigen::VectorXf& x) const;

  std::shared_ptr<const EliminationTree> tree_;
  std::vector<Strip> strips_;             // in the order of elimination
  std::vector<std::size_t> first_strip_;  // of each panel
  std::vector<float> values_;             // of all strips, once of panels that share them
  Eigen::VectorXd inverse_pivots_;
};

}  // namespace havers::sim
