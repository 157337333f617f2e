// The bodies held together by their bonded joints, solved directly whatever the step size.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cassert>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/structure/bodies.hpp"
#include "sim/structure/element_matrices.hpp"
#include "sim/structure/single_precision_factor.hpp"
#include "sim/structure/sparse_factor.hpp"

namespace havers::sim {

/// What of a joint a structure holds.
enum class Held : char {
  fully,
  normal,  ///< It slides: only the normal displacement is shared.
  not_at_all
};

/// Of a factor. Where joints slide there are many corrections, which single precision is enough for
/// unless pivots are lost in it.
enum class Precision : char { single_where_enough, full };

/// Port forces that err by less than this part of their norm are solved for as well as can be.
constexpr double accuracy_of_forces = 1e-12;

/// What a structure answers, and how well that is known.
struct StructureResponse {
  Eigen::VectorXd displacements;  ///< δ. [m]
  Eigen::VectorXd reactions;      ///< r of every joint: R_N, R_T. [N/m]
  Eigen::VectorXd tie_forces;     ///< Of every tie, pushing its top point up. [N/m]
  Eigen::VectorXd gaps;           ///< u_b − u_a of every joint: normal, tangential. [m]
  Eigen::VectorXd multipliers;    ///< a of all bodies. [N/m]
  int solves = 0;                 ///< Triangular solves spent.
  double residual = 0.0;          ///< Relative error of the port forces, as corrections shrink. [-]
};

/// What acts on a structure. Vectors over degrees of freedom, and over joints (normal, tangential
/// of each).
struct StructureLoads {
  Eigen::VectorXd forces;  ///< g, at every degree of freedom. [N/m]
  Eigen::VectorXd
      prescribed;            ///< Displacements of the held degrees of freedom, zero elsewhere. [m]
  Eigen::VectorXd jumps;     ///< u_b − u_a imposed where a joint is held. [m]
  double force_scale = 0.0;  ///< What port forces err by is compared to this norm at least. [N/m]
  Eigen::VectorXd given{};   ///< Reactions where a joint is not held; empty: none. [N/m]
  Eigen::VectorXd
      friction{};  ///< Of each sliding joint: R_T = given + friction · R_N; empty: 0. [-]
  double accuracy = accuracy_of_forces;     ///< Part of the port forces that they may err by. [-]
  const StructureResponse* near = nullptr;  ///< To much the same: where corrections start.
};

/// Unit jumps at a joint, normal and tangential: their loads on the unknowns, solved for half way,
/// which is all that it takes to know what joints do to each other.
struct Jump {
  int joint = 0;
  Eliminated half;
};
using SharedJump = std::shared_ptr<const Jump>;

/// What joints bear, as far as single precision tells.
struct NearReactions {
  Eigen::MatrixXf reactions;  ///< Of all joints, R_N, R_T; one answer a column. [N/m]
  /// Largest difference between what the two sides of a joint bear. Reactions err by not much
  /// more (S8). [N/m]
  float off_balance = 0.0F;
};

/// Factor of the structure in which the joints hold as given (S5)-(S9), sim/README.md. Unknowns are
/// the joints' own displacements; what an even ring of ports cannot do is imposed by multipliers,
/// so that no digits are lost at large steps (M10).
class Structure {
 public:
  /// @param held  One per joint; empty: all hold fully.
  explicit Structure(const Bodies& bodies, std::vector<Held> held = {});
  Structure(const Structure&) = delete;
  Structure& operator=(const Structure&) = delete;
  ~Structure() = default;
  /// The same bodies held in another way; memory is used again.
  void hold(std::vector<Held> held, Precision precision = Precision::single_where_enough);
  /// Whether what holds now would get another factor by that.
  [[nodiscard]] bool would_differ(Precision precision) const {
    return is_corrected() || (single_ && precision == Precision::full);
  }
  /// The same where few joints hold in another way than in the factor: this stays, and is corrected
  /// by them (S9). False, and nothing done, where joints are many or the factor is not in single
  /// precision: where none slides in it, or inertia is next to nothing.
  [[nodiscard]] bool hold_nearby(const std::vector<Held>& held);
  /// Whether joints hold in another way than in the factor.
  [[nodiscard]] bool is_corrected() const { return !changes_.empty(); }

