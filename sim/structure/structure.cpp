// Solves by corrections: with a factor of (S7), which knows no friction and may be in single
// precision or hold mechanisms, and with residuals of (S6), which is what is solved.
#include "sim/structure/structure.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Forces err by more than the bodies' imbalance: 5 times as a rule, 200 times at the most over all
// scenes of known answer.
constexpr double forces_by_imbalance = 1e3;
constexpr int max_solves = 12;
constexpr int max_solves_with_friction = 40;

}  // namespace

// Displacements, forces and compatibility multipliers at the ports of all bodies.
struct Structure::PortState {
  VectorXd displacements;  // p, offsets included
  VectorXd forces;         // t, on the bodies, beyond the loads
  VectorXd multipliers;    // a
  int solves = 0;
  double error = 0.0;  // of the forces, relative, as far as the corrections tell
};

Structure::Structure(const Bodies& bodies, std::vector<Held> held) : bodies_(&bodies) {
  const Assembly& assembly = bodies.assembly();
  for (std::size_t tie = 0; tie < assembly.ties.size(); ++tie)
    tops_of_ties_.push_back(bodies.ends()[2 * assembly.joints.size() + tie][1]);
  held.resize(assembly.joints.size(), Held::fully);
  hold(std::move(held));
}

Structure::Layout Structure::laid_out(std::vector<Held> held) const {
  const Assembly& assembly = bodies_->assembly();
  assert(held.size() == assembly.joints.size());
  const int joint_unknowns = 2 * static_cast<int>(assembly.joints.size());
  int next = joint_unknowns + static_cast<int>(assembly.ties.size());
  // Joints and ties first, by the numbers of `Port`; then the b sides of what is loose; last the
  // distance common to all ties.
  Layout layout{std::move(held), {}, 0};
  for (const Port& port : bodies_->ports()) {
    const bool b = port.side == PortSide::b;
    // Where a joint does not hold, its side b has an unknown of its own.
    const bool own = b && port.unknown < joint_unknowns && !holds(port.unknown, layout);
    layout.of_port.push_back({own ? next++ : port.unknown, -1});
  }
  layout.unknowns = next + (assembly.ties.empty() ? 0 : 1);
  for (const Index top : tops_of_ties_)
    layout.of_port[static_cast<std::size_t>(top)][1] = static_cast<int>(layout.unknowns) - 1;
  return layout;
}

bool Structure::holds(int unknown, const Layout& layout) {
  const Held held = layout.held[static_cast<std::size_t>(unknown / 2)];
  return held == Held::fully || (held == Held::normal && unknown % 2 == 0);
}

MatrixXd Structure::stiffened(const BodyOperator& op) const {
  return op.impedance + stiffness_ * op.compatibility.transpose() * op.compatibility;
}

// Displacements of all ports, but where they are held together: there as one of them.
VectorXd Structure::as_held(const VectorXd& displacements) const {
  VectorXd unknowns = VectorXd::Zero(layout_.unknowns);
  for (Index i = 0; i < ports(); ++i)
    if (const auto& [own, common] = layout_.of_port[static_cast<std::size_t>(i)]; common < 0)
      unknowns(own) = displacements(i);
  for (const Index top : tops_of_ties_)
    unknowns(layout_.unknowns - 1) =
        displacements(top) - unknowns(layout_.of_port[static_cast<std::size_t>(top)][0]);
  return unknowns_to_ports<VectorXd>(unknowns, layout_);
}

void Structure::add_to_unknowns(const VectorXd& port_forces, VectorXd& all) const {
  for (Index i = 0; i < port_forces.size(); ++i)
    all(layout_.of_port[static_cast<std::size_t>(i)][0]) += port_forces(i);
  for (const Index top : tops_of_ties_) all(layout_.unknowns - 1) += port_forces(top);
}

// Takes the friction of sliding joints from the forces that the bodies still have to bear.
void Structure::rub(const VectorXd& friction, VectorXd& port_forces) const {
  for (std::size_t j = 0; j < layout_.held.size(); ++j) {
    const double slope = friction(static_cast<Index>(j));
    if (layout_.held[j] != Held::normal || slope == 0.0) continue;
    const auto& [a, b] = bodies_->ends()[2 * j + 1];
    const double force = slope * port_forces(bodies_->ends()[2 * j][1]);
    port_forces(b) -= force;
    port_forces(a) += force;
  }
}

// A correction, of unknowns and multipliers and of ports, and what it does to the forces on ports
// and in the equations.
struct Structure::Correction {
  VectorXd answer, displacements, forces, effect;
  double effect_squared = 0.0;
};

