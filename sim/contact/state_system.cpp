// Equations of a set of states (C2), for paths on which one state changes at a time: the factor of
// some states serves their neighbours by a border (C6), and each solution starts from the last.
#include "sim/contact/state_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A few corrections take the effect of the trace on everything else away.
constexpr int corrections = 5;
constexpr double accuracy_of_solve = 1e-13;
constexpr double shrinkage = 0.5;  // by a correction, without which rounding is all that is left
// A bordered factor that leaves more of the reactions than this, and more than rounding leaves of
// those by the gaps, a sum of so many, is made anew.
constexpr double tolerated = 1e-10, rounding_of_gaps = 1.5e-16;
// Where nothing but the trace holds a piece that is pulled, a factor made anew leaves as much: what
// differs from that by less than this part is no reason for another one.
constexpr double as_much = 0.2;
// A border costs its cube, a factor that of all equations: so many, and a tenth of these.
constexpr std::size_t borders_at_least = 4;

}  // namespace

VectorXd cohesions(const LocalContact& p) {
  VectorXd c(static_cast<Index>(p.laws.size()));
  for (Index i = 0; i < c.size(); ++i) c(i) = p.laws[static_cast<std::size_t>(i)].cohesion;
  return c;
}

StateSystem::StateSystem(const LocalContact& problem) : problem_(&problem) {
  grow();
}

StateSystem::StateSystem(const LocalContact& problem, std::vector<JointState> states)
    : StateSystem(problem) {
  set(std::move(states));
}

void StateSystem::grow() {
  states_.resize(problem_->laws.size(), JointState::stick);
  place_.resize(2 * problem_->laws.size(), -1);
}

double StateSystem::scale() const {
  return problem_->S.diagonal().maxCoeff();
}

// The equation of a normal row is r_N + c = 0, that of a tangential one r_T + slope (r_N + c) = 0.
double StateSystem::coefficient(const Equation& equation, Index unknown) const {
  double value = problem_->S(unknown, equation.row);
  if (equation.slope != 0.0) value += equation.slope * problem_->S(unknown, equation.row - 1);
  return value;
}

std::vector<StateSystem::Equation> StateSystem::equations_of_states() const {
  std::vector<Equation> equations;
  equations.reserve(2 * states_.size());
  for (std::size_t i = 0; i < states_.size(); ++i) {
    // A joint that sticks has none: both of its gaps are given.
    const auto row = static_cast<Index>(2 * i);
    if (states_[i] == JointState::open) equations.push_back({row, 0.0});
    if (states_[i] != JointState::stick)
      equations.push_back({row + 1, slip_sign(states_[i]) * problem_->laws[i].friction});
  }
  return equations;
}

// O(n³) of n free gaps. Not symmetric where joints slide.
void StateSystem::factorise() {
  factorised_ = equations_;
  const auto n = static_cast<Index>(factorised_.size());
  const double hold = n > 0 ? problem_->trace * scale() : 0.0;
  MatrixXd matrix(n, n);
  std::fill(place_.begin(), place_.end(), -1);
  for (Index j = 0; j < n; ++j) {
    const Index unknown = factorised_[static_cast<std::size_t>(j)].row;
    place_[static_cast<std::size_t>(unknown)] = j;
    for (Index k = 0; k < n; ++k)
      matrix(k, j) = coefficient(factorised_[static_cast<std::size_t>(k)], unknown);
    matrix(j, j) += hold;
  }
  factor_.compute(matrix);
  columns_.clear();
  borders_.clear();
}

VectorXd StateSystem::from_factor(const VectorXd& load) const {
  return load.isZero(0.0) ? load : VectorXd(factor_.solve(load));
}

