// The joints' linear problem written out in full, from the assembly alone: the truth for the
// structure's tests. O(n³).
#pragma once

#include <Eigen/Dense>

#include "sim/elasticity/body_matrices.hpp"
#include "sim/structure/structure.hpp"

namespace havers::test {

/// Ā δ = g + Cᵀ λ, C δ = c: rows of C are the joints' gaps (normal, tangential of each), then ties.
struct DenseStructure {
  DenseStructure(const sim::Assembly& assembly, const sim::Material& material,
                 const sim::Shift& shift)
      : A(Eigen::MatrixXd::Zero(dofs(assembly), dofs(assembly))),
        K(A),
        C(Eigen::MatrixXd::Zero(rows(assembly), dofs(assembly))),
        held(static_cast<std::size_t>(dofs(assembly)), 0) {
    for (const sim::Body& body : assembly.bodies) {
      const auto own = sim::body_matrices(assembly, body, material);
      const Eigen::Index first = 2 * body.first_node, n = 2 * body.nodes;
      K.block(first, first, n, n) = own.stiffness;
      A.block(first, first, n, n) = shift.beta * own.stiffness;
      A.diagonal().segment(first, n) += shift.alpha * own.mass;
    }
    Eigen::Index row = 0;
    const auto add = [&](int node, double weight, const Eigen::Vector2d& direction) {
      C.block<1, 2>(row, 2 * node) += weight * direction.transpose();
    };
    for (const sim::Joint& joint : assembly.joints)
      for (const Eigen::Vector2d& direction : {joint.normal, joint.tangent()}) {
        const std::vector<double> weights = sim::mean_weights(joint.edge_a.size());
        for (std::size_t k = 0; k < weights.size(); ++k) {
          add(joint.edge_b[k], weights[k], direction);
          add(joint.edge_a[k], -weights[k], direction);
        }
        ++row;
      }
    for (std::size_t i = 0; i + 1 < assembly.ties.size(); ++i) {  // n − 1 equations for n points
      for (const std::size_t t : {i, i + 1}) {
        const sim::Tie& tie = assembly.ties[t];
        const double sign = t == i ? 1.0 : -1.0;
        for (const std::size_t k : {0U, 1U}) {
          add(tie.edge_top[k], sign * tie.weight_top[k], {0.0, 1.0});
          add(tie.edge_bottom[k], -sign * tie.weight_bottom[k], {0.0, 1.0});
        }
      }
      ++row;
    }
    for (const int node : assembly.left) held[static_cast<std::size_t>(2 * node)] = 1;
    for (const int node : assembly.right) held[static_cast<std::size_t>(2 * node)] = 1;
    held[static_cast<std::size_t>(2 * assembly.corner + 1)] = 1;
  }

  struct Answer {
    Eigen::VectorXd displacements, reactions;
  };

  /// @param joints  What each joint holds; empty: all.
  [[nodiscard]] Answer solve(const sim::StructureLoads& loads,
                             const std::vector<sim::Held>& joints = {}) const {
    // Reactions of all rows of C: given ones, and unknown ones through E.
    const Eigen::Index n_joints = loads.jumps.size() / 2;
    std::vector<Eigen::Index> free, kept;
    for (std::size_t i = 0; i < held.size(); ++i)
      if (held[i] == 0) free.push_back(static_cast<Eigen::Index>(i));
    const auto holds = [&](Eigen::Index row) {
      const sim::Held joint = row < 2 * n_joints && !joints.empty()
                                  ? joints[static_cast<std::size_t>(row / 2)]
                                  : sim::Held::fully;
      return joint == sim::Held::fully || (joint == sim::Held::normal && row % 2 == 0);
    };
    for (Eigen::Index i = 0; i < C.rows(); ++i)
      if (holds(i)) kept.push_back(i);
    const auto n = static_cast<Eigen::Index>(free.size()),
               m = static_cast<Eigen::Index>(kept.size());
    Eigen::MatrixXd E = Eigen::MatrixXd::Zero(C.rows(), m);
    for (Eigen::Index k = 0; k < m; ++k) {
      const Eigen::Index row = kept[static_cast<std::size_t>(k)];
      E(row, k) = 1.0;
      if (row < 2 * n_joints && row % 2 == 0 && !holds(row + 1) && loads.friction.size() > 0)
        E(row + 1, k) = loads.friction(row / 2);
    }
    Eigen::VectorXd given = Eigen::VectorXd::Zero(C.rows());
    for (Eigen::Index i = 0; i < loads.given.size(); ++i)
      if (!holds(i)) given(i) = loads.given(i);
    Eigen::VectorXd gaps = -C * loads.prescribed;
    gaps.head(loads.jumps.size()) += loads.jumps;

    const double scale = A.diagonal().maxCoeff();  // displacements and forces of the same size
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + m, n + m);
    system.topLeftCorner(n, n) = A(free, free) / scale;
    system.topRightCorner(n, m) = -(C.transpose() * E)(free, Eigen::all);
    system.bottomLeftCorner(m, n) = C(kept, free);
    Eigen::VectorXd right(n + m);
    right.head(n) =
        Eigen::VectorXd(loads.forces + C.transpose() * given - A * loads.prescribed)(free) / scale;
    right.tail(m) = gaps(kept);
    const Eigen::VectorXd x = system.fullPivLu().solve(right);

    Answer answer{loads.prescribed, given + scale * E * x.tail(m)};
    answer.displacements(free) += x.head(n);
    answer.reactions.conservativeResize(loads.jumps.size());
    return answer;
  }

  Eigen::MatrixXd A, K, C;
  std::vector<char> held;

 private:
  static Eigen::Index dofs(const sim::Assembly& assembly) {
    return static_cast<Eigen::Index>(2 * assembly.nodes.size());
  }
  static Eigen::Index rows(const sim::Assembly& assembly) {
    const std::size_t ties = assembly.ties.empty() ? 0 : assembly.ties.size() - 1;
    return static_cast<Eigen::Index>(2 * assembly.joints.size() + ties);
  }
};

}  // namespace havers::test
