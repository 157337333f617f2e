#include <algorithm>

#include "sim/structure/structure.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

// The load of unit jumps: forces at the ports of body b, and what they ask of its ring.
Eigen::MatrixX2d Structure::reactions_to_jump(int joint) const {
  const int body = bodies_->assembly().joints[static_cast<std::size_t>(joint)].body_b;
  const BodyOperator& op = *op_of_body_[static_cast<std::size_t>(body)];
  const Index first = bodies_->first_port(body);
  const std::array<Index, 2> jumping{port_b(joint, 0), port_b(joint, 1)};
  const Eigen::MatrixX2d forces =
      stiffened(op)(Eigen::all, std::array{jumping[0] - first, jumping[1] - first});

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
    values.emplace_back(op.compatibility(i, jumping[0] - first),
                        op.compatibility(i, jumping[1] - first));
  }
  Eigen::MatrixX2d load(static_cast<Index>(rows.size()), 2);
  for (std::size_t i = 0; i < rows.size(); ++i) load.row(static_cast<Index>(i)) = -values[i];
  const Eigen::MatrixX2d answer = factor_->solve_sparse(std::move(rows), load);

  Eigen::MatrixX2d reactions(2 * joints(), 2);
  for (const std::size_t c : {0U, 1U}) {
    const VectorXd unknowns = answer.col(static_cast<Index>(c));
    VectorXd displacements = unknowns_to_ports(unknowns);
    displacements(jumping[c]) += 1.0;
    reactions.col(static_cast<Index>(c)) =
        reactions_of(bodies_->port_forces(displacements, unknowns.tail(bodies_->compatibilities())))
            .head(2 * joints());
  }
  return reactions;
}

}  // namespace havers::sim