// The factor's answer to what a border adds to its equations: the effect of a gap that it does not
// know, or an arbitrary force in place of the row's equation.
const VectorXd& StateSystem::column(Index row) {
  const auto known = columns_.find(row);
  if (known != columns_.end()) return known->second;
  const auto n = static_cast<Index>(factorised_.size());
  VectorXd load = VectorXd::Zero(n);
  const Index place = place_[static_cast<std::size_t>(row)];
  if (place >= 0) load(place) = 1.0;
  for (Index k = 0; k < n && place < 0; ++k)
    load(k) = coefficient(factorised_[static_cast<std::size_t>(k)], row);
  return columns_.emplace(row, from_factor(load)).first->second;
}

// (C6). Whether the states are near enough to those of the factor.
bool StateSystem::border_factor() {
  std::vector<std::optional<double>> slopes(place_.size());
  // Slopes are by row, and none where the states have no equation.
  for (const Equation& equation : equations_)
    slopes[static_cast<std::size_t>(equation.row)] = equation.slope;
  borders_.clear();
  // Equations of the factor that the states do not have, or have with another slope: an unknown
  // force frees each of them.
  for (const Equation& old : factorised_) {
    const std::optional<double>& now = slopes[static_cast<std::size_t>(old.row)];
    if (now != old.slope) borders_.push_back({old.row, false, now});
  }
  // Equations that only the states have: each comes with a gap more.
  for (const Equation& equation : equations_)
    if (place_[static_cast<std::size_t>(equation.row)] < 0)
      borders_.push_back({equation.row, true, equation.slope});
  if (borders_.size() > borders_at_least + factorised_.size() / 10) return false;

  const auto n = static_cast<Index>(factorised_.size());
  const auto k = static_cast<Index>(borders_.size());
  border_columns_.resize(n, k);
  border_rows_ = MatrixXd::Zero(k, n);
  MatrixXd corner = MatrixXd::Zero(k, k);
  for (Index i = 0; i < k; ++i) {
    const Border& border = borders_[static_cast<std::size_t>(i)];
    border_columns_.col(i) = column(border.row);
    // The joint holds: its gap does not change, and that is the equation.
    if (!border.slope) {
      border_rows_(i, place_[static_cast<std::size_t>(border.row)]) = 1.0;
      continue;
    }
    const Equation equation{border.row, *border.slope};
    for (Index j = 0; j < n; ++j)
      border_rows_(i, j) = coefficient(equation, factorised_[static_cast<std::size_t>(j)].row);
    for (Index j = 0; j < k; ++j)
      if (borders_[static_cast<std::size_t>(j)].has_unknown)
        corner(i, j) = coefficient(equation, borders_[static_cast<std::size_t>(j)].row);
    // The trace, as in the factor.
    const double hold = problem_->trace * scale();
    if (border.has_unknown)
      corner(i, i) += hold;
    else
      border_rows_(i, place_[static_cast<std::size_t>(border.row)]) += hold;
  }
  if (k > 0) complement_.compute(corner - border_rows_ * border_columns_);
  return true;
}

// What the gaps lack by what the equations lack, one value for each row.
VectorXd StateSystem::corrected_by(const VectorXd& lack) {
  const auto n = static_cast<Index>(factorised_.size());
  const auto k = static_cast<Index>(borders_.size());
  VectorXd load(n), border_load(k);
  for (Index j = 0; j < n; ++j) load(j) = lack(factorised_[static_cast<std::size_t>(j)].row);
  for (Index i = 0; i < k; ++i) {
    const Border& border = borders_[static_cast<std::size_t>(i)];
    // An equation that is freed asks for nothing; the border's own equation takes its place.
    border_load(i) = border.slope ? lack(border.row) : 0.0;
    if (!border.has_unknown) load(place_[static_cast<std::size_t>(border.row)]) = 0.0;
  }
  VectorXd known = from_factor(load), change = VectorXd::Zero(lack.size());
  VectorXd added;
  // First the unknowns of the borders, by W − VA⁻¹U; then what they change in the factor's answer.
  if (k > 0) {
    added = complement_.solve(border_load - border_rows_ * known);
    known -= border_columns_ * added;
  }
  for (Index j = 0; j < n; ++j) change(factorised_[static_cast<std::size_t>(j)].row) = known(j);
  for (Index i = 0; i < k; ++i) {
    const Border& border = borders_[static_cast<std::size_t>(i)];
    if (border.has_unknown) change(border.row) = added(i);
    if (!border.slope) change(border.row) = 0.0;
  }
  return change;
}

