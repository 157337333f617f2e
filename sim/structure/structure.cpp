#include "sim/structure/structure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Relative weights of the compatibility term: large enough that two corrections settle the
// multipliers, small enough to leave the factor half of its digits, which without inertia are
// fewer (M10).
constexpr double penalty_of_steps = 1e6, penalty_at_rest = 1e5;
constexpr double most_hold = 1e-9;  // of a mechanism, part of the diagonal
constexpr double usual_accuracy = 1e-12;
constexpr double accuracy_of_columns = 1e-16;  // wide cracks are sums of many that nearly cancel
constexpr int max_solves = 12;
constexpr int max_solves_with_friction = 40;

}  // namespace

// What acts at the ports of all bodies; a case a column.
struct Structure::PortLoads {
  MatrixXd forces;    // on the bodies
  MatrixXd offsets;   // displacements that the ports have beyond those of their unknowns
  VectorXd friction;  // of each joint; empty: none
  double force_scale = 0.0;
  double accuracy = 0.0;  // of the forces, relative
};

// Displacements, forces and compatibility multipliers at the ports of all bodies.
struct Structure::PortState {
  MatrixXd displacements;  // p, offsets included
  MatrixXd forces;         // t, on the bodies, beyond the loads
  MatrixXd multipliers;    // a
  int solves = 0;
  double error = 0.0;  // of the forces, relative, as far as the corrections tell
};

Structure::Structure(const Bodies& bodies, std::vector<Held> held)
    : bodies_(&bodies), held_(std::move(held)) {
  const Assembly& assembly = bodies.assembly();
  held_.resize(assembly.joints.size(), Held::fully);
  const int joint_unknowns = 2 * static_cast<int>(assembly.joints.size());
  int next = joint_unknowns + static_cast<int>(assembly.ties.size());

  ports_of_.resize(static_cast<std::size_t>(joint_unknowns));
  for (const Port& port : bodies.ports()) {
    const bool joint = port.unknown < joint_unknowns, b = port.side == PortSide::b;
    if (joint)
      ports_of_[static_cast<std::size_t>(port.unknown)][b ? 1 : 0] =
          static_cast<Index>(unknown_of_port_.size());
    // Where a joint does not hold, its side b has an unknown of its own.
    unknown_of_port_.push_back(joint && b && !holds(port.unknown) ? next++ : port.unknown);
    tie_top_.push_back(!joint && b ? 1 : 0);
  }
  unknowns_ =
      next + (assembly.ties.empty() ? 0 : 1);  // the last one is the distance common to all ties
  assemble();
}

bool Structure::holds(int unknown) const {
  const Held held = held_[static_cast<std::size_t>(unknown / 2)];
  return held == Held::fully || (held == Held::normal && unknown % 2 == 0);
}

void Structure::assemble() {
  bool at_rest = false;
  for (const BodyClass& bodies : bodies_->classes()) {
    at_rest = at_rest || bodies.op.at_rest;
    if (bodies.op.impedance.size() > 0)
      stiffness_ = std::max(stiffness_, bodies.op.impedance.diagonal().maxCoeff());
  }
  penalty_ = (at_rest ? penalty_at_rest : penalty_of_steps) * stiffness_;

  std::vector<Eigen::Triplet<double>> entries;
  for (const BodyClass& bodies : bodies_->classes()) {
    const MatrixXd& N = bodies.op.compatibility;
    const MatrixXd Z = bodies.op.impedance + penalty_ * N.transpose() * N;
    for (const int body : bodies.bodies) {
      const auto first = static_cast<std::size_t>(bodies_->first_port(body));
      const auto add = [&](Index row, Index column, double value) {
        if (row >= column)
          entries.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
      };
      for (std::size_t i = 0; i < static_cast<std::size_t>(Z.rows()); ++i)
        for (std::size_t j = 0; j < static_cast<std::size_t>(Z.rows()); ++j) {
          const double value = Z(static_cast<Index>(i), static_cast<Index>(j));
          const Index row = unknown_of_port_[first + i], column = unknown_of_port_[first + j];
          add(row, column, value);
          if (tie_top_[first + i] != 0) add(unknowns_ - 1, column, value);
          if (tie_top_[first + i] != 0 && tie_top_[first + j] != 0)
            add(unknowns_ - 1, unknowns_ - 1, value);
        }
    }
  }
  if (unknowns_ == 0) return;
  Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_.emplace(matrix);
  // A mechanism has nothing but its trace of inertia. The factor may hold it, for the corrections
  // take what it adds away from everything that bears a load.
  for (double hold = 1e-13; !factor_->ok() && hold < most_hold; hold *= 10.0) {
    matrix.diagonal() *= 1.0 + hold;
    factor_.emplace(matrix);
  }
}

