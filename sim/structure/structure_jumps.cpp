#include <algorithm>

#include "sim/structure/structure.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

// The load of unit jumps: forces at the ports of body b, and what they ask of its ring.
JumpResponse Structure::respond_to_jump(int joint) const {
  const int body = bodies_->assembly().joints[static_cast<std::size_t>(joint)].body_b;
  const BodyOperator& op = *op_of_body_[static_cast<std::size_t>(body)];
  const Index first = bodies_->first_port(body);
  const std::array<Index, 2> jumping{port_b(joint, 0) - first, port_b(joint, 1) - first};
  JumpResponse response{joint, {}, stiffened(op)(Eigen::all, jumping)};

  std::vector<int> rows;
  std::vector<Eigen::RowVector2d> values;
  for (Index i = 0; i < response.own.rows(); ++i)
    for (const Index row : unknowns_of_port(first + i)) {
      const auto known = std::find(rows.begin(), rows.end(), static_cast<int>(row));
      if (known != rows.end()) {
        values[static_cast<std::size_t>(known - rows.begin())] += response.own.row(i);
        continue;
      }
      rows.push_back(static_cast<int>(row));
      values.emplace_back(response.own.row(i));
    }
  for (Index i = 0; i < op.compatibility.rows(); ++i) {
    rows.push_back(static_cast<int>(first_multiplier(static_cast<std::size_t>(body)) + i));
    values.emplace_back(op.compatibility(i, jumping));
  }
  Eigen::MatrixX2d load(static_cast<Index>(rows.size()), 2);
  for (std::size_t i = 0; i < rows.size(); ++i) load.row(static_cast<Index>(i)) = values[i];
  response.half = factor_->solve_half(rows, load);
  return response;
}

Eigen::Matrix2Xd Structure::reactions_between(
    const JumpResponse& a, const std::vector<std::shared_ptr<const JumpResponse>>& b) const {
  Eigen::MatrixX2d scaled = Eigen::MatrixX2d::Zero(factor_->pivots().size(), 2);
  for (std::size_t i = 0; i < a.half.rows.size(); ++i)
    scaled.row(a.half.rows[i]) =
        a.half.values.row(static_cast<Index>(i)) / factor_->pivots()(a.half.rows[i]);
  const std::vector<Joint>& joints = bodies_->assembly().joints;
  const int body = joints[static_cast<std::size_t>(a.joint)].body_b;
  Eigen::Matrix2Xd reactions = Eigen::Matrix2Xd::Zero(2, 2 * static_cast<Index>(b.size()));
  for (std::size_t k = 0; k < b.size(); ++k) {
    auto block = reactions.middleCols<2>(2 * static_cast<Index>(k));
    const JumpResponse& other = *b[k];
    if (joints[static_cast<std::size_t>(other.joint)].body_b == body)
      for (const std::size_t component : {0U, 1U})
        block.row(static_cast<Index>(component)) =
            other.own.row(port_b(a.joint, component) - bodies_->first_port(body));
    for (std::size_t i = 0; i < other.half.rows.size(); ++i)
      block -=
          scaled.row(other.half.rows[i]).transpose() * other.half.values.row(static_cast<Index>(i));
  }
  return reactions;
}

VectorXd Structure::reactions_to_jumps(
    const std::vector<std::shared_ptr<const JumpResponse>>& responses, const VectorXd& y) const {
  VectorXd half = VectorXd::Zero(factor_->pivots().size());
  VectorXd displacements = VectorXd::Zero(ports());
  for (std::size_t k = 0; k < responses.size(); ++k) {
    const JumpResponse& response = *responses[k];
    const Eigen::Vector2d jump = y.segment<2>(2 * static_cast<Index>(k));
    for (std::size_t i = 0; i < response.half.rows.size(); ++i)
      half(response.half.rows[i]) -= response.half.values.row(static_cast<Index>(i)).dot(jump);
    for (const std::size_t component : {0U, 1U})
      displacements(port_b(response.joint, component)) = jump(static_cast<Index>(component));
  }
  const VectorXd answer = factor_->finish(half);
  displacements += unknowns_to_ports(answer);
  return reactions_of(bodies_->port_forces(displacements, answer.tail(bodies_->compatibilities())))
      .head(2 * joints());
}

}  // namespace havers::sim
