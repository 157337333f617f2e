// A sparse symmetric matrix as finite elements make it: a sum of small dense ones.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <span>
#include <vector>

namespace havers::sim {

/// The sum of elements, each a dense symmetric matrix on some rows of it. Many elements have the
/// same matrix.
struct ElementMatrices {
  /// A dense matrix, and the rows of the sum that it is added to.
  struct Element {
    int matrix;         ///< Among `matrices`.
    std::size_t first;  ///< Of its rows, among those of all elements.
  };
  int size = 0;         ///< Rows of the sum,
  int multipliers = 0;  ///< of which so many, the last ones, have no entries with each other.
  std::vector<Eigen::MatrixXd> matrices;
  std::vector<Element> elements;
  std::vector<int> rows;  ///< Of the sum, for each row of each element: one or more, none twice.

  [[nodiscard]] const Eigen::MatrixXd& matrix_of(const Element& element) const {
    return matrices[static_cast<std::size_t>(element.matrix)];
  }
  /// The rows of the sum to which those of the element's matrix are added.
  [[nodiscard]] std::span<const int> rows_of(const Element& element) const {
    return std::span(rows).subspan(element.first,
                                   static_cast<std::size_t>(matrix_of(element).rows()));
  }
};

/// A pattern of entries: lower triangle.
using Graph = Eigen::SparseMatrix<char>;

/// Rows in the same elements, which feel the same rows and are eliminated one after the other
/// (supervariables [DR83]). Multipliers are apart from other rows.
class Supervariables {
 public:
  /// Precondition: the sum has rows.
  explicit Supervariables(const ElementMatrices& sum);

  [[nodiscard]] int count() const { return static_cast<int>(sizes_.size()); }
  /// Those without multipliers; they come first.
  [[nodiscard]] int unknowns() const { return unknowns_; }
  /// The one that a row is in. They are numbered as the first rows in them are.
  [[nodiscard]] const std::vector<int>& of_rows() const { return of_rows_; }
  /// How many rows each of them has.
  [[nodiscard]] const std::vector<int>& sizes() const { return sizes_; }
  /// Which of them feel each other.
  [[nodiscard]] const Graph& graph() const { return graph_; }

 private:
  std::vector<int> of_rows_, sizes_;
  int unknowns_ = 0;
  Graph graph_;
};

}  // namespace havers::sim