  /// Whether it can be solved; bodies without ports need no factor.
  [[nodiscard]] bool ok() const {
    return factor_ ? factor_->ok() : single_ || layout_.unknowns == 0;
  }
  /// How each joint holds, in the factor or by changes to it.
  [[nodiscard]] const std::vector<Held>& held() const { return layout_.held; }
  [[nodiscard]] Eigen::Index joints() const {
    return static_cast<Eigen::Index>(layout_.held.size());
  }
  /// Precondition: ok(). Solves as well as `accuracy` asks for or as far as corrections get;
  /// `residual` says how well.
  [[nodiscard]] StructureResponse solve(const StructureLoads& loads) const;

  // Only where no joint slides:
  /// The factor of the mixed form (S7).
  [[nodiscard]] const SparseFactor& factor() const {
    assert(factor_);
    return *factor_;
  }
  /// Unit jumps at a joint that holds fully (S8).
  [[nodiscard]] Jump jump(int joint) const;
  /// Reactions of one such joint to unit jumps at others, a column for each. [N/m²]
  [[nodiscard]] Eigen::Matrix2Xd reactions_of(const Jump& jump,
                                              const std::vector<SharedJump>& to) const;
  /// Reactions of all joints to jumps y [m] at some, normal and tangential of each; one answer a
  /// column. [N/m]
  [[nodiscard]] Eigen::MatrixXd reactions_to(const std::vector<SharedJump>& jumps,
                                             const Eigen::MatrixXd& y) const;
  /// The same in single precision.
  /// @param factor  a copy of factor()
  [[nodiscard]] NearReactions nearly_reactions_to(const std::vector<SharedJump>& jumps,
                                                  const Eigen::MatrixXd& y,
                                                  const SinglePrecisionFactor& factor) const;

