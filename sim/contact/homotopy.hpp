// The robust way through a local contact problem: from another whose answer is known to this one.
#pragma once

#include <optional>

#include "sim/contact/local_contact.hpp"
#include "sim/contact/state_system.hpp"

namespace havers::sim {

/// What is added to a problem at λ = 1; on the way it shrinks with λ. Empty: nothing.
struct Homotopy {
  Eigen::VectorXd reactions{};  ///< To r₀, 2n. [N/m]
  Eigen::VectorXd gaps{};       ///< To u₀, 2n. [m]
  Eigen::VectorXd cohesion{};   ///< To c, n. [N/m]
};

/// Follows the solution from λ = 1, where the system's states hold, to λ = 0 (C4). For given states
/// it is linear in λ; one joint changes its state at a time, where its condition says so. Where
/// friction turns the path back, it goes on with growing λ until it turns down again. Not converged
/// where it goes up without an end, or takes too many changes.
/// @param known  gaps and reactions as they are with these states, if there is an answer: at λ = 0
/// and by λ, a column each
/// @param most_changes  for each joint
/// @param nothing  part of the largest free reaction below which a force, or a gap times its
/// stiffness, is none: pieces that carry nothing must not change their minds about contacts without
/// a force. The larger, the sooner the path passes by where a state changes. [-]
LocalContactResult follow_homotopy(StateSystem& system, const Homotopy& added,
                                   StateSolution known = {}, int most_changes = 100,
                                   double nothing = 1e-9);

/// From the system's states as they are: what breaks a joint's law is mirrored. A short path, if
/// these are nearly the answer's; it may end elsewhere. None where the states have no gaps.
std::optional<Homotopy> from_states(StateSystem& system);

/// From all joints sticking but those apart, with cohesion e > 0 of each. For large λ that is the
/// only solution, so that the path cannot end but at λ = 0, if no piece hangs on nothing. It may be
/// long, by chance: another `way` has other e, no two of them alike, as joints that change at once
/// lead astray.
Homotopy from_sticking(StateSystem& system, int way = 0);

/// Gaps of the system's states. A piece that hangs on next to nothing may lie anywhere: if not
/// where equations solved from nothing leave it, then where they are met nearest to a known answer.
Eigen::VectorXd answer_of_states(StateSystem& system, StateSolution known);

/// e that lets joints with these reactions stick: where a path can start. [N/m]
Eigen::VectorXd cohesion_to_stick(const Eigen::VectorXd& reactions,
                                  const std::vector<JointLaw>& laws);

}  // namespace havers::sim
