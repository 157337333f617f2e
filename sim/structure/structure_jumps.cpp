// Jumps (S8): what gaps at some joints do to these and to all others, from half solves of the
// joints' own few rows.
#include <algorithm>
#include <array>
#include <utility>

#include "sim/structure/structure.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Eigen::VectorXf;

// The load of unit jumps: forces at the ports of body b, and what they ask of its ring.
Structure::LoadOfJump Structure::load_of_jump(int joint) const {
  // Side b jumps, side a stays: only body b has a load, and its rows are one path.
  const int body = bodies_->assembly().joints[static_cast<std::size_t>(joint)].body_b;
  const BodyOperator& op = *op_of_body_[static_cast<std::size_t>(body)];
  const Index first = bodies_->first_port(body);
  const std::array<Index, 2> jumping{port_b(joint, 0) - first, port_b(joint, 1) - first};
  // −(RᵀZJ; NJ), with kNᵀN added to Z as in the factor.
  MatrixXd load(op.impedance.rows() + op.compatibility.rows(), 2);
  load << -stiffened(op)(Eigen::all, jumping), -op.compatibility(Eigen::all, jumping);
  std::vector<int> rows;
  const MatrixXd into = add_rows(body, rows);
  if (into.size() > 0) load = into * load;
  return {std::move(rows), load};
}

Jump Structure::jump(int joint) const {
  auto [rows, load] = load_of_jump(joint);
  return {joint, factor().eliminate(std::move(rows), load)};
}

Eigen::Matrix2Xd Structure::reactions_of(const Jump& jump,
                                         const std::vector<SharedJump>& to) const {
  const Eliminated half = factor().over_pivots(jump.half);
  // JᵀZJ less (L⁻¹b)ᵀD⁻¹(L⁻¹b) over the rows that both paths have.
  Eigen::Matrix2Xd reactions(2, 2 * static_cast<Index>(to.size()));
  for (std::size_t k = 0; k < to.size(); ++k)
    reactions.middleCols<2>(2 * static_cast<Index>(k)) =
        stiffness_between(jump.joint, to[k]->joint) - product(half, to[k]->half);
  return reactions;
}

// Of a body whose ports jump at both joints.
Eigen::Matrix2d Structure::stiffness_between(int joint, int other) const {
  const auto body_b = [&](int of) {
    return bodies_->assembly().joints[static_cast<std::size_t>(of)].body_b;
  };
  Eigen::Matrix2d between = Eigen::Matrix2d::Zero();
  const int body = body_b(joint);
  if (body != body_b(other)) return between;
  const BodyOperator& op = *op_of_body_[static_cast<std::size_t>(body)];
  const Index first = bodies_->first_port(body);
  for (const std::size_t i : {0U, 1U})
    for (const std::size_t j : {0U, 1U}) {
      const Index row = port_b(joint, i) - first, column = port_b(other, j) - first;
      between(static_cast<Index>(i), static_cast<Index>(j)) =
          op.impedance(row, column) +
          stiffness_ * op.compatibility.col(row).dot(op.compatibility.col(column));
    }
  return between;
}

// L⁻¹ P of the load of jumps.
MatrixXd Structure::half_solved(const std::vector<SharedJump>& jumps, const MatrixXd& y) const {
  MatrixXd half = MatrixXd::Zero(factor().rows(), y.cols());
  for (std::size_t i = 0; i < jumps.size(); ++i)
    half(jumps[i]->half.rows, Eigen::all) +=
        jumps[i]->half.values.transpose().lazyProduct(y.middleRows<2>(2 * static_cast<Index>(i)));
  return half;
}

// Of all ports, those of both sides of a joint.
template <class Vector>
Vector Structure::port_displacements(const Eigen::Ref<const Vector>& unknowns,
                                     const std::vector<SharedJump>& jumps,
                                     const Eigen::Ref<const Vector>& y) const {
  // p = Rx + Jg.
  auto displacements = unknowns_to_ports<Vector>(unknowns, factorised_);
  for (std::size_t i = 0; i < jumps.size(); ++i)
    for (const std::size_t k : {0U, 1U})
      displacements(port_b(jumps[i]->joint, k)) += y(static_cast<Index>(2 * i + k));
  return displacements;
}

MatrixXd Structure::reactions_to(const std::vector<SharedJump>& jumps, const MatrixXd& y) const {
  // The second half of a solve reaches all joints, whatever jumps.
  const MatrixXd unknowns = factor().complete(half_solved(jumps, y));
  MatrixXd reactions(2 * joints(), y.cols());
  for (Index c = 0; c < y.cols(); ++c) {
    const auto of_one = unknowns.col(c);
    reactions.col(c) =
        reactions_of(bodies_->port_forces(port_displacements<VectorXd>(of_one, jumps, y.col(c)),
                                          of_one.tail(bodies_->compatibilities())));
  }
  return reactions;
}

NearReactions Structure::nearly_reactions_to(const std::vector<SharedJump>& jumps,
                                             const MatrixXd& y,
                                             const SinglePrecisionFactor& factor) const {
  const MatrixXd half = half_solved(jumps, y);
  NearReactions found{Eigen::MatrixXf::Zero(2 * joints(), y.cols())};
  for (Index c = 0; c < y.cols(); ++c) {
    const VectorXf unknowns = factor.complete(half.col(c));
    const VectorXf forces = bodies_->near_port_forces(
        port_displacements<VectorXf>(unknowns, jumps, y.col(c).cast<float>()),
        unknowns.tail(bodies_->compatibilities()));
    // What a joint's two sides bear differently shows what single precision misses.
    VectorXf off_balance = VectorXf::Zero(found.reactions.rows());
    for (int unknown = 0; unknown < off_balance.size(); ++unknown) {
      if (!holds(unknown)) continue;
      const auto& [a, b] = bodies_->ends()[static_cast<std::size_t>(unknown)];
      found.reactions(unknown, c) = forces(b);
      off_balance(unknown) = forces(a) + forces(b);
    }
    found.off_balance = std::max(found.off_balance, off_balance.lpNorm<Eigen::Infinity>());
  }
  return found;
}

}  // namespace havers::sim