MatrixXd Structure::unknowns_to_ports(const MatrixXd& unknowns) const {
  MatrixXd p(static_cast<Index>(unknown_of_port_.size()), unknowns.cols());
  for (Index c = 0; c < p.cols(); ++c)
    for (std::size_t i = 0; i < unknown_of_port_.size(); ++i)
      p(static_cast<Index>(i), c) =
          unknowns(unknown_of_port_[i], c) + (tie_top_[i] != 0 ? unknowns(unknowns_ - 1, c) : 0.0);
  return p;
}

MatrixXd Structure::ports_to_unknowns(const MatrixXd& forces) const {
  MatrixXd f = MatrixXd::Zero(unknowns_, forces.cols());
  for (Index c = 0; c < f.cols(); ++c)
    for (std::size_t i = 0; i < unknown_of_port_.size(); ++i) {
      f(unknown_of_port_[i], c) += forces(static_cast<Index>(i), c);
      if (tie_top_[i] != 0) f(unknowns_ - 1, c) += forces(static_cast<Index>(i), c);
    }
  return f;
}

// Takes the friction of sliding joints from the forces that the bodies still have to bear.
void Structure::rub(const VectorXd& friction, MatrixXd& port_forces) const {
  for (std::size_t j = 0; j < held_.size(); ++j) {
    const double slope = friction(static_cast<Index>(j));
    if (held_[j] != Held::normal || slope == 0.0) continue;
    const auto& [a, b] = ports_of_[2 * j + 1];
    for (Index c = 0; c < port_forces.cols(); ++c) {
      const double force = slope * port_forces(ports_of_[2 * j][1], c);
      port_forces(b, c) -= force;
      port_forces(a, c) += force;
    }
  }
}

// A correction, what it does to the equations, and that as one vector, all in units of a force.
struct Structure::Correction {
  MatrixXd displacements, multipliers, forces, gap;
  VectorXd effect;

  void subtract(double part, const Correction& other) {
    displacements -= part * other.displacements;
    multipliers -= part * other.multipliers;
    forces -= part * other.forces;
    gap -= part * other.gap;
    effect -= part * other.effect;
  }
};

VectorXd Structure::in_forces(const MatrixXd& forces, const MatrixXd& gap) const {
  const MatrixXd at_unknowns = ports_to_unknowns(forces);
  VectorXd all(at_unknowns.size() + gap.size());
  all << at_unknowns.reshaped(), stiffness_ * gap.reshaped();
  return all;
}

// One solve with the factor of the penalised form (S7), which knows no friction.
Structure::Correction Structure::correct(const MatrixXd& forces, const MatrixXd& gap,
                                         const VectorXd& friction) const {
  const MatrixXd imbalance = forces + penalty_ * bodies_->compatibility_forces(gap);
  Correction change;
  change.displacements = unknowns_to_ports(factor_->solve(ports_to_unknowns(-imbalance)));
  change.gap = bodies_->incompatibility(change.displacements);
  change.multipliers = penalty_ * (gap + change.gap);
  change.forces = bodies_->port_forces(change.displacements, change.multipliers);
  if (friction.size() > 0) {
    rub(friction, change.forces);
    change.effect = in_forces(change.forces, change.gap);
  }
  return change;
}

// Corrections of the mixed system (S6) until it is solved: its own residuals decide, so that its
// accuracy is reached and not the penalty's. Friction makes them generalised conjugate residuals
// [EES83].
Structure::PortState Structure::solve_ports(const PortLoads& loads) const {
  PortState state{
      loads.offsets, {}, MatrixXd::Zero(bodies_->compatibilities(), loads.offsets.cols()), 0, 0.0};
  const bool rubs = loads.friction.size() > 0 && !loads.friction.isZero(0.0);
  const VectorXd friction = rubs ? loads.friction : VectorXd();
  state.forces = bodies_->port_forces(state.displacements, state.multipliers) - loads.forces;
  if (rubs) rub(friction, state.forces);
  MatrixXd gap = bodies_->incompatibility(state.displacements);
  std::vector<Correction> past;
  double before = 1.0;
  while (state.solves < (rubs ? max_solves_with_friction : max_solves)) {
    Correction change = correct(state.forces, gap, friction);
    ++state.solves;
    double length = 1.0;
    if (rubs) {
      for (const Correction& old : past)
        change.subtract(change.effect.dot(old.effect) / old.effect.squaredNorm(), old);
      length = -in_forces(state.forces, gap).dot(change.effect) / change.effect.squaredNorm();
      if (!std::isfinite(length)) break;
    }
    state.displacements += length * change.displacements;
    state.multipliers += length * change.multipliers;
    state.forces += length * change.forces;
    gap += length * change.gap;
    const double scale = std::max(loads.force_scale, state.forces.norm());
    const double correction = scale > 0.0 ? std::abs(length) * change.forces.norm() / scale : 0.0;
    // The next correction is expected to shrink as this one did, but not by more than part of a
    // double's digits.
    const double shrinkage = std::max(correction / before, 1e-6);
    state.error = correction * std::min(shrinkage, 1.0);
    if (!(state.error > loads.accuracy)) break;
    if (state.solves > 3 && shrinkage > 0.5 && !rubs) break;
    before = correction;
    if (rubs) past.push_back(std::move(change));
  }
  return state;
}

