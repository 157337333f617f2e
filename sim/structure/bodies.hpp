// All bodies of an assembly, the equal ones sharing one operator, worked on class by class.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/structure/body_operator.hpp"

namespace havers::sim {

/// Which end of a joint or tie a port is: a is the side that −n points to, or the bottom of a tie.
enum class PortSide { a, b };

/// One scalar displacement of a body that is held by a joint's component or a tie.
struct Port {
  int unknown = 0;  ///< 2·joint + component (0 normal, 1 tangential), or 2·joints + tie.
  PortSide side = PortSide::a;
};

/// Bodies with the same operator; columns of the gathered matrices.
struct BodyClass {
  BodyOperator op;
  std::vector<int> bodies;
};

/// Vectors over the degrees of freedom have x and y of every node of the assembly; vectors over the
/// ports have each body's ports in order.
class Bodies {
 public:
  /// @param share  false: one operator per body, for comparison (section 7).
  Bodies(const Assembly& assembly, const Material& material, const Shift& shift, bool share = true);

  [[nodiscard]] const Assembly& assembly() const { return *assembly_; }
  [[nodiscard]] const std::vector<BodyClass>& classes() const { return classes_; }
  [[nodiscard]] const std::vector<Port>& ports() const { return ports_; }
  [[nodiscard]] const std::vector<char>& held() const { return held_; }
  [[nodiscard]] Eigen::Index dofs() const { return static_cast<Eigen::Index>(held_.size()); }
  [[nodiscard]] Eigen::Index first_dof(int body) const;
  [[nodiscard]] Eigen::Index first_port(int body) const {
    return first_port_[static_cast<std::size_t>(body)];
  }

  [[nodiscard]] const Eigen::VectorXd& mass() const { return mass_; }             ///< M. [kg/m]
  [[nodiscard]] Eigen::VectorXd stiffness_times(const Eigen::VectorXd& q) const;  ///< K q. [N/m]
  [[nodiscard]] Eigen::VectorXd shifted_times(const Eigen::VectorXd& q) const;    ///< Ā q. [N/m]
  /// Z p + Nᵀ a at the ports (S4). [N/m]
  [[nodiscard]] Eigen::VectorXd port_forces(const Eigen::VectorXd& p,
                                            const Eigen::VectorXd& a) const;
  [[nodiscard]] Eigen::VectorXd incompatibility(const Eigen::VectorXd& p) const;  ///< N p. [m]
  [[nodiscard]] Eigen::VectorXd compatibility_forces(
      const Eigen::VectorXd& a) const;  ///< Nᵀ a. [N/m]
  [[nodiscard]] Eigen::Index compatibilities() const {
    return compatibilities_;
  }  ///< Rows of all N.
  [[nodiscard]] Eigen::VectorXd port_displacements(const Eigen::VectorXd& q) const;  ///< B q. [m]
  [[nodiscard]] Eigen::VectorXd port_forces_on_nodes(
      const Eigen::VectorXd& t) const;  ///< Bᵀ t. [N/m]

 private:
  const Assembly* assembly_;
  std::vector<BodyClass> classes_;
  std::vector<Port> ports_;
  std::vector<Eigen::Index> first_port_;           // of each body
  std::vector<Eigen::Index> first_compatibility_;  // of each body
  Eigen::Index compatibilities_ = 0;
  std::vector<char> held_;
  Eigen::VectorXd mass_;
};

/// Columns of the result: the segment [starts(body), + rows) of `values` for each body of a class,
/// and back.
template <class Starts>
Eigen::MatrixXd gather(const Eigen::VectorXd& values, const BodyClass& bodies, Eigen::Index rows,
                       const Starts& starts) {
  Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(bodies.bodies.size()));
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    columns.col(i) = values.segment(starts(bodies.bodies[static_cast<std::size_t>(i)]), rows);
  return columns;
}
template <class Starts>
void scatter(const Eigen::MatrixXd& columns, const BodyClass& bodies, const Starts& starts,
             Eigen::VectorXd& values) {
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    values.segment(starts(bodies.bodies[static_cast<std::size_t>(i)]), columns.rows()) =
        columns.col(i);
}

}  // namespace havers::sim
