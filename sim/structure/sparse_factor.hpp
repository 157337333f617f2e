// Sparse factor of a saddle-point matrix (CHOLMOD), shared by threads once made.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace havers::sim {

/// An order of elimination that leaves little fill. [rows of a symmetric matrix]
std::vector<int> order_of_little_fill(const Eigen::SparseMatrix<double>& lower);

/// L⁻¹ P b of two columns with few entries: the rows that it reaches, in the order of elimination.
struct Eliminated {
  std::vector<int> rows;
  Eigen::Matrix2Xd values;  ///< One row of b a column.
};

/// L D Lᵀ = P A Pᵀ of A = (K Nᵀ; N 0), K positive definite, the rows of N independent. There is no
/// pivoting: the order has to make sure that no pivot of N is small, unless its row is a sum of
/// others.
class SparseFactor {
 public:
  /// @param lower  lower triangle of A
  /// @param multipliers  rows of N; they come last in A
  /// @param order  of elimination: each row of N behind some of those it has entries with
  /// @param least_pivot  of a row of N; a smaller one is rounding, N is not independent
  SparseFactor(const Eigen::SparseMatrix<double>& lower, Eigen::Index multipliers,
               std::vector<int> order, double least_pivot = 0.0);
  ~SparseFactor();
  SparseFactor(SparseFactor&& other) noexcept;
  SparseFactor& operator=(SparseFactor&& other) noexcept;

  /// Whether K was positive definite and N independent; only then may anything be solved.
  [[nodiscard]] bool ok() const;

  // All of these may be called by several threads at once.
  /// A⁻¹ b.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// Half a solve.
  /// @param rows  those of b that are not zero, `values` has one row for each. All of them must be
  /// coupled in A, as those of one body are: then L⁻¹ reaches one path through the tree of
  /// elimination, from the first of them to its root, and `product` relies on that.
  [[nodiscard]] Eliminated eliminate(std::vector<int> rows, const Eigen::MatrixX2d& values) const;
  /// aᵀ A⁻¹ b.
  [[nodiscard]] Eigen::Matrix2d product(const Eliminated& a, const Eliminated& b) const;
  /// A⁻¹ Σ b y, y having two rows for each b.
  [[nodiscard]] Eigen::MatrixXd solve(const std::vector<const Eliminated*>& parts,
                                      const Eigen::MatrixXd& y) const;

  [[nodiscard]] Eigen::Index rows() const { return static_cast<Eigen::Index>(place_.size()); }
  [[nodiscard]] long nonzeros() const;  ///< Of L.

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  std::vector<int> place_;          // of each row in P
  Eigen::VectorXd inverse_pivots_;  // of D
  bool ok_ = false;
};

}  // namespace havers::sim