// What the reactions lack in the equations, one value for each row.
MatrixXd StateSystem::lacking(const MatrixXd& r, const MatrixXd& cohesion) const {
  MatrixXd b = MatrixXd::Zero(r.rows(), r.cols());
  for (const auto& [row, slope] : equations_) {
    b.row(row) = -r.row(row);
    if (row % 2 == 0) b.row(row) -= cohesion.row(row / 2);
    if (slope != 0.0) b.row(row) -= slope * (r.row(row - 1) + cohesion.row(row / 2));
  }
  return b;
}

StateSolution StateSystem::solve() {
  const VectorXd& r0 = problem_->r0;
  return solve_from({VectorXd::Zero(r0.size()), r0}, r0, -problem_->u0, cohesions(*problem_),
                    accuracy_of_solve);
}

StateSolution StateSystem::solve_from(StateSolution known, const MatrixXd& r0, const MatrixXd& held,
                                      const MatrixXd& cohesion, double accuracy) {
  equations_ = equations_of_states();
  if (!border_factor()) factorise();
  // What the equations lack without gaps: the accuracy is a part of it.
  const double load = lacking(r0, cohesion).norm();
  StateSolution found = known;
  correct(found, held, cohesion, load, accuracy);
  if (borders_.empty()) return found;
  // A new factor is made only where the border lacks digits that the factor would have.
  const double lacks = lacking(found.r, cohesion).norm(),
               rounding = rounding_of_gaps * std::sqrt(static_cast<double>(found.y.rows()));
  if (lacks <= tolerated * found.r.norm() + rounding * scale() * found.y.norm() ||
      std::abs(lacks - left_by_a_factor_) <= as_much * left_by_a_factor_)
    return found;
  factorise();
  correct(known, held, cohesion, load, accuracy);
  left_by_a_factor_ = lacking(known.r, cohesion).norm();
  return known;
}

VectorXd StateSystem::forces_of(const VectorXd& change) const {
  return problem_->S * change;
}

// Gaps that the states hold are set, the others found.
void StateSystem::correct(StateSolution& solution, const MatrixXd& held, const MatrixXd& cohesion,
                          double load, double accuracy) {
  // Given gaps are set first, with what they do to all reactions.
  std::vector<char> free(place_.size(), 0);
  for (const Equation& equation : equations_) free[static_cast<std::size_t>(equation.row)] = 1;
  for (Index row = 0; row < held.rows(); ++row) {
    if (free[static_cast<std::size_t>(row)] != 0 || solution.y.row(row) == held.row(row)) continue;
    solution.r.noalias() += problem_->S.col(row) * (held.row(row) - solution.y.row(row));
    solution.y.row(row) = held.row(row);
  }
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= corrections && !equations_.empty(); ++i) {
    // Corrections with what the reactions lack, as long as each leaves half of it or less.
    const MatrixXd b = lacking(solution.r, cohesion);
    const double size = b.norm();
    if (size <= accuracy * load || size > shrinkage * before) break;
    before = size;
    // Where one state has changed, all loads lack the same but for a factor.
    Index most = 0;
    const double squared = b.colwise().squaredNorm().maxCoeff(&most);
    const Eigen::RowVectorXd factors = b.col(most).transpose() * b / squared;
    if ((b - b.col(most) * factors).norm() <= accuracy * load) {
      const VectorXd change = corrected_by(b.col(most));
      solution.y.noalias() += change * factors;
      solution.r.noalias() += forces_of(change) * factors;
      continue;
    }
    for (Index c = 0; c < b.cols(); ++c) {
      const VectorXd change = corrected_by(b.col(c));
      solution.y.col(c) += change;
      solution.r.col(c) += forces_of(change);
    }
  }
}

}  // namespace havers::sim
