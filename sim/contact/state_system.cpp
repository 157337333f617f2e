#include "sim/contact/state_system.hpp"

#include <algorithm>
#include <cmath>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

namespace {

// A piece that hangs on nothing leaves the equations singular: a trace of the largest stiffness
// holds it, and a few corrections take the trace's effect on everything else away. A long strip
// beside a crack bends as softly as 1e-8 of that, so the trace has to be less.
constexpr double trace = 1e-11;
constexpr int corrections = 5;
constexpr double accuracy = 1e-13;
// An updated inverse that leaves more of the reactions than this is made anew, and after so many
// updates in any case.
constexpr double tolerated = 1e-10;
constexpr int most_updates = 100;

double friction_slope(JointState state, const JointLaw& law) {
  if (state == JointState::slip_forward) return law.friction;
  if (state == JointState::slip_backward) return -law.friction;
  return 0.0;
}

}  // namespace

StateSystem::StateSystem(const LocalContact& problem) : problem_(&problem) {
  grow();
}

StateSystem::StateSystem(const LocalContact& problem, const std::vector<JointState>& states)
    : StateSystem(problem) {
  set(states);
}

void StateSystem::grow() {
  states_.resize(problem_->laws.size(), JointState::stick);
  place_.resize(2 * problem_->laws.size(), -1);
}

double StateSystem::scale() const {
  return problem_->S.diagonal().maxCoeff();
}

RowVectorXd StateSystem::coefficients(const Equation& equation) const {
  const auto n = static_cast<Index>(equations_.size());
  RowVectorXd row(n);
  for (Index k = 0; k < n; ++k) {
    const Index column = equations_[static_cast<std::size_t>(k)].row;
    row(k) = problem_->S(equation.row, column);
    if (equation.slope != 0.0) row(k) += equation.slope * problem_->S(equation.row - 1, column);
    if (column == equation.row) row(k) += trace * scale();
  }
  return row;
}

void StateSystem::factorise() {
  const auto n = static_cast<Index>(equations_.size());
  MatrixXd matrix(n, n);
  for (Index k = 0; k < n; ++k)
    matrix.row(k) = coefficients(equations_[static_cast<std::size_t>(k)]);
  if (inverse_.rows() < n) inverse_.resize(n, n);
  if (n > 0) inverse_.topLeftCorner(n, n) = matrix.partialPivLu().inverse();
  updates_ = 0;
}

// Bordering: one equation and its unknown more.
void StateSystem::add(Index row, double slope) {
  const auto n = static_cast<Index>(equations_.size());
  const RowVectorXd last = coefficients({row, slope});
  VectorXd column(n);
  for (Index k = 0; k < n; ++k) {
    const Equation& equation = equations_[static_cast<std::size_t>(k)];
    column(k) = problem_->S(equation.row, row);
    if (equation.slope != 0.0) column(k) += equation.slope * problem_->S(equation.row - 1, row);
  }
  place_[static_cast<std::size_t>(row)] = n;
  equations_.push_back({row, slope});
  if (inverse_.rows() <= n) inverse_.conservativeResize(2 * n + 8, 2 * n + 8);
  const RowVectorXd left = last * inverse_.topLeftCorner(n, n);
  const VectorXd right = inverse_.topLeftCorner(n, n) * column;
  double diagonal = problem_->S(row, row);
  if (slope != 0.0) diagonal += slope * problem_->S(row - 1, row);
  const double pivot = diagonal + trace * scale() - last.dot(right);
  inverse_.topLeftCorner(n, n) += right / pivot * left;
  inverse_.block(0, n, n, 1) = -right / pivot;
  inverse_.block(n, 0, 1, n) = -left / pivot;
  inverse_(n, n) = 1.0 / pivot;
  ++updates_;
}

void StateSystem::remove(Index row) {
  const Index gone = place_[static_cast<std::size_t>(row)];
  const auto last = static_cast<Index>(equations_.size()) - 1;
  auto used = inverse_.topLeftCorner(last + 1, last + 1);
  used.col(gone).swap(used.col(last));
  used.row(gone).swap(used.row(last));
  place_[static_cast<std::size_t>(equations_.back().row)] = gone;
  place_[static_cast<std::size_t>(row)] = -1;
  equations_[static_cast<std::size_t>(gone)] = equations_.back();
  equations_.pop_back();
  const VectorXd column = used.col(last).head(last) / used(last, last);
  const RowVectorXd below = used.row(last).head(last);
  used.topLeftCorner(last, last) -= column * below;
  ++updates_;
}

