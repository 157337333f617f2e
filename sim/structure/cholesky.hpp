// Sparse Cholesky factor (CHOLMOD), shared by threads once made.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace havers::sim {

/// L Lᵀ = P A Pᵀ of a symmetric positive definite matrix, lower triangle given.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::SparseMatrix<double>& lower_triangle);
  ~Cholesky();
  Cholesky(Cholesky&& other) noexcept;
  Cholesky& operator=(Cholesky&& other) noexcept;

  /// Whether the matrix was positive definite; only then may solve be called.
  [[nodiscard]] bool ok() const;

  /// A⁻¹ b for each column of b. May be called by several threads at once.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

  [[nodiscard]] long nonzeros() const;  ///< Of L.

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace havers::sim
