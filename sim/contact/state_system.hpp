// The linear equations of a local contact problem once every joint's state is given.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "sim/contact/local_contact.hpp"

namespace havers::sim {

/// Gaps and reactions for given states; one load a column.
struct StateSolution {
  Eigen::MatrixXd y;  ///< [m]
  Eigen::MatrixXd r;  ///< [N/m]
};

/// (C2): gaps are held where a joint sticks, along the normal also where it slips; for each other
/// gap one equation, no force beyond −c where open, friction on the cone where slipping. A change
/// of one state is an update of the inverse.
class StateSystem {
 public:
  /// The problem may change its loads and laws' cohesions, and get more joints (see `grow`).
  explicit StateSystem(const LocalContact& problem);
  StateSystem(const LocalContact& problem, const std::vector<JointState>& states);

  [[nodiscard]] const LocalContact& problem() const { return *problem_; }
  [[nodiscard]] const std::vector<JointState>& states() const { return states_; }

  /// Takes note of joints that the problem has got; they stick.
  void grow();
  void set(std::size_t joint, JointState state);
  void set(const std::vector<JointState>& states);

  /// For free reactions `r0` [N/m], gaps `held` where they are held [m] and cohesions c [N/m].
  [[nodiscard]] StateSolution solve(const Eigen::MatrixXd& r0, const Eigen::MatrixXd& held,
                                    const Eigen::MatrixXd& cohesion);

 private:
  struct Equation {
    Eigen::Index row;
    double slope;  // r_T = −slope (r_N + c)
  };

  [[nodiscard]] StateSolution try_to_solve(const Eigen::MatrixXd& r0, const Eigen::MatrixXd& held,
                                           const Eigen::MatrixXd& cohesion) const;
  [[nodiscard]] double scale() const;
  void factorise();
  void add(Eigen::Index row, double slope);
  void remove(Eigen::Index row);
  void incline(Eigen::Index row, double slope);
  [[nodiscard]] Eigen::RowVectorXd coefficients(const Equation& equation) const;
  [[nodiscard]] Eigen::MatrixXd missing(const Eigen::MatrixXd& r,
                                        const Eigen::MatrixXd& cohesion) const;

  const LocalContact* problem_;
  std::vector<JointState> states_;
  std::vector<Equation> equations_;
  std::vector<Eigen::Index> place_;  // of each row's equation; −1: held
  Eigen::MatrixXd inverse_;          // leading part in use
  int updates_ = 0;                  // of the inverse since it was made
};

}  // namespace havers::sim