// Forces on the b sides of joints, then of ties.
MatrixXd Structure::reactions_of(const MatrixXd& port_forces) const {
  MatrixXd r = MatrixXd::Zero(2 * joints() + static_cast<Index>(bodies_->assembly().ties.size()),
                              port_forces.cols());
  const std::vector<Port>& ports = bodies_->ports();
  for (std::size_t i = 0; i < ports.size(); ++i)
    if (ports[i].side == PortSide::b &&
        (ports[i].unknown >= 2 * joints() || holds(ports[i].unknown)))
      r.row(ports[i].unknown) = port_forces.row(static_cast<Index>(i));
  return r;
}

StructureResponse Structure::solve(const StructureLoads& loads) const {
  const auto dof = [&](int body) { return bodies_->first_dof(body); };
  const auto port = [&](int body) { return bodies_->first_port(body); };
  const auto ports = static_cast<Index>(unknown_of_port_.size());
  PortLoads at_ports{MatrixXd(ports, 1), MatrixXd(ports, 1), loads.friction, loads.force_scale,
                     usual_accuracy};
  MatrixXd displacements(bodies_->dofs(), 1);

  for (const BodyClass& group : bodies_->classes()) {  // (S3): condense the loads
    const BodyOperator& op = group.op;
    const MatrixXd given = gather(loads.prescribed, group, op.shifted.rows(), dof);
    const MatrixXd forces =
        gather(loads.forces, group, op.shifted.rows(), dof) - op.shifted * given;
    scatter(op.recovery.transpose() * forces, group, port, at_ports.forces);
    scatter(-op.ports * given, group, port, at_ports.offsets);
    scatter(op.compliance * forces + given, group, dof, displacements);
  }
  for (int unknown = 0; unknown < 2 * static_cast<int>(joints()); ++unknown) {
    const auto& [a, b] = ports_of_[static_cast<std::size_t>(unknown)];
    if (holds(unknown)) {
      at_ports.offsets(b) += loads.jumps(unknown);
    } else if (loads.given.size() > 0) {
      at_ports.forces(b) += loads.given(unknown);
      at_ports.forces(a) -= loads.given(unknown);
    }
  }

  const PortState state = solve_ports(at_ports);
  for (const BodyClass& group : bodies_->classes()) {  // (S4): recover the displacements
    const MatrixXd& T = group.op.recovery;
    scatter(gather(displacements, group, T.rows(), dof) +
                T * gather(state.displacements, group, T.cols(), port),
            group, dof, displacements);
  }
  const MatrixXd all = reactions_of(state.forces);
  VectorXd reactions = all.topRows(2 * joints());
  for (int unknown = 0; unknown < reactions.size() && loads.given.size() > 0; ++unknown)
    if (!holds(unknown)) reactions(unknown) = loads.given(unknown);
  for (Index j = 0; j < joints() && loads.friction.size() > 0; ++j)
    if (held_[static_cast<std::size_t>(j)] == Held::normal)
      reactions(2 * j + 1) += loads.friction(j) * reactions(2 * j);
  return {displacements, reactions, all.bottomRows(all.rows() - 2 * joints()), state.solves,
          state.error};
}

JumpResponse Structure::respond_to_jump(int joint) const {
  const auto ports = static_cast<Index>(unknown_of_port_.size());
  PortLoads loads{MatrixXd::Zero(ports, 2), MatrixXd::Zero(ports, 2), {}, 0.0, accuracy_of_columns};
  for (const std::size_t component : {0U, 1U}) {
    const std::size_t unknown = 2 * static_cast<std::size_t>(joint) + component;
    loads.offsets(ports_of_[unknown][1], static_cast<Index>(component)) = 1.0;
  }
  const PortState state = solve_ports(loads);

  JumpResponse response{reactions_of(state.forces).topRows(2 * joints()),
                        Eigen::MatrixX2d(2 * joints(), 2)};
  for (Index unknown = 0; unknown < 2 * joints(); ++unknown) {
    const auto& [a, b] = ports_of_[static_cast<std::size_t>(unknown)];
    response.gaps.row(unknown) = state.displacements.row(b) - state.displacements.row(a);
  }
  return response;
}

}  // namespace havers::sim
