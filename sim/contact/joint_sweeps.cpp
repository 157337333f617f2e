// Non-smooth Gauss-Seidel [Jean99] on the displacements of the ports, which are kept up to date: a
// joint costs two columns of each of its bodies' answers, whatever the mesh. Displacements of nodes
// are found at the end.
#include "sim/contact/joint_sweeps.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::array<double, 4> tie_signs{1.0, -1.0, -1.0,
                                          1.0};  // top, bottom, next top, next bottom

// Ā⁻¹, zero in the rows and columns that the boundary holds.
MatrixXd inverse_of_free_part(const BodyOperator& op) {
  MatrixXd inverse = MatrixXd::Zero(op.shifted.rows(), op.shifted.rows());
  const MatrixXd A = op.shifted(op.free, op.free);
  const MatrixXd solution = A.llt().solve(MatrixXd::Identity(A.rows(), A.rows()));
  inverse(op.free, op.free) = solution;
  return inverse;
}

}  // namespace

JointSweeps::JointSweeps(const Bodies& bodies)
    : bodies_(&bodies), class_of_(bodies.assembly().bodies.size()) {
  for (std::size_t c = 0; c < bodies.classes().size(); ++c) {
    const BodyClass& group = bodies.classes()[c];
    inverses_.emplace_back(inverse_of_free_part(group.op));
    port_answers_.emplace_back(group.op.ports * inverses_.back() * group.op.ports.transpose());
    for (const int body : group.bodies) class_of_[static_cast<std::size_t>(body)] = c;
  }
  find_contacts();
  pair_ties();
}

double JointSweeps::answer(int body, Index row, Index column) const {
  const Index first = bodies_->first_port(body);
  return port_answers_[class_of_[static_cast<std::size_t>(body)]](row - first, column - first);
}

void JointSweeps::find_contacts() {
  const std::vector<Joint>& joints = bodies_->assembly().joints;
  contacts_.resize(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto &normal = bodies_->ends()[2 * j], &tangential = bodies_->ends()[2 * j + 1];
    Contact& contact = contacts_[j];
    contact.ports_a = {normal[0], tangential[0]};
    contact.ports_b = {normal[1], tangential[1]};
    contact.body_a = joints[j].body_a;
    contact.body_b = joints[j].body_b;
    // The gap by a unit of each reaction, through both bodies.
    Eigen::Matrix2d W;
    for (const std::size_t r : {0U, 1U})
      for (const std::size_t c : {0U, 1U})
        W(static_cast<Index>(r), static_cast<Index>(c)) =
            answer(contact.body_a, contact.ports_a[r], contact.ports_a[c]) +
            answer(contact.body_b, contact.ports_b[r], contact.ports_b[c]);
    contact.stiffness = W.inverse();
  }
}

void JointSweeps::pair_ties() {
  const std::vector<Tie>& ties = bodies_->assembly().ties;
  // Equation i holds the next tie at the height of tie i.
  for (std::size_t i = 0; i + 1 < ties.size(); ++i) {
    const Tie &tie = ties[i], &next = ties[i + 1];
    const auto &ends = bodies_->ends()[2 * contacts_.size() + i],
               &next_ends = bodies_->ends()[2 * contacts_.size() + i + 1];
    TieEquation equation{{ends[1], ends[0], next_ends[1], next_ends[0]},
                         {tie.body_top, tie.body_bottom, next.body_top, next.body_bottom},
                         0.0};
    // Its force acts on four ports, some of which may be of one body.
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        if (equation.bodies[a] == equation.bodies[b])
          equation.compliance += tie_signs[a] * tie_signs[b] *
                                 answer(equation.bodies[a], equation.ports[a], equation.ports[b]);
    ties_.push_back(equation);
  }
}

void JointSweeps::start(const JointStep& step, VectorXd reactions, const VectorXd& tie_forces) {
  reactions_ = std::move(reactions);
  states_ = step.states;
  // All is to be solved at least once.
  unrest_.setConstant(std::ssize(class_of_), std::numeric_limits<double>::infinity());
  moves_.resize(class_of_.size());
  between_ties_ = VectorXd::Zero(static_cast<Index>(ties_.size()));
  double sum = 0.0;  // an equation's force acts on its own tie and, the other way, on the next
  for (Index i = 0; i < between_ties_.size() && tie_forces.size() > 0; ++i)
    between_ties_(i) = sum += tie_forces(i);
  // The displacements by all forces so far; sweeps keep them up to date.
  p_ = bodies_->port_displacements(displacements(step));
}

