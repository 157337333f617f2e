#include <algorithm>
#include <type_traits>

#include "sim/structure/structure.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The load of unit jumps: forces at the ports of body b, and what they ask of its ring.
Jump Structure::jump(int joint) const {
  const int body = bodies_->assembly().joints[static_cast<std::size_t>(joint)].body_b;
  const BodyOperator& op = *op_of_body_[static_cast<std::size_t>(body)];
  const Index first = bodies_->first_port(body);
  const std::array<Index, 2> jumping{port_b(joint, 0) - first, port_b(joint, 1) - first};
  const Eigen::MatrixX2d forces = stiffened(op)(Eigen::all, jumping);

  std::vector<int> rows;
  std::vector<Eigen::RowVector2d> values;
  for (Index i = 0; i < forces.rows(); ++i)
    for (const Index row : unknowns_of_port(first + i)) {
      const auto known = std::find(rows.begin(), rows.end(), static_cast<int>(row));
      if (known != rows.end()) {
        values[static_cast<std::size_t>(known - rows.begin())] += forces.row(i);
        continue;
      }
      rows.push_back(static_cast<int>(row));
      values.emplace_back(forces.row(i));
    }
  for (Index i = 0; i < op.compatibility.rows(); ++i) {
    rows.push_back(static_cast<int>(first_multiplier(static_cast<std::size_t>(body)) + i));
    values.emplace_back(op.compatibility(i, jumping[0]), op.compatibility(i, jumping[1]));
  }
  Eigen::MatrixX2d load(static_cast<Index>(rows.size()), 2);
  for (std::size_t i = 0; i < rows.size(); ++i) load.row(static_cast<Index>(i)) = -values[i];
  return {joint, factor_->eliminate(std::move(rows), load)};
}

Eigen::Matrix2Xd Structure::reactions_of(const Jump& jump,
                                         const std::vector<SharedJump>& to) const {
  const auto body_b = [&](int joint) {
    return bodies_->assembly().joints[static_cast<std::size_t>(joint)].body_b;
  };
  const int body = body_b(jump.joint);
  const BodyOperator& op = *op_of_body_[static_cast<std::size_t>(body)];
  const Index first = bodies_->first_port(body);
  const Eliminated half = factor_->over_pivots(jump.half);
  Eigen::Matrix2Xd reactions(2, 2 * static_cast<Index>(to.size()));
  for (std::size_t k = 0; k < to.size(); ++k) {
    auto of_one = reactions.middleCols<2>(2 * static_cast<Index>(k));
    of_one = -product(half, to[k]->half);
    if (body != body_b(to[k]->joint)) continue;
    for (const std::size_t i : {0U, 1U})
      for (const std::size_t j : {0U, 1U}) {
        const Index row = port_b(jump.joint, i) - first, column = port_b(to[k]->joint, j) - first;
        of_one(static_cast<Index>(i), static_cast<Index>(j)) +=
            op.impedance(row, column) +
            stiffness_ * op.compatibility.col(row).dot(op.compatibility.col(column));
      }
  }
  return reactions;
}

template <class Factor>
MatrixXd Structure::port_forces_to(const std::vector<SharedJump>& jumps, const MatrixXd& y,
                                   const Factor& factor) const {
  MatrixXd half = MatrixXd::Zero(factor_->rows(), y.cols());
  for (std::size_t i = 0; i < jumps.size(); ++i)
    half(jumps[i]->half.rows, Eigen::all) +=
        jumps[i]->half.values.transpose() * y.middleRows<2>(2 * static_cast<Index>(i));
  const MatrixXd unknowns = factor.complete(std::move(half));
  MatrixXd forces(ports(), y.cols());
  for (Index c = 0; c < y.cols(); ++c) {
    VectorXd displacements = unknowns_to_ports(unknowns.col(c));
    for (std::size_t i = 0; i < jumps.size(); ++i)
      for (const std::size_t k : {0U, 1U})
        displacements(port_b(jumps[i]->joint, k)) += y(static_cast<Index>(2 * i + k), c);
    const auto multipliers = unknowns.col(c).tail(bodies_->compatibilities());
    forces.col(c) = std::is_same_v<Factor, SparseFactor>
                        ? bodies_->port_forces(displacements, multipliers)
                        : bodies_->near_port_forces(displacements, multipliers);
  }
  return forces;
}

MatrixXd Structure::reactions_to(const std::vector<SharedJump>& jumps, const MatrixXd& y) const {
  const MatrixXd forces = port_forces_to(jumps, y, *factor_);
  MatrixXd reactions(2 * joints(), y.cols());
  for (Index c = 0; c < y.cols(); ++c) reactions.col(c) = reactions_of(forces.col(c));
  return reactions;
}

NearReactions Structure::nearly_reactions_to(const std::vector<SharedJump>& jumps,
                                             const MatrixXd& y,
                                             const SinglePrecisionFactor& factor) const {
  const MatrixXd forces = port_forces_to(jumps, y, factor);
  NearReactions found{MatrixXd::Zero(2 * joints(), y.cols())};
  for (int unknown = 0; unknown < 2 * static_cast<int>(joints()); ++unknown) {
    if (!holds(unknown)) continue;
    const auto& [a, b] = bodies_->ends()[static_cast<std::size_t>(unknown)];
    found.reactions.row(unknown) = forces.row(b);
    found.off_balance =
        std::max(found.off_balance, (forces.row(a) + forces.row(b)).lpNorm<Eigen::Infinity>());
  }
  return found;
}

}  // namespace havers::sim