// Another slope of an equation: Sherman and Morrison's formula.
void StateSystem::incline(Index row, double slope) {
  const Index place = place_[static_cast<std::size_t>(row)];
  Equation& equation = equations_[static_cast<std::size_t>(place)];
  if (equation.slope == slope) return;
  const auto n = static_cast<Index>(equations_.size());
  const RowVectorXd before = coefficients(equation);
  equation.slope = slope;
  auto used = inverse_.topLeftCorner(n, n);
  const RowVectorXd change = (coefficients(equation) - before) * used;
  const VectorXd column = used.col(place) / (1.0 + change(place));
  used -= column * change;
  ++updates_;
}

void StateSystem::set(std::size_t joint, JointState state) {
  const auto normal = static_cast<Index>(2 * joint), tangent = normal + 1;
  const double slope = friction_slope(state, problem_->laws[joint]);
  const auto has = [&](Index row) { return place_[static_cast<std::size_t>(row)] >= 0; };
  states_[joint] = state;
  if (has(normal) && state != JointState::open) remove(normal);
  if (has(tangent) && state == JointState::stick) remove(tangent);
  if (has(tangent)) incline(tangent, slope);
  if (!has(tangent) && state != JointState::stick) add(tangent, slope);
  if (!has(normal) && state == JointState::open) add(normal, 0.0);
  const auto n = static_cast<Index>(equations_.size());
  if (updates_ > most_updates || !inverse_.topLeftCorner(n, n).allFinite()) factorise();
}

void StateSystem::set(const std::vector<JointState>& states) {
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i] != states_[i]) changed.push_back(i);
  if (4 * changed.size() < equations_.size()) {
    for (const std::size_t i : changed) set(i, states[i]);
    return;
  }
  states_ = states;
  equations_.clear();
  std::fill(place_.begin(), place_.end(), -1);
  const auto include = [&](Index row, double slope) {
    place_[static_cast<std::size_t>(row)] = static_cast<Index>(equations_.size());
    equations_.push_back({row, slope});
  };
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto row = static_cast<Index>(2 * i);
    if (states[i] == JointState::open) include(row, 0.0);
    if (states[i] != JointState::stick)
      include(row + 1, friction_slope(states[i], problem_->laws[i]));
  }
  factorise();
}

// What the reactions lack in the equations.
MatrixXd StateSystem::missing(const MatrixXd& r, const MatrixXd& cohesion) const {
  MatrixXd b(static_cast<Index>(equations_.size()), r.cols());
  for (Index k = 0; k < b.rows(); ++k) {
    const auto& [row, slope] = equations_[static_cast<std::size_t>(k)];
    b.row(k) = -r.row(row);
    if (row % 2 == 0) b.row(k) -= cohesion.row(row / 2);
    if (slope != 0.0) b.row(k) -= slope * (r.row(row - 1) + cohesion.row(row / 2));
  }
  return b;
}

namespace {

// A product for few columns: Eigen's would first copy the matrix into panels.
void add_product(const Eigen::Ref<const MatrixXd>& A, const MatrixXd& x, MatrixXd& sum) {
  for (Index c = 0; c < x.cols(); ++c) sum.col(c).noalias() += A * x.col(c);
}

}  // namespace

StateSolution StateSystem::solve(const MatrixXd& r0, const MatrixXd& held,
                                 const MatrixXd& cohesion) {
  StateSolution solution = try_to_solve(r0, held, cohesion);
  const auto lacks = [&] {
    const double size = missing(solution.r, cohesion).norm();
    return !(size <= tolerated * solution.r.norm());
  };
  if (updates_ == 0 || !lacks()) return solution;
  factorise();
  return try_to_solve(r0, held, cohesion);
}

StateSolution StateSystem::try_to_solve(const MatrixXd& r0, const MatrixXd& held,
                                        const MatrixXd& cohesion) const {
  StateSolution solution{held, r0};
  for (const Equation& equation : equations_) solution.y.row(equation.row).setZero();
  if (!solution.y.isZero(0.0)) add_product(problem_->S, solution.y, solution.r);
  const auto n = static_cast<Index>(equations_.size());
  double before = 0.0;
  for (int i = 0; i <= corrections && n > 0; ++i) {
    const MatrixXd b = missing(solution.r, cohesion);
    const double size = b.norm();
    if (i == 0) before = size;
    if (size <= accuracy * before) break;
    MatrixXd x = MatrixXd::Zero(n, b.cols()), change = MatrixXd::Zero(held.rows(), b.cols());
    add_product(inverse_.topLeftCorner(n, n), b, x);
    for (Index k = 0; k < n; ++k)
      change.row(equations_[static_cast<std::size_t>(k)].row) = x.row(k);
    solution.y += change;
    add_product(problem_->S, change, solution.r);
  }
  return solution;
}

}  // namespace havers::sim