VectorXd JointSweeps::tie_forces() const {
  VectorXd forces = VectorXd::Zero(static_cast<Index>(bodies_->assembly().ties.size()));
  for (Index i = 0; i < between_ties_.size(); ++i) {
    forces(i) += between_ties_(i);
    forces(i + 1) -= between_ties_(i);
  }
  return forces;
}

void JointSweeps::push(int body, std::array<Index, 2> ports, const Local& force) {
  const MatrixXd& answers = port_answers_[class_of_[static_cast<std::size_t>(body)]];
  const Index first = bodies_->first_port(body);
  p_.segment(first, answers.rows()) +=
      force.x() * answers.col(ports[0] - first) + force.y() * answers.col(ports[1] - first);
  unrest_(body) += force.lpNorm<1>();
}

double JointSweeps::opening(const TieEquation& tie) const {
  double difference = 0.0;
  for (std::size_t k = 0; k < 4; ++k) difference += tie_signs[k] * p_(tie.ports[k]);
  return difference;
}

bool JointSweeps::sweep(const JointStep& step, double relaxation, double negligible) {
  // Bodies that have felt enough change since their joints were last solved are marked; for them
  // the count begins anew.
  for (std::size_t body = 0; body < moves_.size(); ++body) {
    double& unrest = unrest_(static_cast<Index>(body));
    moves_[body] = unrest > negligible ? 1 : 0;
    if (moves_[body] != 0) unrest = 0.0;
  }
  const auto moves = [&](int body) { return moves_[static_cast<std::size_t>(body)] != 0; };
  bool changed = false;
  for (std::size_t j = 0; j < contacts_.size(); ++j) {
    const Contact& contact = contacts_[j];
    if (negligible > 0.0 && !moves(contact.body_a) && !moves(contact.body_b)) continue;
    const auto row = static_cast<Index>(2 * j);
    const Local gap = step.predicted.segment<2>(row) - step.held_at.segment<2>(row) +
                      p_(contact.ports_b) - p_(contact.ports_a);
    const Local old = reactions_.segment<2>(row);
    // What the joint would bear without a gap, the other forces on its two bodies staying as they
    // are.
    const Local free = old - contact.stiffness * gap;
    const SingleJoint found = solve_single_joint(contact.stiffness, free, step.laws[j]);
    // Over-relaxed reactions may lie outside their cones while sweeps go on.
    const Local now = old + relaxation * (found.reaction - old);
    push(contact.body_a, contact.ports_a, old - now);
    push(contact.body_b, contact.ports_b, now - old);
    reactions_.segment<2>(row) = now;
    changed = changed || found.state != states_[j];
    states_[j] = found.state;
  }
  // Ties hold in both directions: the force that closes one is added, whatever its sign.
  for (std::size_t i = 0; i < ties_.size(); ++i) {
    const double force = -opening(ties_[i]) / ties_[i].compliance;
    for (std::size_t k = 0; k < 4; ++k)
      push(ties_[i].bodies[k], {ties_[i].ports[k], ties_[i].ports[k]}, {tie_signs[k] * force, 0.0});
    between_ties_(static_cast<Index>(i)) += force;
  }
  return changed;
}

VectorXd JointSweeps::gaps(const JointStep& step) const {
  return step.predicted + bodies_->gaps(p_);
}

double JointSweeps::tie_gap() const {
  double squared = 0.0;
  for (const TieEquation& tie : ties_) squared += opening(tie) * opening(tie);
  return std::sqrt(squared);
}

VectorXd JointSweeps::port_forces() const {
  VectorXd t = bodies_->forces_of_joints(reactions_);
  for (std::size_t i = 0; i < ties_.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      t(ties_[i].ports[k]) += tie_signs[k] * between_ties_(static_cast<Index>(i));
  return t;
}

VectorXd JointSweeps::displacements(const JointStep& step) const {
  // What the sides prescribe is a load on all else.
  const VectorXd load = step.forces + bodies_->port_forces_on_nodes(port_forces()) -
                        bodies_->shifted_times(step.prescribed);
  VectorXd d = step.prescribed;
  for (std::size_t c = 0; c < inverses_.size(); ++c) {
    const BodyClass& group = bodies_->classes()[c];
    bodies_->scatter(bodies_->gather(d, group) + inverses_[c] * bodies_->gather(load, group), group,
                     d);
  }
  return d;
}

}  // namespace havers::sim
