// Products with the matrices of all bodies, class by class: one dense matrix times as many columns
// as there are bodies of that kind. Values at the ports of a class lie together, so that they need
// no copy.
#include "sim/structure/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Eigen::VectorXf;

// A port with the row of B that it reads.
struct PortRow {
  Port port;
  std::vector<int> nodes;
  std::vector<double> weights;
  Eigen::Vector2d direction;
};

std::vector<std::vector<PortRow>> ports_of_bodies(const Assembly& assembly) {
  std::vector<std::vector<PortRow>> rows(assembly.bodies.size());
  const auto of = [&](int body) -> std::vector<PortRow>& {
    return rows[static_cast<std::size_t>(body)];
  };
  // Joints first, normal and tangential, then ties: the numbers of `Port::unknown`.
  int unknown = 0;
  for (const Joint& joint : assembly.joints) {
    const std::vector<double> mean = mean_weights(joint.edge_a.size());
    for (const Eigen::Vector2d& direction : {joint.normal, joint.tangent()}) {
      of(joint.body_a).push_back({{unknown, PortSide::a}, joint.edge_a, mean, direction});
      of(joint.body_b).push_back({{unknown, PortSide::b}, joint.edge_b, mean, direction});
      ++unknown;
    }
  }
  for (const Tie& tie : assembly.ties) {
    const Eigen::Vector2d y(0.0, 1.0);
    const auto row = [&](PortSide side, const std::array<int, 2>& nodes,
                         const std::array<double, 2>& weights) {
      return PortRow{
          {unknown, side}, {nodes.begin(), nodes.end()}, {weights.begin(), weights.end()}, y};
    };
    of(tie.body_bottom).push_back(row(PortSide::a, tie.edge_bottom, tie.weight_bottom));
    of(tie.body_top).push_back(row(PortSide::b, tie.edge_top, tie.weight_top));
    ++unknown;
  }
  return rows;
}

// u_x = 0 on the left, u_x given on the right, u_y = 0 at the left side's lower corner.
std::vector<char> held_dofs(const Assembly& assembly) {
  std::vector<char> held(2 * assembly.nodes.size(), 0);
  for (const int node : assembly.left) held[2 * static_cast<std::size_t>(node)] = 1;
  for (const int node : assembly.right) held[2 * static_cast<std::size_t>(node)] = 1;
  held[2 * static_cast<std::size_t>(assembly.corner) + 1] = 1;
  return held;
}

// B of one body, one row for each port.
MatrixXd port_matrix(const std::vector<PortRow>& rows, const Body& body) {
  MatrixXd B = MatrixXd::Zero(static_cast<Index>(rows.size()), 2 * body.nodes);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t k = 0; k < rows[r].nodes.size(); ++k) {
      const Index column = 2 * (rows[r].nodes[k] - body.first_node);
      B.block<1, 2>(static_cast<Index>(r), column) +=
          rows[r].weights[k] * rows[r].direction.transpose();
    }
  return B;
}

// Everything an operator depends on, in units of 1e-9 of the body's size: equal bodies have equal
// signatures.
using Signature = std::vector<std::int64_t>;

Signature signature(const Assembly& assembly, const Body& body, const MatrixXd& ports,
                    const std::vector<char>& held) {
  const auto node = [&](int i) {
    const int index = body.first_node + i;
    return assembly.nodes[static_cast<std::size_t>(index)];
  };
  double size = 0.0;
  for (int i = 1; i < body.nodes; ++i) size = std::max(size, (node(i) - node(0)).norm());
  // Powers of two, so that rounding in `size` does not part equal bodies.
  const double unit = 1e-9 * std::exp2(std::round(std::log2(size)));
  Signature key{body.nodes, body.triangles, ports.rows(), std::llround(std::log2(unit))};
  // Relative to the first node: where a body lies does not matter.
  for (int i = 1; i < body.nodes; ++i) {
    const Eigen::Vector2d p = (node(i) - node(0)) / unit;
    key.push_back(std::llround(p.x()));
    key.push_back(std::llround(p.y()));
  }
  // Entries of B are weights times unit directions, 1 at most: they need no unit.
  for (const double value : ports.reshaped()) key.push_back(std::llround(value * 1e12));
  key.insert(key.end(), held.begin(), held.end());
  return key;
}

}  // namespace

