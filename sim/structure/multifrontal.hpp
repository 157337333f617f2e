// How a sparse factor is found, panel by panel [DR83].
#pragma once

#include <Eigen/Core>
#include <functional>

#include "sim/structure/elimination_tree.hpp"

namespace havers::sim {

/// What is asked of the pivots of (K Nᵀ; N 0).
struct Pivots {
  double least = 0.0;  ///< Of a row of N; a smaller one is rounding, N is not independent.
  double added = 0.0;  ///< To the diagonal of K.
  double least_stiffness = 0.0;  ///< Of a row of K; a smaller one is rounding, of a mechanism.
};

/// Where panels are while they are worked on, in single or double precision.
template <class Scalar>
struct PanelStore {
  using Panels = Eigen::Map<Eigen::MatrixX<Scalar>>;
  std::function<Panels(const Panel&)> zeros;              ///< Of a panel that is not yet known.
  std::function<void(const Panel&, const Panels&)> take;  ///< Of a panel that is found.
};

/// L D Lᵀ = P A Pᵀ; a panel is complete when its children have handed on what they take from it.
/// Panels that share their values are found once.
/// @return 1/D; empty: a pivot is too small
template <class Scalar>
Eigen::VectorXd factorise(const ElementMatrices& A, const EliminationTree& tree,
                          const Pivots& asked, const PanelStore<Scalar>& store);

extern template Eigen::VectorXd factorise(const ElementMatrices&, const EliminationTree&,
                                          const Pivots&, const PanelStore<double>&);
extern template Eigen::VectorXd factorise(const ElementMatrices&, const EliminationTree&,
                                          const Pivots&, const PanelStore<float>&);

}  // namespace havers::sim
