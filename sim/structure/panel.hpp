// Neighbouring columns of a sparse factor that reach the same rows (a supernode), kept as one dense
// matrix: their own rows first, then those below, in the order of elimination. Only the lower
// triangle of the leading square counts, with the pivots on its diagonal, those of L being 1.
#pragma once

#include <Eigen/Core>

namespace havers::sim {

/// Factorises a panel that all panels before it have been taken from: L D Lᵀ of its own rows, and
/// the rows below divided by D Lᵀ. No pivoting.
void factorise_panel(Eigen::Ref<Eigen::MatrixXd> panel);

/// What a factorised panel takes from the matrix of the rows below it.
/// @param rest  its lower triangle becomes that of rest − L D Lᵀ
void take_panel_from(Eigen::Ref<Eigen::MatrixXd> rest,
                     const Eigen::Ref<const Eigen::MatrixXd>& panel);

/// x ← L⁻¹ x on the rows of a panel, where x is zero before column `first`; D is not looked at.
void eliminate_panel(const Eigen::Ref<const Eigen::MatrixXd>& panel, Eigen::Index first,
                     Eigen::Ref<Eigen::MatrixXd> x);

/// x ← L⁻ᵀ x on the rows of a panel; those below its own are known.
void substitute_panel(const Eigen::Ref<const Eigen::MatrixXd>& panel,
                      Eigen::Ref<Eigen::MatrixXd> x);

}  // namespace havers::sim
