// The linear equations of a local contact problem once every joint's state is given.
#pragma once

#include <Eigen/LU>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sim/contact/local_contact.hpp"

namespace havers::sim {

/// Gaps and reactions for given states; one load a column.
struct StateSolution {
  Eigen::MatrixXd y;  ///< [m]
  Eigen::MatrixXd r;  ///< [N/m]
};

/// c of every joint, n. [N/m]
Eigen::VectorXd cohesions(const LocalContact& problem);

/// (C2): gaps are held where a joint sticks, along the normal also where it slips; for each other
/// gap one equation, no force beyond −c where open, friction on the cone where slipping. The factor
/// of some states serves others too: what they change borders it (C6).
class StateSystem {
 public:
  /// The problem may change its loads and laws' cohesions, and get more joints (see `grow`).
  explicit StateSystem(const LocalContact& problem);
  StateSystem(const LocalContact& problem, std::vector<JointState> states);

  [[nodiscard]] const LocalContact& problem() const { return *problem_; }
  [[nodiscard]] const std::vector<JointState>& states() const { return states_; }

  /// Takes note of joints that the problem has got; they stick.
  void grow();
  /// Takes effect with the next solution.
  void set(std::size_t joint, JointState state) { states_[joint] = state; }
  void set(std::vector<JointState> states) { states_ = std::move(states); }

  /// Of the problem as it is.
  [[nodiscard]] StateSolution solve();
  /// For free reactions `r0` [N/m], gaps `held` where they are held [m] and cohesions c [N/m], from
  /// a solution for other states: cheap where few have changed. Corrections end where
  /// the reactions lack no more in the equations than `accuracy` times what they lack without gaps,
  /// or rounding is all that is left.
  [[nodiscard]] StateSolution solve_from(StateSolution known, const Eigen::MatrixXd& r0,
                                         const Eigen::MatrixXd& held,
                                         const Eigen::MatrixXd& cohesion, double accuracy);

 private:
  // The equation for a gap; the gap is its unknown.
  struct Equation {
    Eigen::Index row;
    double slope;  // r_T = −slope (r_N + c)
  };
  // An unknown beyond those of the factor, and an equation beyond its own.
  struct Border {
    Eigen::Index row;
    bool has_unknown;             // the gap; else what frees the factor's equation of this row
    std::optional<double> slope;  // of the equation; none: the gap does not change
  };

  [[nodiscard]] std::vector<Equation> equations_of_states() const;
  void factorise();
  // False where so much has changed that a new factor costs less.
  bool border_factor();
  [[nodiscard]] Eigen::VectorXd from_factor(const Eigen::VectorXd& load) const;
  // The largest stiffness. [N/m²]
  [[nodiscard]] double scale() const;
  [[nodiscard]] Eigen::VectorXd forces_of(const Eigen::VectorXd& change) const;
  // By how much the gap of a row changes what an equation asks to be zero. [N/m²]
  [[nodiscard]] double coefficient(const Equation& equation, Eigen::Index unknown) const;
  // Column of a border, solved for with the factor; kept as long as that is.
  [[nodiscard]] const Eigen::VectorXd& column(Eigen::Index row);
  [[nodiscard]] Eigen::VectorXd corrected_by(const Eigen::VectorXd& lack);
  // One column for each load. [N/m]
  [[nodiscard]] Eigen::MatrixXd lacking(const Eigen::MatrixXd& r,
                                        const Eigen::MatrixXd& cohesion) const;
  void correct(StateSolution& solution, const Eigen::MatrixXd& held,
               const Eigen::MatrixXd& cohesion, double load, double accuracy);

  const LocalContact* problem_;
  std::vector<JointState> states_;
  std::vector<Equation> equations_;  // of the states that are solved for

  std::vector<Equation> factorised_;
  std::vector<Eigen::Index> place_;  // of each row in the factor; −1: none
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
  std::map<Eigen::Index, Eigen::VectorXd> columns_;  // factor⁻¹ of a border's column

  double left_by_a_factor_ = 0.0;  // of the reactions, when one was last made for its digits [N/m]

  std::vector<Border> borders_;
  Eigen::MatrixXd border_columns_, border_rows_;
  Eigen::PartialPivLU<Eigen::MatrixXd> complement_;
};

}  // namespace havers::sim