VectorXd Structure::in_forces(const VectorXd& forces, const VectorXd& gap) const {
  VectorXd all(layout_.unknowns + gap.size());
  all.head(layout_.unknowns).setZero();
  all.tail(gap.size()) = stiffness_ * gap;
  add_to_unknowns(forces, all);
  return all;
}

// One solve with the factor (S7), which knows no friction.
Structure::Correction Structure::correct(const VectorXd& missing, const VectorXd& friction) const {
  VectorXd load = -missing;
  auto gap = load.tail(bodies_->compatibilities());
  // The factor has kNᵀN in it: where another Np than 0 is asked for, that makes a force too.
  if (gap.lpNorm<1>() != 0.0) add_to_unknowns(bodies_->compatibility_forces(gap), load);
  gap /= stiffness_;
  Correction change{single_ ? solve_nearby(load) : VectorXd(factor_->solve(load)), {}, {}, {}};
  change.displacements = unknowns_to_ports<VectorXd>(change.answer, layout_);
  change.forces = bodies_->port_forces(change.displacements, change.answer.tail(gap.size()));
  if (friction.size() > 0) rub(friction, change.forces);
  change.effect = in_forces(change.forces, bodies_->incompatibility(change.displacements));
  return change;
}

// Corrections of the mixed system (S6) until its own residuals are rounding.
void Structure::refine(const StructureLoads& loads, VectorXd missing, PortState& state) const {
  double before =
      loads.near != nullptr ? 0.0 : 1.0;  // how they shrink is then seen from the second on
  while (state.solves < max_solves) {
    const Correction change = correct(missing, {});
    ++state.solves;
    state.displacements += change.displacements;
    state.multipliers += change.answer.tail(state.multipliers.size());
    state.forces += change.forces;
    missing += change.effect;
    const double scale = std::max(loads.force_scale, state.forces.norm());
    const double correction = scale > 0.0 ? change.forces.norm() / scale : 0.0;
    // The next correction is expected to shrink as this one did, but not by more than part of a
    // double's digits.
    const double shrinkage = correction > 1e-6 * before ? correction / before : 1e-6;
    const double imbalance = scale > 0.0 ? missing.norm() / scale : 0.0;
    state.error = std::min(correction * std::min(shrinkage, 1.0), forces_by_imbalance * imbalance);
    if (!(state.error > loads.accuracy)) break;
    if (state.solves > 3 && shrinkage > 0.5) break;
    before = correction;
  }
}

// The same where joints rub: generalised conjugate residuals [EES83].
void Structure::refine_with_friction(const StructureLoads& loads, VectorXd missing,
                                     PortState& state) const {
  VectorXd answer = VectorXd::Zero(missing.size());
  double scale = 0.0;
  std::vector<Correction> past;
  while (state.solves < max_solves_with_friction) {
    Correction change = correct(missing, loads.friction);
    ++state.solves;
    const double lacked = missing.norm(), correction = change.forces.norm();
    // Its effect is made orthogonal to those of earlier corrections.
    for (const Correction& old : past) {
      const double part = change.effect.dot(old.effect) / old.effect_squared;
      change.answer -= part * old.answer;
      change.effect -= part * old.effect;
    }
    change.effect_squared = change.effect.squaredNorm();
    const double length = -missing.dot(change.effect) / change.effect_squared;
    if (!std::isfinite(length)) {
      if (lacked != 0.0) state.error = std::numeric_limits<double>::infinity();
      break;
    }
    if (past.empty())
      scale = std::max(loads.force_scale, (state.forces + length * change.forces).norm());
    answer += length * change.answer;
    missing += length * change.effect;
    // Forces err by as many times what is lacking as they did before.
    const double lacks = missing.norm();
    state.error = scale > 0.0 ? std::max(correction / lacked, 1.0) * lacks / scale : 0.0;
    if (!(state.error > loads.accuracy)) break;
    past.push_back(
        {std::move(change.answer), {}, {}, std::move(change.effect), change.effect_squared});
  }
  state.displacements += unknowns_to_ports<VectorXd>(answer, layout_);
  state.multipliers += answer.tail(state.multipliers.size());
}

