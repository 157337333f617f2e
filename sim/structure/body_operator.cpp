#include "sim/structure/body_operator.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <utility>

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// The degrees of freedom that the boundary prescribes, or the others.
std::vector<Index> dofs_of(const std::vector<char>& held, bool prescribed) {
  std::vector<Index> dofs;
  for (std::size_t i = 0; i < held.size(); ++i)
    if ((held[i] != 0) == prescribed) dofs.push_back(static_cast<Index>(i));
  return dofs;
}

// Of a body's motions as a whole those that the boundary leaves to it.
MatrixXd motions_left(const MatrixXd& motions, const std::vector<char>& held) {
  const std::vector<Index> fixed = dofs_of(held, true);
  if (fixed.empty()) return motions;
  Eigen::FullPivLU<MatrixXd> of_fixed(motions(fixed, Eigen::all));
  of_fixed.setThreshold(1e-10);
  if (of_fixed.dimensionOfKernel() == 0) return motions.leftCols(0);
  const MatrixXd kernel = of_fixed.kernel();
  return motions * kernel;
}

// Splits the free displacements by the ports: δ = B⁺ p + Q c, and finds what no displacement can do
// at them.
struct PortSplit {
  MatrixXd inverse;     // B⁺
  MatrixXd interior;    // Q, B Q = 0
  MatrixXd impossible;  // N, N B = 0
};

PortSplit split_by_ports(const MatrixXd& ports) {
  const Index n = ports.cols();
  if (ports.rows() == 0) return {MatrixXd(n, 0), MatrixXd::Identity(n, n), MatrixXd(0, 0)};
  const Eigen::JacobiSVD<MatrixXd> svd(ports, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::VectorXd& values = svd.singularValues();
  // What moves the ports by less counts as moving none: held by them, it would bear without bounds.
  constexpr double least = 1e-5;
  Index rank = 0;
  while (rank < values.size() && values(rank) > least) ++rank;
  PortSplit split;
  const MatrixXd scaled =
      svd.matrixV().leftCols(rank) * values.head(rank).cwiseInverse().asDiagonal();
  split.inverse = scaled * svd.matrixU().leftCols(rank).transpose();
  split.interior = svd.matrixV().rightCols(ports.cols() - rank);
  split.impossible = svd.matrixU().rightCols(ports.rows() - rank).transpose();
  return split;
}

// TᵀAT, by products of two, which compile in less time.
MatrixXd congruent(const MatrixXd& A, const MatrixXd& T) {
  const MatrixXd TA = T.transpose() * A;
  return TA * T;
}

}  // namespace

BodyOperator make_body_operator(BodyMatrices matrices, MatrixXd ports,
                                const std::vector<char>& held, const Shift& shift) {
  BodyOperator body;
  body.free = dofs_of(held, false);
  const std::vector<Index>& free = body.free;
  const Index n = ports.cols(), p = ports.rows();
  // Ā (S1).
  body.shifted = shift.beta * matrices.stiffness;
  body.shifted.diagonal() += shift.alpha * matrices.mass;

  const MatrixXd A = body.shifted(free, free);
  const PortSplit split = split_by_ports(ports(Eigen::all, free));
  const MatrixXd& Q = split.interior;
  // (S2): the interior follows the ports and the loads. Each is corrected once, for bodies so
  // slender or incompressible that digits are lost.
  MatrixXd G = Q * MatrixXd(congruent(A, Q).llt().solve(Q.transpose()));
  G += G - MatrixXd(G * A) * G;
  MatrixXd T = split.inverse;
  for (int i = 0; i < 2; ++i) T -= G * MatrixXd(A * T);
  const MatrixXd Z = congruent(A, T);

  body.compliance = MatrixXd::Zero(n, n);
  body.compliance(free, free) = 0.5 * (G + G.transpose());
  body.recovery = MatrixXd::Zero(n, p);
  body.recovery(free, Eigen::all) = T;
  body.impedance = 0.5 * (Z + Z.transpose());
  body.compatibility = split.impossible;
  body.rigid = body.inertia = MatrixXd(p, 0);
  body.inertia_part = shift.alpha * matrices.mass.maxCoeff() / A.diagonal().maxCoeff();
  const MatrixXd motions = motions_left(matrices.motions, held);
  // (S4): motions as a whole are taken apart only where rounding in K would hide their inertia.
  if (body.at_rest() && motions.cols() > 0) {
    const Eigen::ColPivHouseholderQR<MatrixXd> at_ports(ports * motions);
    body.rigid = MatrixXd(at_ports.householderQ()).leftCols(at_ports.rank());
    const MatrixXd moved = motions * MatrixXd(at_ports.solve(body.rigid));
    // T moves the ports like that, but the interior lags behind its own inertia.
    MatrixXd inertia = shift.alpha * (matrices.mass.asDiagonal() * moved);
    inertia = MatrixXd(inertia(free, Eigen::all));
    inertia -= A * MatrixXd(G * inertia);
    body.inertia = T.transpose() * inertia;
  }
  body.at_once =
      body.impedance + (body.inertia - body.impedance * body.rigid) * body.rigid.transpose();
  body.nearly.resize(p, p + body.compatibility.rows());
  body.nearly << body.at_once.cast<float>(), body.compatibility.transpose().cast<float>();
  body.matrices = std::move(matrices);
  body.ports = std::move(ports);
  return body;
}

}  // namespace havers::sim
