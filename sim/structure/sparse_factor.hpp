// Sparse factor of a saddle-point matrix, shared by threads once made.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "sim/structure/multifrontal.hpp"

namespace havers::sim {

/// L⁻¹ P b of two columns with few entries: the rows that it reaches, in the order of elimination.
struct Eliminated {
  std::vector<int> rows;
  Eigen::Matrix2Xd values;  ///< One row of b a column.
};

/// aᵀ A⁻¹ b of half solves, one of them over its pivots.
Eigen::Matrix2d product(const Eliminated& a, const Eliminated& b);

/// L D Lᵀ = P A Pᵀ of A = (K Nᵀ; N 0), K positive definite, the rows of N independent. There is no
/// pivoting: the order has to make sure that no pivot of N is small, unless its row is a sum of
/// others.
class SparseFactor {
 public:
  /// @param A  its rows of N are the multipliers
  /// @param tree  of elimination: each row of N comes behind some of those it has entries with
  /// @param pivots  what is asked of them
  /// @param memory  that of a factor which is no longer needed: fresh memory takes as long as the
  /// factor
  SparseFactor(const ElementMatrices& A, std::shared_ptr<const EliminationTree> tree,
               const Pivots& pivots = {}, std::vector<double> memory = {});
  /// For another factor; this one can do nothing more.
  [[nodiscard]] std::vector<double> memory() && { return std::move(values_); }

  /// Whether K was positive definite and N independent; only then may anything be solved.
  [[nodiscard]] bool ok() const { return inverse_pivots_.size() == rows(); }

  // All of these may be called by several threads at once.
  /// A⁻¹ b, one load a column. What entries of b do not reach is left out of the first half.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// Half a solve.
  /// @param rows  those of b that are not zero, `values` has one row for each. All of them must be
  /// coupled in A, as those of one body are: then L⁻¹ reaches one path through the tree of
  /// elimination, from the first of them to its root, and nothing else is looked at.
  [[nodiscard]] Eliminated eliminate(std::vector<int> rows, const Eigen::MatrixX2d& values) const;
  /// The other half, A⁻¹ b of L⁻¹ P b, one load a column.
  /// @param x  in the order of elimination, as the rows of `Eliminated` are
  [[nodiscard]] Eigen::MatrixXd complete(Eigen::MatrixXd x) const;
  /// Half a solve over the pivots, D⁻¹ L⁻¹ P b.
  [[nodiscard]] Eliminated over_pivots(Eliminated half) const;

  [[nodiscard]] Eigen::Index rows() const { return static_cast<Eigen::Index>(tree_->place.size()); }
  [[nodiscard]] long nonzeros() const;  ///< Of L.
  /// That are kept, zeros of panels included.
  [[nodiscard]] std::size_t values() const { return values_.size(); }

 private:
  friend class SinglePrecisionFactor;

  std::shared_ptr<const EliminationTree> tree_;
  std::vector<double> values_;  // of all panels, once of those that share them
  Eigen::VectorXd inverse_pivots_;
};

}  // namespace havers::sim
