// The robust way through a local contact problem: follow its solution while cohesion is taken away.
#pragma once

#include "sim/contact/local_contact.hpp"
#include "sim/contact/state_system.hpp"

namespace havers::sim {

/// Follows the solution with cohesions c + λ e from λ = 1, where the system's states hold, to λ = 0
/// (C5). For given states the solution is linear in λ; one joint changes its state at a time, where
/// its condition says so. Where that ends nowhere, as friction allows, the path is followed again,
/// with growing λ where it turns back. Not converged when it still ends elsewhere, or where pieces
/// that carry nothing change their minds without end.
/// @param extra  e of each joint, n. [N/m]
/// @param known  gaps and reactions as they are with these states, if there is an answer: at λ = 0
/// and by λ, a column each
LocalContactResult follow_release(StateSystem& system, const Eigen::VectorXd& extra,
                                  const StateSolution& known = {});

/// The same with turns from the start (C9). All joints have to stick, and to have an e > 0; those
/// that are apart have none. For large λ that is the only solution, so that the path cannot end but
/// at λ = 0, if no piece hangs on nothing. It may be a hundred times as long, and the answer far
/// from the last.
LocalContactResult follow_release_with_turns(StateSystem& system, const Eigen::VectorXd& extra);

/// Gaps of the system's states. A piece that hangs on next to nothing may lie anywhere: if not
/// where equations solved from nothing leave it, then where they are met nearest to a known answer.
Eigen::VectorXd answer_of_states(StateSystem& system, StateSolution known);

/// c of every joint, n. [N/m]
Eigen::VectorXd cohesions(const LocalContact& problem);

/// e that lets joints with these reactions stick: where a path can start. [N/m]
Eigen::VectorXd cohesion_to_stick(const Eigen::VectorXd& reactions,
                                  const std::vector<JointLaw>& laws);

}  // namespace havers::sim
