// The robust way through a local contact problem: follow its solution while cohesion is taken away.
#pragma once

#include "sim/contact/local_contact.hpp"
#include "sim/contact/state_system.hpp"

namespace havers::sim {

/// Follows the solution with cohesions c + λ e from λ = 1, where the system's states hold, to λ = 0
/// (C5). For given states the solution is linear in λ; one joint changes its state at a time, where
/// its condition says so. Where friction turns the path back, it goes on with growing λ until it
/// turns down again. Where all joints but those apart stick at first and have an e > 0, that is the
/// only solution for large λ, and the path cannot end but at λ = 0; else it may, not converged.
/// @param extra  e of each joint, n; none of those apart. [N/m]
/// @param known  gaps and reactions as they are with these states, if there is an answer: at λ = 0
/// and by λ, a column each
LocalContactResult follow_release(StateSystem& system, const Eigen::VectorXd& extra,
                                  StateSolution known = {});

/// Gaps of the system's states. A piece that hangs on next to nothing may lie anywhere: if not
/// where equations solved from nothing leave it, then where they are met nearest to a known answer.
Eigen::VectorXd answer_of_states(StateSystem& system, StateSolution known);

/// c of every joint, n. [N/m]
Eigen::VectorXd cohesions(const LocalContact& problem);

/// e that lets joints with these reactions stick: where a path can start. [N/m]
Eigen::VectorXd cohesion_to_stick(const Eigen::VectorXd& reactions,
                                  const std::vector<JointLaw>& laws);

}  // namespace havers::sim
