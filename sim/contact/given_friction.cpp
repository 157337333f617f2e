#include "sim/contact/given_friction.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/contact/release_path.hpp"

namespace havers::sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A force below this part of the largest is none. [-]
constexpr double no_force = 1e-12;
// More changes than this for every component, and rounding leads in circles.
constexpr int most_changes = 20;
constexpr int most_rounds = 200;

// Cholesky factor of those rows and columns of a matrix that are in, in the order in which they
// came.
class PartialFactor {
 public:
  explicit PartialFactor(const MatrixXd& matrix)
      : matrix_(&matrix), L_(matrix.rows(), matrix.cols()) {}

  [[nodiscard]] const std::vector<Index>& rows() const { return rows_; }

  void start(std::vector<Index> rows) {
    rows_ = std::move(rows);
    const auto n = static_cast<Index>(rows_.size());
    L_.topLeftCorner(n, n) = (*matrix_)(rows_, rows_).llt().matrixL();
  }

  void add(Index row) {
    const auto n = static_cast<Index>(rows_.size());
    VectorXd border = (*matrix_)(rows_, row);
    L_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(border);
    L_.row(n).head(n) = border.transpose();
    L_(n, n) = std::sqrt((*matrix_)(row, row) - border.squaredNorm());
    rows_.push_back(row);
  }

  // What a row has taken from those after it is given back to them, in a sum of squares.
  void remove(Index row) {
    const auto place = std::find(rows_.begin(), rows_.end(), row);
    const Index k = place - rows_.begin(), m = static_cast<Index>(rows_.size()) - k - 1;
    VectorXd back = L_.col(k).segment(k + 1, m);
    L_.block(k, 0, m, k) = L_.block(k + 1, 0, m, k).eval();
    L_.block(k, k, m, m) = L_.block(k + 1, k + 1, m, m).eval();
    for (Index j = 0; j < m; ++j) {
      const Index after = m - j - 1;
      auto column = L_.col(k + j).segment(k + j + 1, after);
      double& diagonal = L_(k + j, k + j);
      const double larger = std::hypot(diagonal, back(j));
      const double cosine = diagonal / larger, sine = back(j) / larger;
      diagonal = larger;
      column = cosine * column + sine * back.tail(after);
      back.tail(after) = (back.tail(after) - sine * column) / cosine;
    }
    rows_.erase(place);
  }

  [[nodiscard]] VectorXd solve(VectorXd load) const {
    const Index n = load.size();
    const auto L = L_.topLeftCorner(n, n).triangularView<Eigen::Lower>();
    L.solveInPlace(load);
    L.transpose().solveInPlace(load);
    return load;
  }

 private:
  const MatrixXd* matrix_;
  MatrixXd L_;
  std::vector<Index> rows_;
};

// min ½ uᵀSu + bᵀu + Σ s |u_T| over u_N ≥ 0. Components that are not at zero are free, each on its
// side; one at a time becomes free where the function falls most steeply, and whatever would change
// its side on the way to their minimum stops at zero [LH74].
class ConvexContact {
 public:
  ConvexContact(const LocalContact& problem, VectorXd start)
      : problem_(problem),
        S_(problem.S),
        b_(problem.r0 - problem.S * problem.u0),
        bound_(VectorXd::Zero(static_cast<Index>(problem.laws.size()))),
        u_(std::move(start)),
        side_(static_cast<std::size_t>(b_.size()), 0),
        free_(S_) {
    const VectorXd c = cohesions(problem);
    for (Index i = 0; i < c.size(); ++i) b_(2 * i) += c(i);
    S_.diagonal().array() += problem.trace * S_.diagonal().maxCoeff();
    tolerance_ = no_force * b_.lpNorm<Eigen::Infinity>();
    for (Index row = 0; row < u_.size(); ++row) {
      if (row % 2 == 0 && !apart(row)) u_(row) = std::max(u_(row), 0.0);
      side_[static_cast<std::size_t>(row)] = (u_(row) > 0.0 ? 1 : 0) - (u_(row) < 0.0 ? 1 : 0);
    }
    std::vector<Index> free;
    for (Index row = 0; row < u_.size(); ++row)
      if (apart(row) || side_[static_cast<std::size_t>(row)] != 0) free.push_back(row);
    free_.start(std::move(free));
    if (!u_.isZero(0.0)) bound_by_pressures();
  }