Bodies::Bodies(const Assembly& assembly, const Material& material, const Shift& shift, bool share)
    : assembly_(&assembly),
      shared_(share),
      shift_(shift),
      held_(held_dofs(assembly)),
      mass_(2 * assembly.nodes.size()) {
  const std::vector<std::vector<PortRow>> rows = ports_of_bodies(assembly);
  ends_.resize(2 * assembly.joints.size() + assembly.ties.size());
  first_port_.resize(assembly.bodies.size());
  first_compatibility_.resize(assembly.bodies.size());
  std::map<Signature, std::size_t> known;
  for (std::size_t b = 0; b < assembly.bodies.size(); ++b) {
    const Body& body = assembly.bodies[b];
    // An operator is made once for each signature.
    MatrixXd B = port_matrix(rows[b], body);
    const auto first = held_.begin() + 2 * body.first_node;
    const std::vector<char> held(first, first + 2 * body.nodes);
    Signature key = signature(assembly, body, B, held);
    // Bodies of odd and of even layers are alike in shape, not in stiffness.
    if (material.layer_contrast != 1.0) key.push_back(body.layer & 1);
    if (!share) key.push_back(static_cast<std::int64_t>(b));
    const auto [place, is_new] = known.try_emplace(std::move(key), classes_.size());
    if (is_new)
      classes_.push_back(
          {make_body_operator(body_matrices(assembly, body, material), std::move(B), held, shift),
           {}});
    BodyClass& found = classes_[place->second];
    found.bodies.push_back(static_cast<int>(b));
    mass_.segment(2 * body.first_node, 2 * body.nodes) = found.op.matrices.mass;
  }
  // Ports are numbered class by class. That takes a loop of its own: classes are known only after
  // all bodies.
  for (const BodyClass& group : classes_)
    for (const int body : group.bodies) {
      const auto b = static_cast<std::size_t>(body);
      first_port_[b] = static_cast<Index>(ports_.size());
      first_compatibility_[b] = compatibilities_;
      for (const PortRow& row : rows[b]) {
        ends_[static_cast<std::size_t>(row.port.unknown)][row.port.side == PortSide::b ? 1 : 0] =
            static_cast<Index>(ports_.size());
        ports_.push_back(row.port);
      }
      compatibilities_ += group.op.compatibility.rows();
    }
}

Index Bodies::first_dof(int body) const {
  return 2 * static_cast<Index>(assembly_->bodies[static_cast<std::size_t>(body)].first_node);
}

MatrixXd Bodies::gather(const VectorXd& q, const BodyClass& group) const {
  MatrixXd columns(group.op.shifted.rows(), static_cast<Index>(group.bodies.size()));
  for (Index k = 0; k < columns.cols(); ++k)
    columns.col(k) =
        q.segment(first_dof(group.bodies[static_cast<std::size_t>(k)]), columns.rows());
  return columns;
}

void Bodies::scatter(const MatrixXd& columns, const BodyClass& group, VectorXd& q) const {
  for (Index k = 0; k < columns.cols(); ++k)
    q.segment(first_dof(group.bodies[static_cast<std::size_t>(k)]), columns.rows()) =
        columns.col(k);
}

// K only knows differences between nodes: those to a body's first node lose no digits to its path.
// Of what rounding leaves, no force is on the body as a whole: it would do work on that path.
VectorXd Bodies::stiffness_times(const VectorXd& q) const {
  VectorXd y(dofs());
  for (const BodyClass& group : classes_) {
    MatrixXd moved = gather(q, group);
    // From the last row upwards: the first node's own rows, which are subtracted, become 0 last.
    for (Index row = moved.rows() - 1; row >= 0; --row) moved.row(row) -= moved.row(row % 2);
    const auto& [stiffness, mass, motions] = group.op.matrices;
    MatrixXd forces = stiffness * moved;
    const MatrixXd along = motions.transpose() * forces;
    forces.noalias() -= motions * along;
    scatter(forces, group, y);
  }
  return y;
}

