// Neighbouring columns of a sparse factor that reach the same rows (a supernode), kept as one dense
// matrix: their own rows first, then those below, in the order of elimination. Only the lower
// triangle of the leading square counts, with the pivots on its diagonal, those of L being 1.
#pragma once

#include <Eigen/Core>

namespace havers::sim {

/// Factorises a panel that all panels before it have been taken from: L D Lᵀ of its own rows, and
/// the rows below divided by D Lᵀ. No pivoting.
template <class Scalar>
void factorise_panel(Eigen::Ref<Eigen::MatrixX<Scalar>> panel);

/// What a factorised panel takes from the matrix of the rows below it.
/// @param rest  its lower triangle becomes that of rest − L D Lᵀ
template <class Scalar>
void take_panel_from(Eigen::Ref<Eigen::MatrixX<Scalar>> rest,
                     const Eigen::Ref<const Eigen::MatrixX<Scalar>>& panel);

// Both in double and in single precision.
extern template void factorise_panel<double>(Eigen::Ref<Eigen::MatrixXd>);
extern template void factorise_panel<float>(Eigen::Ref<Eigen::MatrixXf>);
extern template void take_panel_from<double>(Eigen::Ref<Eigen::MatrixXd>,
                                             const Eigen::Ref<const Eigen::MatrixXd>&);
extern template void take_panel_from<float>(Eigen::Ref<Eigen::MatrixXf>,
                                            const Eigen::Ref<const Eigen::MatrixXf>&);

/// x ← L⁻¹ x on the rows of a panel, where x is zero before column `first`; D is not looked at.
void eliminate_panel(const Eigen::Ref<const Eigen::MatrixXd>& panel, Eigen::Index first,
                     Eigen::Ref<Eigen::MatrixXd> x);

/// x ← L⁻ᵀ x on the rows of a panel; those below its own are known.
void substitute_panel(const Eigen::Ref<const Eigen::MatrixXd>& panel,
                      Eigen::Ref<Eigen::MatrixXd> x);

}  // namespace havers::sim
