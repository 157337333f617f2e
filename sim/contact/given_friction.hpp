// A contact problem as a sequence of convex ones: friction that is given is no obstacle.
#pragma once

#include "sim/contact/local_contact.hpp"

namespace havers::sim {

struct StatesOfGivenFriction {
  std::vector<JointState> states;  ///< Of the last convex problem; empty if none was solved.
  int iterations = 0;              ///< Linear solves.
};

/// With given bounds on the tangential reactions the gaps minimise a convex function, which an
/// active set finds in finitely many steps; its pressures give the next bounds, until they stay
/// (C7). Friction that is large may keep them from it: a caller checks the states.
/// @param start  gaps u to start from, 2n, zero or as near as may be. [m]
StatesOfGivenFriction states_by_given_friction(const LocalContact& problem,
                                               const Eigen::VectorXd& start);

}  // namespace havers::sim