Structure::PortState Structure::solve_ports(const StructureLoads& loads, const VectorXd& on_ports,
                                            PortState state) const {
  const bool rubs = loads.friction.size() > 0 && !loads.friction.isZero(0.0);
  const auto forces = [&] {
    VectorXd all = -on_ports;
    if (state.displacements.lpNorm<1>() != 0.0 || state.multipliers.lpNorm<1>() != 0.0)
      all += bodies_->port_forces(state.displacements, state.multipliers);
    if (rubs) rub(loads.friction, all);
    return all;
  };
  state.forces = forces();
  if (layout_.unknowns == 0) return state;
  assert(ok());
  VectorXd missing = in_forces(state.forces, bodies_->incompatibility(state.displacements));
  if (!rubs) {
    refine(loads, std::move(missing), state);
  } else {
    refine_with_friction(loads, std::move(missing), state);
    // Corrections were of displacements and multipliers: forces follow from these.
    state.forces = forces();
    const double scale = std::max(loads.force_scale, state.forces.norm());
    missing = in_forces(state.forces, bodies_->incompatibility(state.displacements));
    if (scale > 0.0) state.error = std::max(state.error, missing.norm() / scale);
  }
  return state;
}

// Forces on the b sides of the joints that hold.
VectorXd Structure::reactions_of(const VectorXd& port_forces) const {
  VectorXd r(2 * joints());
  for (int unknown = 0; unknown < r.size(); ++unknown)
    r(unknown) =
        holds(unknown) ? port_forces(bodies_->ends()[static_cast<std::size_t>(unknown)][1]) : 0.0;
  return r;
}

StructureResponse Structure::solve(const StructureLoads& loads) const {
  VectorXd on_ports(ports());
  VectorXd offsets = VectorXd::Zero(ports());  // what ports move beyond their unknowns
  std::vector<MatrixXd> forces;                // on the free degrees of freedom of each class
  forces.reserve(bodies_->classes().size());
  for (const BodyClass& group : bodies_->classes()) {  // (S3): condense the loads
    const BodyOperator& op = group.op;
    MatrixXd& on_class = forces.emplace_back(bodies_->gather(loads.forces, group));
    if (op.held()) {
      const MatrixXd moved = bodies_->gather(loads.prescribed, group);
      on_class.noalias() -= op.shifted * moved;
      bodies_->ports_in(offsets, group).noalias() = -op.ports * moved;
    }
    bodies_->ports_in(on_ports, group).noalias() = op.recovery.transpose() * on_class;
  }
  const VectorXd prescribed = offsets;
  for (int unknown = 0; unknown < 2 * static_cast<int>(joints()); ++unknown) {
    const auto& [a, b] = bodies_->ends()[static_cast<std::size_t>(unknown)];
    if (holds(unknown)) {
      offsets(b) += loads.jumps(unknown);  // side b moves beyond its unknown
    } else if (loads.given.size() > 0) {   // forces where nothing holds are loads
      on_ports(b) += loads.given(unknown);
      on_ports(a) -= loads.given(unknown);
    }
  }
  PortState start{std::move(offsets), {}, VectorXd::Zero(bodies_->compatibilities()), 0, 0.0};
  // Corrections start from the answer nearby: its ports as held here, less what is imposed.
  if (loads.near != nullptr) {
    start.displacements += as_held(bodies_->port_displacements(loads.near->displacements) -
                                   (start.displacements - prescribed));
    start.multipliers = loads.near->multipliers;
  }
  PortState state = solve_ports(loads, on_ports, std::move(start));
  VectorXd displacements = loads.prescribed;
  for (std::size_t k = 0; k < forces.size(); ++k) {  // (S4): recover the displacements
    const BodyClass& group = bodies_->classes()[k];
    MatrixXd moved = group.op.compliance * forces[k];
    moved.noalias() += group.op.recovery * bodies_->ports_in(state.displacements, group);
    if (group.op.held()) {  // its load is that of moving it: far larger than what the ports bear
      const MatrixXd lack = forces[k] - group.op.shifted * moved;
      moved.noalias() += group.op.compliance * lack;
      moved += bodies_->gather(loads.prescribed, group);
    }
    bodies_->scatter(moved, group, displacements);
  }
  // Joints that are not held bear what is given, those that slide friction on top.
  VectorXd reactions = reactions_of(state.forces);
  for (int unknown = 0; unknown < reactions.size() && loads.given.size() > 0; ++unknown)
    if (!holds(unknown)) reactions(unknown) = loads.given(unknown);
  for (Index j = 0; j < joints() && loads.friction.size() > 0; ++j)
    if (layout_.held[static_cast<std::size_t>(j)] == Held::normal)
      reactions(2 * j + 1) += loads.friction(j) * reactions(2 * j);
  state.displacements -= prescribed;
  return {std::move(displacements),
          std::move(reactions),
          state.forces(tops_of_ties_),
          bodies_->gaps(state.displacements),
          std::move(state.multipliers),
          state.solves,
          state.error};
}

}  // namespace havers::sim
