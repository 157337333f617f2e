// All bodies of an assembly, the equal ones sharing one operator, worked on class by class.
#pragma once

#include <Eigen/Core>
#include <array>
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

/// Bodies with the same operator.
struct BodyClass {
  BodyOperator op;
  std::vector<int> bodies;  ///< In rising order.
};

/// Vectors over the degrees of freedom have x and y of every node of the assembly; vectors over the
/// ports have each body's ports in order, those of a class together.
class Bodies {
 public:
  /// @param share  false: one operator per body, for comparison (section 7).
  Bodies(const Assembly& assembly, const Material& material, const Shift& shift, bool share = true);

  /// The assembly that it was made of, which has to outlive it.
  [[nodiscard]] const Assembly& assembly() const { return *assembly_; }
  /// Whether equal bodies share one operator.
  [[nodiscard]] bool shared() const { return shared_; }
  /// In the order of their first bodies.
  [[nodiscard]] const std::vector<BodyClass>& classes() const { return classes_; }
  /// Of all bodies, in the order of vectors over the ports.
  [[nodiscard]] const std::vector<Port>& ports() const { return ports_; }
  /// The ports of each unknown, side a and side b.
  [[nodiscard]] const std::vector<std::array<Eigen::Index, 2>>& ends() const { return ends_; }
  /// 1 for a degree of freedom that the boundary prescribes.
  [[nodiscard]] const std::vector<char>& held() const { return held_; }
  /// Two for each node.
  [[nodiscard]] Eigen::Index dofs() const { return static_cast<Eigen::Index>(held_.size()); }
  /// Where the values of a body begin: in vectors over the degrees of freedom, over the ports, and
  /// over the rows of all N.
  [[nodiscard]] Eigen::Index first_dof(int body) const;
  [[nodiscard]] Eigen::Index first_port(int body) const {
    return first_port_[static_cast<std::size_t>(body)];
  }

  [[nodiscard]] Eigen::Index first_compatibility(int body) const {
    return first_compatibility_[static_cast<std::size_t>(body)];
  }

  [[nodiscard]] const Eigen::VectorXd& mass() const { return mass_; }             ///< M. [kg/m]
  [[nodiscard]] Eigen::VectorXd stiffness_times(const Eigen::VectorXd& q) const;  ///< K q. [N/m]
  [[nodiscard]] Eigen::VectorXd shifted_times(const Eigen::VectorXd& q) const;    ///< Ā q. [N/m]
  /// Z p + Nᵀ a at the ports (S4). [N/m]
  [[nodiscard]] Eigen::VectorXd port_forces(const Eigen::VectorXd& p,
                                            const Eigen::Ref<const Eigen::VectorXd>& a) const;
  /// The same in single precision.
  [[nodiscard]] Eigen::VectorXf near_port_forces(const Eigen::VectorXf& p,
                                                 const Eigen::Ref<const Eigen::VectorXf>& a) const;
  [[nodiscard]] Eigen::VectorXd incompatibility(const Eigen::VectorXd& p) const;  ///< N p. [m]
  [[nodiscard]] Eigen::VectorXd compatibility_forces(
      const Eigen::VectorXd& a) const;  ///< Nᵀ a. [N/m]
  [[nodiscard]] Eigen::Index compatibilities() const {
    return compatibilities_;
  }  ///< Rows of all N.
  [[nodiscard]] Eigen::VectorXd port_displacements(const Eigen::VectorXd& q) const;  ///< B q. [m]
  [[nodiscard]] Eigen::VectorXd port_forces_on_nodes(
      const Eigen::VectorXd& t) const;  ///< Bᵀ t. [N/m]
  /// p_b − p_a at the joints. [m]
  [[nodiscard]] Eigen::VectorXd gaps(const Eigen::VectorXd& p) const;
  /// At the ports: r on the b sides of the joints, −r on their a sides. [N/m]
  [[nodiscard]] Eigen::VectorXd forces_of_joints(const Eigen::VectorXd& r) const;

  // What of a vector belongs to a class, a body a column.
  /// Of one over the degrees of freedom, copied, and back.
  [[nodiscard]] Eigen::MatrixXd gather(const Eigen::VectorXd& q, const BodyClass& group) const;
  void scatter(const Eigen::MatrixXd& columns, const BodyClass& group, Eigen::VectorXd& q) const;
  /// Of one over the ports, in place.
  template <class Values>
  [[nodiscard]] auto ports_in(Values& values, const BodyClass& group) const {
    return part(values, group, first_port_, group.op.impedance.rows());
  }
  /// Of one over the rows of all N, in place.
  template <class Values>
  [[nodiscard]] auto compatibilities_in(Values& values, const BodyClass& group) const {
    return part(values, group, first_compatibility_, group.op.compatibility.rows());
  }

 private:
  // Bodies of a class follow each other in these vectors: without a copy they are a matrix with a
  // column for each body.
  template <class Values>
  [[nodiscard]] static auto part(Values& values, const BodyClass& group,
                                 const std::vector<Eigen::Index>& first, Eigen::Index rows) {
    using Matrix = Eigen::Matrix<typename Values::Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    using Part = std::conditional_t<std::is_const_v<Values>, const Matrix, Matrix>;
    return Eigen::Map<Part>(values.data() + first[static_cast<std::size_t>(group.bodies.front())],
                            rows, static_cast<Eigen::Index>(group.bodies.size()));
  }

  const Assembly* assembly_;
  bool shared_;
  Shift shift_;  // α and β (S1)
  std::vector<BodyClass> classes_;
  std::vector<Port> ports_;                        // class by class, in a class body by body
  std::vector<std::array<Eigen::Index, 2>> ends_;  // of each unknown
  std::vector<Eigen::Index> first_port_;           // of each body
  std::vector<Eigen::Index> first_compatibility_;  // of each body
  Eigen::Index compatibilities_ = 0;
  std::vector<char> held_;  // of each degree of freedom
  Eigen::VectorXd mass_;    // of each degree of freedom [kg/m]
};

}  // namespace havers::sim
