#include "sim/structure/structure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Relative weight of the compatibility term: large enough that one or two corrections settle the
// multipliers, small enough to leave the factor half of its digits.
constexpr double relative_penalty = 1e7;
constexpr double accuracy = 1e-12;
constexpr int max_solves = 8;

}  // namespace

// Displacements, forces and compatibility multipliers at the ports of all bodies.
struct Structure::PortState {
  VectorXd displacements;  // p, offsets included
  VectorXd forces;         // t, on the bodies
  VectorXd multipliers;    // a
  int solves = 0;
  double correction = 0.0;
};

Structure::Structure(const Bodies& bodies, std::vector<char> detached)
    : bodies_(&bodies), detached_(std::move(detached)) {
  const Assembly& assembly = bodies.assembly();
  detached_.resize(assembly.joints.size(), 0);
  const int joint_unknowns = 2 * static_cast<int>(assembly.joints.size());
  const int shared = joint_unknowns + static_cast<int>(assembly.ties.size());

  std::vector<int> own(static_cast<std::size_t>(joint_unknowns),
                       -1);  // of side b of detached joints
  int next = shared;
  for (std::size_t j = 0; j < detached_.size(); ++j)
    if (detached_[j] != 0)
      for (const std::size_t row : {2 * j, 2 * j + 1}) own[row] = next++;

  for (const Port& port : bodies.ports()) {
    const bool joint = port.unknown < joint_unknowns;
    const int apart = joint ? own[static_cast<std::size_t>(port.unknown)] : -1;
    unknown_of_port_.push_back(port.side == PortSide::b && apart >= 0 ? apart : port.unknown);
    tie_top_.push_back(!joint && port.side == PortSide::b ? 1 : 0);
  }
  unknowns_ =
      next + (assembly.ties.empty() ? 0 : 1);  // the last one is the distance common to all ties
  assemble();
}

void Structure::assemble() {
  double scale = 0.0;
  for (const BodyClass& bodies : bodies_->classes())
    if (bodies.op.impedance.size() > 0)
      scale = std::max(scale, bodies.op.impedance.diagonal().maxCoeff());
  penalty_ = relative_penalty * scale;

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
}

VectorXd Structure::unknowns_to_ports(const VectorXd& unknowns) const {
  VectorXd p(static_cast<Index>(unknown_of_port_.size()));
  for (std::size_t i = 0; i < unknown_of_port_.size(); ++i) {
    p(static_cast<Index>(i)) = unknowns(unknown_of_port_[i]);
    if (tie_top_[i] != 0) p(static_cast<Index>(i)) += unknowns(unknowns_ - 1);
  }
  return p;
}

VectorXd Structure::ports_to_unknowns(const VectorXd& forces) const {
  VectorXd f = VectorXd::Zero(unknowns_);
  for (std::size_t i = 0; i < unknown_of_port_.size(); ++i) {
    f(unknown_of_port_[i]) += forces(static_cast<Index>(i));
    if (tie_top_[i] != 0) f(unknowns_ - 1) += forces(static_cast<Index>(i));
  }
  return f;
}

// Corrections of the mixed system (S6) with the factor of its penalised form (S7): the residuals
// are those of the mixed system itself, so its accuracy is reached and not the penalty's.
Structure::PortState Structure::solve_ports(const VectorXd& port_loads,
                                            const VectorXd& offsets) const {
  PortState state;
  state.displacements = offsets;
  state.multipliers = VectorXd::Zero(bodies_->compatibilities());
  const auto forces = [&] {
    return VectorXd(bodies_->port_forces(state.displacements, state.multipliers) - port_loads);
  };

  state.forces = forces();
  double before = 1.0;
  while (state.solves < max_solves) {
    const VectorXd gap = bodies_->incompatibility(state.displacements);
    const VectorXd imbalance = state.forces + penalty_ * bodies_->compatibility_forces(gap);
    const VectorXd change = unknowns_to_ports(factor_->solve(ports_to_unknowns(-imbalance)));
    ++state.solves;
    const VectorXd old = state.forces;
    state.displacements += change;
    state.multipliers += penalty_ * (gap + bodies_->incompatibility(change));
    state.forces = forces();
    const double scale = state.forces.norm();
    state.correction = scale > 0.0 ? (state.forces - old).norm() / scale : 0.0;
    // The next correction is expected to shrink as this one did, but not by more than half of a
    // double's digits.
    const double shrinkage = std::max(state.correction / before, 1e-6);
    if (!(state.correction * std::min(shrinkage, 1.0) > accuracy)) break;
    if (state.solves > 3 && shrinkage > 0.5) break;
    before = state.correction;
  }
  return state;
}

VectorXd Structure::joint_reactions(const VectorXd& port_forces) const {
  VectorXd r = VectorXd::Zero(2 * joints() + static_cast<Index>(bodies_->assembly().ties.size()));
  const std::vector<Port>& ports = bodies_->ports();
  for (std::size_t i = 0; i < ports.size(); ++i)
    if (ports[i].side == PortSide::b) r(ports[i].unknown) = port_forces(static_cast<Index>(i));
  for (Index j = 0; j < joints(); ++j)
    if (detached(static_cast<int>(j))) r.segment<2>(2 * j).setZero();
  return r;
}

StructureResponse Structure::solve(const StructureLoads& loads) const {
  const auto dof = [&](int body) { return bodies_->first_dof(body); };
  const auto port = [&](int body) { return bodies_->first_port(body); };
  const Index ports = static_cast<Index>(unknown_of_port_.size());
  VectorXd offsets(ports), port_loads(ports), displacements(bodies_->dofs());

  for (const BodyClass& bodies : bodies_->classes()) {  // (S3): condense the loads
    const BodyOperator& op = bodies.op;
    const MatrixXd given = gather(loads.prescribed, bodies, op.shifted.rows(), dof);
    const MatrixXd forces =
        gather(loads.forces, bodies, op.shifted.rows(), dof) - op.shifted * given;
    scatter(op.recovery.transpose() * forces, bodies, port, port_loads);
    scatter(-op.ports * given, bodies, port, offsets);
    scatter(op.compliance * forces + given, bodies, dof, displacements);
  }
  const std::vector<Port>& all = bodies_->ports();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].side == PortSide::b && all[i].unknown < 2 * joints() &&
        !detached(all[i].unknown / 2))
      offsets(static_cast<Index>(i)) += loads.jumps(all[i].unknown);

  const PortState state = solve_ports(port_loads, offsets);
  for (const BodyClass& bodies : bodies_->classes()) {  // (S4): recover the displacements
    const MatrixXd& T = bodies.op.recovery;
    scatter(gather(displacements, bodies, T.rows(), dof) +
                T * gather(state.displacements, bodies, T.cols(), port),
            bodies, dof, displacements);
  }
  const VectorXd reactions = joint_reactions(state.forces);
  return {displacements, reactions.head(2 * joints()),
          reactions.tail(reactions.size() - 2 * joints()), state.solves, state.correction};
}

VectorXd Structure::reactions_to_jump(int joint, int component) const {
  VectorXd offsets = VectorXd::Zero(static_cast<Index>(unknown_of_port_.size()));
  const std::vector<Port>& all = bodies_->ports();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].side == PortSide::b && all[i].unknown == 2 * joint + component)
      offsets(static_cast<Index>(i)) = 1.0;
  return joint_reactions(solve_ports(VectorXd::Zero(offsets.size()), offsets).forces)
      .head(2 * joints());
}

}  // namespace havers::sim
