// The linear equations of a local contact problem once every joint's state is given.
#pragma once

#include <Eigen/LU>

#include "sim/contact/local_contact.hpp"

namespace havers::sim {

/// (C2): gaps are held where a joint sticks, along the normal also where it slips; for each other
/// gap one equation, no force beyond −c where open, friction on the cone where slipping. Factorised
/// once for several loads.
class StateSystem {
 public:
  StateSystem(const LocalContact& problem, const std::vector<JointState>& states);

  /// y for free reactions `r0` [N/m], gaps `held` where they are held [m] and cohesions c [N/m].
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& r0, const Eigen::VectorXd& held,
                                      const Eigen::VectorXd& cohesion) const;

 private:
  const LocalContact* problem_;
  std::vector<Eigen::Index> unknown_;  // rows of y
  std::vector<double> slope_;          // of each unknown: r_T = −slope (r_N + c)
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

}  // namespace havers::sim
