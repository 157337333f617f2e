// All bodies of an assembly, the equal ones sharing one operator, worked on class by class.
#pragma once

#include <Eigen/Core>
#include <type_traits>
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

/// Matrices hold one case a column. Vectors over the degrees of freedom have x and y of every node
/// of the assembly; vectors over the ports have each body's ports in order.
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

  [[nodiscard]] Eigen::Index first_compatibility(int body) const {
    return first_compatibility_[static_cast<std::size_t>(body)];
  }

  [[nodiscard]] const Eigen::VectorXd& mass() const { return mass_; }             ///< M. [kg/m]
  [[nodiscard]] Eigen::MatrixXd stiffness_times(const Eigen::MatrixXd& q) const;  ///< K q. [N/m]
  [[nodiscard]] Eigen::MatrixXd shifted_times(const Eigen::MatrixXd& q) const;    ///< Ā q. [N/m]
  /// Z p + Nᵀ a at the ports (S4). [N/m]
  [[nodiscard]] Eigen::MatrixXd port_forces(const Eigen::MatrixXd& p,
                                            const Eigen::MatrixXd& a) const;
  [[nodiscard]] Eigen::MatrixXd incompatibility(const Eigen::MatrixXd& p) const;  ///< N p. [m]
  [[nodiscard]] Eigen::MatrixXd compatibility_forces(
      const Eigen::MatrixXd& a) const;  ///< Nᵀ a. [N/m]
  [[nodiscard]] Eigen::Index compatibilities() const {
    return compatibilities_;
  }  ///< Rows of all N.
  [[nodiscard]] Eigen::MatrixXd port_displacements(const Eigen::MatrixXd& q) const;  ///< B q. [m]
  [[nodiscard]] Eigen::MatrixXd port_forces_on_nodes(
      const Eigen::MatrixXd& t) const;  ///< Bᵀ t. [N/m]

 private:
  // Ports and compatibilities are numbered class by class: those of a class, in one case, are a
  // matrix with a body a column.
  template <class Values>
  [[nodiscard]] auto ports_in(Values& values, const BodyClass& group, Eigen::Index c) const {
    return Eigen::Map<like<Values>>(values.col(c).data() + first_port(group.bodies.front()),
                                    group.op.impedance.rows(),
                                    static_cast<Eigen::Index>(group.bodies.size()));
  }
  template <class Values>
  [[nodiscard]] auto compatibilities_in(Values& values, const BodyClass& group,
                                        Eigen::Index c) const {
    const auto body = static_cast<std::size_t>(group.bodies.front());
    return Eigen::Map<like<Values>>(values.col(c).data() + first_compatibility_[body],
                                    group.op.compatibility.rows(),
                                    static_cast<Eigen::Index>(group.bodies.size()));
  }
  template <class Values>
  using like = std::conditional_t<std::is_const_v<Values>, const Eigen::MatrixXd, Eigen::MatrixXd>;

  const Assembly* assembly_;
  Shift shift_;
  std::vector<BodyClass> classes_;
  std::vector<Port> ports_;
  std::vector<Eigen::Index> first_port_;           // of each body
  std::vector<Eigen::Index> first_compatibility_;  // of each body
  Eigen::Index compatibilities_ = 0;
  std::vector<char> held_;
  Eigen::VectorXd mass_;
};

/// Columns of the result: the segment [starts(body), + rows) of `values` for each body of a class,
/// and back. With several columns of values, all bodies of the first come first.
template <class Starts>
Eigen::MatrixXd gather(const Eigen::MatrixXd& values, const BodyClass& group, Eigen::Index rows,
                       const Starts& starts) {
  Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(group.bodies.size()) * values.cols());
  Eigen::Index to = 0;
  for (Eigen::Index c = 0; c < values.cols(); ++c)
    for (const int body : group.bodies)
      columns.col(to++) = values.col(c).segment(starts(body), rows);
  return columns;
}
template <class Starts>
void scatter(const Eigen::MatrixXd& columns, const BodyClass& group, const Starts& starts,
             Eigen::MatrixXd& values) {
  Eigen::Index from = 0;
  for (Eigen::Index c = 0; c < values.cols(); ++c)
    for (const int body : group.bodies)
      values.col(c).segment(starts(body), columns.rows()) = columns.col(from++);
}

}  // namespace havers::sim