VectorXd Bodies::shifted_times(const VectorXd& q) const {
  return shift_.beta * stiffness_times(q) + shift_.alpha * mass_.cwiseProduct(q);
}

VectorXd Bodies::port_displacements(const VectorXd& q) const {
  VectorXd p(static_cast<Index>(ports_.size()));
  for (const BodyClass& group : classes_)
    ports_in(p, group).noalias() = group.op.ports * gather(q, group);
  return p;
}

VectorXd Bodies::port_forces_on_nodes(const VectorXd& t) const {
  VectorXd y(dofs());
  for (const BodyClass& group : classes_)
    scatter(group.op.ports.transpose() * ports_in(t, group), group, y);
  return y;
}

VectorXd Bodies::gaps(const VectorXd& p) const {
  VectorXd gaps(2 * static_cast<Index>(assembly_->joints.size()));
  // `ends_` begins with those of joints; ties, which follow, have no gap.
  for (Index unknown = 0; unknown < gaps.size(); ++unknown) {
    const auto& [a, b] = ends_[static_cast<std::size_t>(unknown)];
    gaps(unknown) = p(b) - p(a);
  }
  return gaps;
}

VectorXd Bodies::forces_of_joints(const VectorXd& r) const {
  VectorXd t = VectorXd::Zero(static_cast<Index>(ports_.size()));
  for (Index unknown = 0; unknown < r.size(); ++unknown) {
    const auto& [a, b] = ends_[static_cast<std::size_t>(unknown)];
    t(a) = -r(unknown);
    t(b) = r(unknown);
  }
  return t;
}

VectorXd Bodies::incompatibility(const VectorXd& p) const {
  VectorXd y(compatibilities_);
  for (const BodyClass& group : classes_)
    compatibilities_in(y, group).noalias() = group.op.compatibility * ports_in(p, group);
  return y;
}

VectorXd Bodies::compatibility_forces(const VectorXd& a) const {
  VectorXd y(static_cast<Index>(ports_.size()));
  for (const BodyClass& group : classes_)
    ports_in(y, group).noalias() =
        group.op.compatibility.transpose() * compatibilities_in(a, group);
  return y;
}

VectorXd Bodies::port_forces(const VectorXd& p, const Eigen::Ref<const VectorXd>& a) const {
  VectorXd y(p.size());
  for (const BodyClass& group : classes_) {
    const BodyOperator& op = group.op;
    auto forces = ports_in(y, group);
    const auto moved = ports_in(p, group);
    // (S4): what moves the body as a whole meets inertia alone.
    if (op.rigid.cols() > 0) {
      const MatrixXd rigidly = op.rigid.transpose() * moved;
      forces.noalias() = op.impedance * (moved - op.rigid * rigidly);
      forces.noalias() += op.inertia * rigidly;
    } else {
      forces.noalias() = op.impedance * moved;
    }
    forces.noalias() += op.compatibility.transpose() * compatibilities_in(a, group);
  }
  return y;
}

VectorXf Bodies::near_port_forces(const VectorXf& p, const Eigen::Ref<const VectorXf>& a) const {
  VectorXf y(p.size());
  for (const BodyClass& group : classes_) {
    // `nearly` has the inertia of the body's own motion in it: nothing is taken apart here.
    const Eigen::MatrixXf& nearly = group.op.nearly;
    auto forces = ports_in(y, group);
    forces.noalias() = nearly.leftCols(forces.rows()) * ports_in(p, group);
    forces.noalias() +=
        nearly.rightCols(nearly.cols() - forces.rows()) * compatibilities_in(a, group);
  }
  return y;
}

}  // namespace havers::sim
