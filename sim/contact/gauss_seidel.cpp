#include "sim/contact/gauss_seidel.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int sweeps_between_checks = 10;
constexpr std::array<double, 4> tie_signs{1.0, -1.0, -1.0,
                                          1.0};  // top, bottom, next top, next bottom

MatrixXd inverse_of_free_part(const BodyOperator& op, const std::vector<char>& held, Index first) {
  std::vector<Index> free;
  for (Index i = 0; i < op.shifted.rows(); ++i)
    if (held[static_cast<std::size_t>(first + i)] == 0) free.push_back(i);
  const auto n = static_cast<Index>(free.size());
  MatrixXd inverse = MatrixXd::Zero(op.shifted.rows(), op.shifted.rows());
  const MatrixXd A = op.shifted(free, free);
  const MatrixXd solution = A.llt().solve(MatrixXd::Identity(n, n));
  inverse(free, free) = solution;
  return inverse;
}

}  // namespace

GaussSeidelSolver::GaussSeidelSolver(const Bodies& bodies, double tolerance, int max_sweeps)
    : bodies_(&bodies),
      tolerance_(tolerance),
      max_sweeps_(max_sweeps),
      class_of_(bodies.assembly().bodies.size()),
      reactions_(VectorXd::Zero(2 * static_cast<Index>(bodies.assembly().joints.size()))),
      stiffness_(joint_stiffness(bodies)) {
  for (std::size_t c = 0; c < bodies.classes().size(); ++c) {
    const BodyClass& group = bodies.classes()[c];
    inverses_.push_back(
        inverse_of_free_part(group.op, bodies.held(), bodies.first_dof(group.bodies.front())));
    port_answers_.push_back(group.op.ports * inverses_.back() * group.op.ports.transpose());
    for (const int body : group.bodies) class_of_[static_cast<std::size_t>(body)] = c;
  }
  find_contacts();
  tie_forces_ = VectorXd::Zero(static_cast<Index>(ties_.size()));
}

void GaussSeidelSolver::find_contacts() {
  const Assembly& assembly = bodies_->assembly();
  const std::size_t joints = assembly.joints.size();
  contacts_.resize(joints);
  std::vector<std::array<Index, 2>> tie_ports(assembly.ties.size());
  const std::vector<Port>& ports = bodies_->ports();
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const auto unknown = static_cast<std::size_t>(ports[i].unknown);
    const std::size_t side = ports[i].side == PortSide::b ? 1 : 0;
    if (unknown < 2 * joints)
      contacts_[unknown / 2].ports[2 * side + unknown % 2] = static_cast<Index>(i);
    else
      tie_ports[unknown - 2 * joints][1 - side] = static_cast<Index>(i);
  }
  const auto answer = [&](int body, Index row, Index column) {
    const Index first = bodies_->first_port(body);
    return port_answers_[class_of_[static_cast<std::size_t>(body)]](row - first, column - first);
  };
  for (std::size_t j = 0; j < joints; ++j) {
    Contact& contact = contacts_[j];
    contact.body_a = assembly.joints[j].body_a;
    contact.body_b = assembly.joints[j].body_b;
    Eigen::Matrix2d W;
    for (const Index r : {0, 1})
      for (const Index c : {0, 1})
        W(r, c) = answer(contact.body_a, contact.ports[static_cast<std::size_t>(r)],
                         contact.ports[static_cast<std::size_t>(c)]) +
                  answer(contact.body_b, contact.ports[static_cast<std::size_t>(2 + r)],
                         contact.ports[static_cast<std::size_t>(2 + c)]);
    contact.stiffness = W.inverse();
  }
  for (std::size_t i = 0; i + 1 < tie_ports.size(); ++i) {
    const Tie &tie = assembly.ties[i], &next = assembly.ties[i + 1];
    TieEquation equation{
        {tie_ports[i][0], tie_ports[i][1], tie_ports[i + 1][0], tie_ports[i + 1][1]},
        {tie.body_top, tie.body_bottom, next.body_top, next.body_bottom},
        0.0};
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        if (equation.bodies[a] == equation.bodies[b])
          equation.compliance += tie_signs[a] * tie_signs[b] *
                                 answer(equation.bodies[a], equation.ports[a], equation.ports[b]);
    ties_.push_back(equation);
  }
}

void GaussSeidelSolver::push(int body, Index port, double force, VectorXd& p) const {
  const MatrixXd& answers = port_answers_[class_of_[static_cast<std::size_t>(body)]];
  const Index first = bodies_->first_port(body);
  p.segment(first, answers.rows()) += force * answers.col(port - first);
}