 private:
  // The state of a solve, a correction of it, and a joint as a branch of the network of
  // multipliers.
  struct PortState;
  struct Correction;
  struct Branch;
  /// Which unknowns each port has. A tie's top also moves with the distance common to all ties; for
  /// the others that is -1.
  struct Layout {
    std::vector<Held> held;
    std::vector<std::array<int, 2>> of_port;  // unknowns that it moves with
    Eigen::Index unknowns = 0;  // of joints, ties, loose sides and what ties have in common
  };
  /// A joint that holds in another way than in the factor, and what couples the components that do
  /// to the unknowns, half solved: its jump where it has let go, else what moves its sides.
  struct Change {
    int joint;
    bool holds_more;                      // than in the factor; else it has let go
    std::vector<std::size_t> components;  // 0 normal, 1 tangential: those that differ
    std::vector<Eliminated> halves, over_pivots;
  };
  /// Rows of the unknowns and multipliers that unit jumps act on.
  struct LoadOfJump {
    std::vector<int> rows;
    Eigen::MatrixX2d load;  // by a normal and a tangential one
  };
  /// Of a joint, whose side b has an unknown of its own as it holds, or in the factor; where it has
  /// none, that is the joint's.
  struct LooseComponent {
    int joint_unknown, own, in_the_factor;
  };
  // (S8), (S9): loads of jumps and what changes do to each other.
  [[nodiscard]] LoadOfJump load_of_jump(int joint) const;
  [[nodiscard]] Layout laid_out(std::vector<Held> held) const;
  [[nodiscard]] Change change_of(int joint) const;
  [[nodiscard]] Eigen::MatrixXd coupling(const Change& of, const Change& to) const;
  [[nodiscard]] Eigen::Matrix2d stiffness_between(int joint, int other) const;
  void find_loose_components();
  // A solve with the factor in single precision, corrected by the changes. [m], multipliers [N/m]
  [[nodiscard]] Eigen::VectorXd solve_nearby(const Eigen::VectorXd& load) const;
  // L⁻¹P of the load of jumps y, one answer a column.
  [[nodiscard]] Eigen::MatrixXd half_solved(const std::vector<SharedJump>& jumps,
                                            const Eigen::MatrixXd& y) const;
  template <class Vector>
  [[nodiscard]] Vector port_displacements(const Eigen::Ref<const Vector>& unknowns,
                                          const std::vector<SharedJump>& jumps,
                                          const Eigen::Ref<const Vector>& y) const;
  // (S6) by corrections with (S7), from a state to start from.
  [[nodiscard]] PortState solve_ports(const StructureLoads& loads, const Eigen::VectorXd& on_ports,
                                      PortState state) const;
  // What one solve adds for what the equations lack, and what that does to them.
  [[nodiscard]] Correction correct(const Eigen::VectorXd& missing,
                                   const Eigen::VectorXd& friction) const;
  // Correction after correction, until the forces are accurate enough or further ones bring
  // nothing; with friction by generalised conjugate residuals [EES83].
  void refine(const StructureLoads& loads, Eigen::VectorXd missing, PortState& state) const;
  void refine_with_friction(const StructureLoads& loads, Eigen::VectorXd missing,
                            PortState& state) const;
  // What the equations lack, all as forces: what Np lacks is multiplied by the largest stiffness.
  // [N/m]
  [[nodiscard]] Eigen::VectorXd in_forces(const Eigen::VectorXd& forces,
                                          const Eigen::VectorXd& gap) const;
  void rub(const Eigen::VectorXd& friction, Eigen::VectorXd& port_forces) const;
  // Whether the two sides of a joint's component have one displacement.
  [[nodiscard]] static bool holds(int unknown, const Layout& layout);
  [[nodiscard]] bool holds(int unknown) const { return holds(unknown, layout_); }
  [[nodiscard]] Eigen::Index ports() const {
    return static_cast<Eigen::Index>(bodies_->ports().size());
  }
  /// In the factor.
  [[nodiscard]] std::span<const int> unknowns_of_port(Eigen::Index port) const {
    const auto& both = factorised_.of_port[static_cast<std::size_t>(port)];
    return {both.data(), both[1] < 0 ? 1U : 2U};
  }
  // The port at which a component jumps.
  [[nodiscard]] Eigen::Index port_b(int joint, std::size_t component) const {
    return bodies_->ends()[2 * static_cast<std::size_t>(joint) + component][1];
  }
  // Z + kNᵀN (S7). [N/m²]
  [[nodiscard]] Eigen::MatrixXd stiffened(const BodyOperator& op) const;
  // Rx (S8); the tops of ties also move by the distance common to all of them.
  template <class Vector>
  [[nodiscard]] Vector unknowns_to_ports(const Eigen::Ref<const Vector>& unknowns,
                                         const Layout& layout) const {
    Vector p(ports());
    for (Eigen::Index i = 0; i < p.size(); ++i)
      p(i) = unknowns(layout.of_port[static_cast<std::size_t>(i)][0]);
    for (const Eigen::Index top : tops_of_ties_) p(top) += unknowns(layout.unknowns - 1);
    return p;
  }
  // Displacements of another answer's ports, changed so that sides which are held together here
  // move alike: a start for corrections.
  [[nodiscard]] Eigen::VectorXd as_held(const Eigen::VectorXd& displacements) const;
  // Adds Rᵀ t.
  void add_to_unknowns(const Eigen::VectorXd& port_forces, Eigen::VectorXd& all) const;
  [[nodiscard]] Eigen::VectorXd reactions_of(const Eigen::VectorXd& port_forces) const;
  // The factor of (S7) and its matrix, to which each body's rows are added.
  [[nodiscard]] ElementMatrices mixed_form() const;
  [[nodiscard]] Eigen::MatrixXd add_rows(int body, std::vector<int>& rows) const;
  void factorise(Precision precision);
  // (S7): what each body's multipliers come after in the order of elimination. Of whole fibres a
  // network of multipliers tells it, of cut bodies Gauss's elimination.
  [[nodiscard]] std::vector<char> conducting() const;
  [[nodiscard]] std::vector<Branch> network(const std::vector<int>& place,
                                            const std::vector<char>& conducts) const;
  [[nodiscard]] std::vector<int> places_of_others(const std::vector<int>& place,
                                                  const std::vector<char>& others) const;
  [[nodiscard]] Eigen::Index first_multiplier(std::size_t body) const {
    return factorised_.unknowns + bodies_->first_compatibility(static_cast<int>(body));
  }
  // The order of unknowns alone; then with each body's multipliers behind what determines them.
  [[nodiscard]] std::vector<int> order_of_unknowns(const Supervariables& groups) const;
  [[nodiscard]] std::vector<int> elimination_order(const Supervariables& groups) const;

  const Bodies* bodies_;                         // not owned
  Layout layout_, factorised_;                   // as the joints hold, and of the factor
  std::vector<Eigen::Index> tops_of_ties_;       // their ports
  double stiffness_ = 0.0;                       // the largest of Z [N/m²]
  std::vector<const BodyOperator*> op_of_body_;  // of each body
  std::optional<SparseFactor> factor_;           // or,
  std::optional<SinglePrecisionFactor> single_;  // for the many corrections of friction, this one
  std::vector<LooseComponent> loose_components_;
  std::vector<Change> changes_;  // since
  // The matrix between their jumps and forces (S9):
  Eigen::PartialPivLU<Eigen::MatrixXd> between_changes_;
};

}  // namespace havers::sim
