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
  MatrixXd displacements;  // p, offsets included; a case a column
  MatrixXd forces;         // t, on the bodies
  MatrixXd multipliers;    // a
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

// Corrections of the mixed system (S6) with the factor of its penalised form (S7): the residuals
// are those of the mixed system itself, so its accuracy is reached and not the penalty's.
Structure::PortState Structure::solve_ports(const MatrixXd& port_loads, const MatrixXd& offsets,
                                            double force_scale) const {
  PortState state{offsets, {}, MatrixXd::Zero(bodies_->compatibilities(), offsets.cols()), 0, 0.0};
  const auto forces = [&]() -> MatrixXd {
    return bodies_->port_forces(state.displacements, state.multipliers) - port_loads;
  };
  state.forces = forces();
  double before = 1.0;
  while (state.solves < max_solves) {
    const MatrixXd gap = bodies_->incompatibility(state.displacements);
    const MatrixXd imbalance = state.forces + penalty_ * bodies_->compatibility_forces(gap);
    const MatrixXd change = unknowns_to_ports(factor_->solve(ports_to_unknowns(-imbalance)));
    ++state.solves;
    const MatrixXd old = state.forces;
    state.displacements += change;
    state.multipliers += penalty_ * (gap + bodies_->incompatibility(change));
    state.forces = forces();
    const double scale = std::max(force_scale, state.forces.norm());
    state.correction = scale > 0.0 ? (state.forces - old).norm() / scale : 0.0;
    // The next correction is expected to shrink as this one did, but not by more than part of a
    // double's digits.
    const double shrinkage = std::max(state.correction / before, 1e-6);
    if (!(state.correction * std::min(shrinkage, 1.0) > accuracy)) break;
    if (state.solves > 3 && shrinkage > 0.5) break;
    before = state.correction;
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
        !(ports[i].unknown < 2 * joints() && detached(ports[i].unknown / 2)))
      r.row(ports[i].unknown) = port_forces.row(static_cast<Index>(i));
  return r;
}

StructureResponse Structure::solve(const StructureLoads& loads) const {
  const auto dof = [&](int body) { return bodies_->first_dof(body); };
  const auto port = [&](int body) { return bodies_->first_port(body); };
  const auto ports = static_cast<Index>(unknown_of_port_.size());
  MatrixXd offsets(ports, 1), port_loads(ports, 1), displacements(bodies_->dofs(), 1);

  for (const BodyClass& group : bodies_->classes()) {  // (S3): condense the loads
    const BodyOperator& op = group.op;
    const MatrixXd given = gather(loads.prescribed, group, op.shifted.rows(), dof);
    const MatrixXd forces =
        gather(loads.forces, group, op.shifted.rows(), dof) - op.shifted * given;
    scatter(op.recovery.transpose() * forces, group, port, port_loads);
    scatter(-op.ports * given, group, port, offsets);
    scatter(op.compliance * forces + given, group, dof, displacements);
  }
  const std::vector<Port>& all = bodies_->ports();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].side == PortSide::b && all[i].unknown < 2 * joints() &&
        !detached(all[i].unknown / 2))
      offsets(static_cast<Index>(i)) += loads.jumps(all[i].unknown);

  const PortState state = solve_ports(port_loads, offsets, loads.force_scale);
  for (const BodyClass& group : bodies_->classes()) {  // (S4): recover the displacements
    const MatrixXd& T = group.op.recovery;
    scatter(gather(displacements, group, T.rows(), dof) +
                T * gather(state.displacements, group, T.cols(), port),
            group, dof, displacements);
  }
  const MatrixXd reactions = reactions_of(state.forces);
  return {displacements, reactions.topRows(2 * joints()),
          reactions.bottomRows(reactions.rows() - 2 * joints()), state.solves, state.correction};
}

JumpResponse Structure::respond_to_jump(int joint) const {
  MatrixXd offsets = MatrixXd::Zero(static_cast<Index>(unknown_of_port_.size()), 2);
  const std::vector<Port>& ports = bodies_->ports();
  for (std::size_t i = 0; i < ports.size(); ++i)
    if (ports[i].side == PortSide::b && ports[i].unknown / 2 == joint)
      offsets(static_cast<Index>(i), ports[i].unknown % 2) = 1.0;
  const PortState state = solve_ports(MatrixXd::Zero(offsets.rows(), 2), offsets, 0.0);

  JumpResponse response{reactions_of(state.forces).topRows(2 * joints()),
                        MatrixXd::Zero(2 * joints(), 2)};
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (ports[i].unknown >= 2 * joints()) continue;
    const double sign = ports[i].side == PortSide::b ? 1.0 : -1.0;
    response.gaps.row(ports[i].unknown) += sign * state.displacements.row(static_cast<Index>(i));
  }
  return response;
}

}  // namespace havers::sim