void GaussSeidelSolver::sweep(const JointStep& step, VectorXd& p) {
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    const Contact& contact = contacts_[j];
    const auto row = static_cast<Index>(2 * j);
    const Local gap =
        step.predicted.segment<2>(row) - step.held_at.segment<2>(row) +
        Local(p(contact.ports[2]) - p(contact.ports[0]), p(contact.ports[3]) - p(contact.ports[1]));
    const Local old = reactions_.segment<2>(row);
    const Local free = old - contact.stiffness * gap;
    const Local now =
        free + contact.stiffness *
                   solve_single_joint(contact.stiffness, free, Local::Zero(), step.laws[j]).y;
    for (const Index c : {0, 1}) {
      push(contact.body_a, contact.ports[static_cast<std::size_t>(c)], old(c) - now(c), p);
      push(contact.body_b, contact.ports[static_cast<std::size_t>(2 + c)], now(c) - old(c), p);
    }
    reactions_.segment<2>(row) = now;
  }
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    const TieEquation& tie = ties_[i];
    double difference = 0.0;
    for (std::size_t k = 0; k < 4; ++k) difference += tie_signs[k] * p(tie.ports[k]);
    const double force = -difference / tie.compliance;
    for (std::size_t k = 0; k < 4; ++k) push(tie.bodies[k], tie.ports[k], tie_signs[k] * force, p);
    tie_forces_(static_cast<Index>(i)) += force;
  }
}

VectorXd GaussSeidelSolver::port_forces() const {
  VectorXd t = VectorXd::Zero(static_cast<Index>(bodies_->ports().size()));
  for (std::size_t j = 0; j < contacts_.size(); ++j)
    for (const std::size_t c : {0U, 1U}) {
      const double r = reactions_(static_cast<Index>(2 * j + c));
      t(contacts_[j].ports[c]) = -r;
      t(contacts_[j].ports[2 + c]) = r;
    }
  for (std::size_t i = 0; i < ties_.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      t(ties_[i].ports[k]) += tie_signs[k] * tie_forces_(static_cast<Index>(i));
  return t;
}

VectorXd GaussSeidelSolver::displacements(const JointStep& step,
                                          const VectorXd& port_forces) const {
  const VectorXd load = step.forces + bodies_->port_forces_on_nodes(port_forces) -
                        bodies_->shifted_times(step.prescribed);
  MatrixXd d = step.prescribed;
  const auto dof = [&](int body) { return bodies_->first_dof(body); };
  for (std::size_t c = 0; c < inverses_.size(); ++c) {
    const BodyClass& group = bodies_->classes()[c];
    const Index rows = inverses_[c].rows();
    scatter(gather(d, group, rows, dof) + inverses_[c] * gather(load, group, rows, dof), group, dof,
            d);
  }
  return d;
}

// Force that the worst open tie would cause.
double GaussSeidelSolver::tie_error(const VectorXd& p) const {
  double squared = 0.0;
  for (const TieEquation& tie : ties_) {
    double difference = 0.0;
    for (std::size_t k = 0; k < 4; ++k) difference += tie_signs[k] * p(tie.ports[k]);
    squared += difference * difference * stiffness_.maxCoeff() * stiffness_.maxCoeff();
  }
  return std::sqrt(squared);
}

JointStepResult GaussSeidelSolver::solve(const JointStep& step) {
  JointStepResult result;
  VectorXd p = bodies_->port_displacements(displacements(step, port_forces()));
  const auto measure = [&] {
    result.reactions = reactions_;
    result.gaps = step.predicted;
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      for (const std::size_t c : {0U, 1U})
        result.gaps(static_cast<Index>(2 * j + c)) +=
            p(contacts_[j].ports[2 + c]) - p(contacts_[j].ports[c]);
    const double scale = std::max(step.force_scale, reactions_.norm());
    result.residual =
        joint_residual(step, result, stiffness_) + (scale > 0.0 ? tie_error(p) / scale : 0.0);
    result.converged = result.residual <= tolerance_;
  };
  for (measure(); !result.converged && result.iterations < max_sweeps_; ++result.iterations) {
    sweep(step, p);
    if (result.iterations % sweeps_between_checks == sweeps_between_checks - 1) measure();
  }
  measure();
  result.displacements = displacements(step, port_forces());
  result.states = step.states;
  const double scale = reactions_.cwiseAbs().maxCoeff();
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    const auto row = static_cast<Index>(2 * j);
    // On the cone to within what the tolerance can tell.
    const double margin = cone_margin(reactions_.segment<2>(row), step.laws[j]);
    const double slip = result.gaps(row + 1) - step.held_at(row + 1);
    if (margin > tolerance_ * scale)
      result.states[j] = JointState::stick;
    else if (reactions_(row) + step.laws[j].cohesion <= tolerance_ * scale)
      result.states[j] = JointState::open;
    else
      result.states[j] = slip >= 0.0 ? JointState::slip_forward : JointState::slip_backward;
  }
  return result;
}

}  // namespace havers::sim