  // Whether the minimum was found; `changes` counts.
  bool minimise(int& changes) {
    const int most = changes + most_changes * static_cast<int>(u_.size());
    for (; changes < most; ++changes) {
      move_to_minimum_of_free();
      if (!free_steepest()) return true;
    }
    return false;
  }

  // |R_T| ≤ μ (R_N + c) by the pressures found; whether that changes anything.
  bool bound_by_pressures() {
    const VectorXd before = bound_, pressure = S_ * u_ + b_;
    for (Index i = 0; i < bound_.size(); ++i)
      bound_(i) =
          problem_.laws[static_cast<std::size_t>(i)].friction * std::max(0.0, pressure(2 * i));
    return (bound_ - before).lpNorm<Eigen::Infinity>() > tolerance_;
  }

  [[nodiscard]] std::vector<JointState> states() const {
    std::vector<JointState> states(problem_.laws.size(), JointState::stick);
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (side_[2 * i + 1] > 0) states[i] = JointState::slip_forward;
      if (side_[2 * i + 1] < 0) states[i] = JointState::slip_backward;
      if (side_[2 * i] != 0 || problem_.is_apart(i)) states[i] = JointState::open;
    }
    return states;
  }

 private:
  [[nodiscard]] bool apart(Index row) const {
    return problem_.is_apart(static_cast<std::size_t>(row / 2));
  }
  [[nodiscard]] double friction(Index row) const {
    return row % 2 == 0 || apart(row) ? 0.0 : bound_(row / 2);
  }

  void move_to_minimum_of_free() {
    for (;;) {
      const std::vector<Index>& free = free_.rows();
      if (free.empty()) return;
      VectorXd load = b_(free);
      for (std::size_t k = 0; k < free.size(); ++k)
        load(static_cast<Index>(k)) += friction(free[k]) * side_[static_cast<std::size_t>(free[k])];
      const VectorXd goal = -free_.solve(load);

      double part = 1.0;
      Index stops = -1;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const Index row = free[k];
        const double to = goal(static_cast<Index>(k));
        if (apart(row) || to * side_[static_cast<std::size_t>(row)] > 0.0) continue;
        const double at = std::abs(u_(row)) / std::max(std::abs(u_(row) - to), 1e-300);
        if (stops < 0 || at < part) {
          part = std::min(at, 1.0);
          stops = row;
        }
      }
      for (std::size_t k = 0; k < free.size(); ++k)
        u_(free[k]) = (1.0 - part) * u_(free[k]) + part * goal(static_cast<Index>(k));
      if (stops < 0) return;
      u_(stops) = 0.0;
      side_[static_cast<std::size_t>(stops)] = 0;
      free_.remove(stops);
    }
  }

  bool free_steepest() {
    const VectorXd force = S_ * u_ + b_;
    Index steepest = -1;
    double most = tolerance_;
    for (Index row = 0; row < u_.size(); ++row) {
      if (apart(row) || side_[static_cast<std::size_t>(row)] != 0) continue;
      const double fall = row % 2 == 0 ? -force(row) : std::abs(force(row)) - friction(row);
      if (fall <= most) continue;
      most = fall;
      steepest = row;
    }
    if (steepest < 0) return false;
    side_[static_cast<std::size_t>(steepest)] = force(steepest) < 0.0 ? 1 : -1;
    free_.add(steepest);
    return true;
  }

  const LocalContact& problem_;
  MatrixXd S_;
  VectorXd b_, bound_, u_;
  std::vector<int> side_;  // of each component: its sign where it is free, else 0
  PartialFactor free_;
  double tolerance_ = 0.0;
};

}  // namespace

StatesOfGivenFriction states_by_given_friction(const LocalContact& problem, const VectorXd& start) {
  StatesOfGivenFriction found;
  ConvexContact convex(problem, start);
  for (int round = 0; round < most_rounds; ++round) {
    if (!convex.minimise(found.iterations)) break;
    found.states = convex.states();
    if (!convex.bound_by_pressures()) break;
  }
  return found;
}

}  // namespace havers::sim
