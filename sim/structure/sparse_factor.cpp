#include "sim/structure/sparse_factor.hpp"

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <new>
#include <numeric>
#include <utility>

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// CHOLMOD keeps its workspace in a `common`; one per thread makes a factor usable by all of them.
class CholmodCommon {
 public:
  CholmodCommon() {
    cholmod_start(&common_);
    // Simplicial: no BLAS, so that the numbers do not depend on which BLAS is installed or on its
    // threads. L D Lᵀ: half of the pivots are negative.
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.print = 0;
  }
  ~CholmodCommon() {
    cholmod_free_dense(&b_, &common_);
    cholmod_free_dense(&x_, &common_);
    cholmod_free_dense(&y_, &common_);
    cholmod_free_dense(&e_, &common_);
    cholmod_free_sparse(&reached_, &common_);
    cholmod_finish(&common_);
  }
  CholmodCommon(const CholmodCommon&) = delete;
  CholmodCommon& operator=(const CholmodCommon&) = delete;

  cholmod_common* get() { return &common_; }

  const double* solve(int system, cholmod_factor* factor, cholmod_dense* b) {
    if (cholmod_solve2(system, factor, b, nullptr, &x_, nullptr, &y_, &e_, &common_) == 0)
      throw std::bad_alloc();
    return static_cast<const double*>(x_->x);
  }

  // L x = b for a column with entries in few rows, those of P; `b` is all zero again afterwards.
  cholmod_sparse* solve_sparse(cholmod_factor* factor, std::vector<int>& rows,
                               const VectorXd& values) {
    const std::size_t n = factor->n;
    if (b_ == nullptr || b_->nrow != n) {
      cholmod_free_dense(&b_, &common_);
      b_ = cholmod_zeros(n, 1, CHOLMOD_REAL, &common_);
    }
    auto* const b = static_cast<double*>(b_->x);
    for (std::size_t i = 0; i < rows.size(); ++i) b[rows[i]] = values(static_cast<Index>(i));
    std::array<int, 2> columns{0, static_cast<int>(rows.size())};
    cholmod_sparse set{};
    set.nrow = n;
    set.ncol = 1;
    set.nzmax = rows.size();
    set.p = columns.data();
    set.i = rows.data();
    set.itype = CHOLMOD_INT;
    set.xtype = CHOLMOD_PATTERN;
    set.dtype = CHOLMOD_DOUBLE;
    set.packed = 1;
    if (cholmod_solve2(CHOLMOD_L, factor, b_, &set, &x_, &reached_, &y_, &e_, &common_) == 0)
      throw std::bad_alloc();
    for (const int row : rows) b[row] = 0.0;
    return reached_;
  }
  [[nodiscard]] const double* solution() const { return static_cast<const double*>(x_->x); }

 private:
  cholmod_common common_{};
  // Reused from solve to solve.
  cholmod_dense *b_ = nullptr, *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
  cholmod_sparse* reached_ = nullptr;
};

namespace {

CholmodCommon& this_threads_common() {
  thread_local CholmodCommon common;
  return common;
}

// CHOLMOD's views are not const; what they are given to only reads them.
cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower) {
  assert(lower.isCompressed());
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(lower.rows());
  view.ncol = static_cast<std::size_t>(lower.cols());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  view.p = const_cast<int*>(lower.outerIndexPtr());  // NOLINT
  view.i = const_cast<int*>(lower.innerIndexPtr());  // NOLINT
  view.x = const_cast<double*>(lower.valuePtr());    // NOLINT
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

template <class Columns>
cholmod_dense view_of(const Columns& b) {
  cholmod_dense view{};
  view.nrow = view.d = static_cast<std::size_t>(b.rows());
  view.ncol = static_cast<std::size_t>(b.cols());
  view.nzmax = static_cast<std::size_t>(b.size());
  view.x = const_cast<double*>(b.data());  // NOLINT
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

}  // namespace

// Minimum degree is the quicker to find, and mostly the better one. Where much is left to do for
// each nonzero, nested dissection is tried too.
std::vector<int> order_of_little_fill(const Eigen::SparseMatrix<double>& lower) {
  constexpr double much = 200.0;  // floating-point operations
  CholmodCommon owner;
  cholmod_common* common = owner.get();
  common->nmethods = 1;
  cholmod_sparse view = view_of(lower);
  common->method[0].ordering = CHOLMOD_AMD;
  cholmod_factor* best = cholmod_analyze(&view, common);
  if (best == nullptr) throw std::bad_alloc();
  const double operations = common->fl;
  if (operations > much * common->lnz) {
    common->method[0].ordering = CHOLMOD_NESDIS;
    cholmod_factor* other = cholmod_analyze(&view, common);
    if (other != nullptr && common->fl < operations) std::swap(best, other);
    cholmod_free_factor(&other, common);
  }
  const auto* const order = static_cast<const int*>(best->Perm);
  std::vector<int> found(order, order + best->n);
  cholmod_free_factor(&best, common);
  return found;
}

struct SparseFactor::Factor {
  CholmodCommon common;  // owns the factor's memory, whichever thread frees it
  cholmod_factor* L = nullptr;
};

SparseFactor::SparseFactor(const Eigen::SparseMatrix<double>& lower, Index multipliers,
                           std::vector<int> order, double least_pivot)
    : factor_(std::make_unique<Factor>()) {
  cholmod_common* common = factor_->common.get();
  common->nmethods = 1;
  common->method[0].ordering = CHOLMOD_GIVEN;
  cholmod_sparse view = view_of(lower);
  factor_->L = cholmod_analyze_p(&view, order.data(), nullptr, 0, common);
  if (factor_->L != nullptr) cholmod_factorize(&view, factor_->L, common);
  if (common->status < CHOLMOD_OK) throw std::bad_alloc();

  const cholmod_factor* L = factor_->L;
  place_.resize(order.size());
  inverse_pivots_.resize(static_cast<Index>(order.size()));
  ok_ = L->minor == L->n;
  for (std::size_t j = 0; j < L->n; ++j) {
    const int row = static_cast<const int*>(L->Perm)[j];
    place_[static_cast<std::size_t>(row)] = static_cast<int>(j);
    const double pivot = static_cast<const double*>(L->x)[static_cast<const int*>(L->p)[j]];
    inverse_pivots_(static_cast<Index>(j)) = 1.0 / pivot;
    ok_ = ok_ && (row < lower.rows() - multipliers ? pivot > 0.0 : pivot < -least_pivot);
  }
}

SparseFactor::~SparseFactor() {
  if (factor_ && factor_->L != nullptr) cholmod_free_factor(&factor_->L, factor_->common.get());
}
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;
SparseFactor& SparseFactor::operator=(SparseFactor&& other) noexcept {
  std::swap(factor_, other.factor_);
  place_ = std::move(other.place_);
  inverse_pivots_ = std::move(other.inverse_pivots_);
  ok_ = other.ok_;
  return *this;
}

bool SparseFactor::ok() const {
  return ok_;
}

VectorXd SparseFactor::solve(const VectorXd& b) const {
  assert(ok());
  cholmod_dense view = view_of(b);
  const double* x = this_threads_common().solve(CHOLMOD_A, factor_->L, &view);
  return Eigen::Map<const VectorXd>(x, b.size());
}

Eliminated SparseFactor::eliminate(std::vector<int> rows, const Eigen::MatrixX2d& values) const {
  assert(ok());
  for (int& row : rows) row = place_[static_cast<std::size_t>(row)];
  CholmodCommon& common = this_threads_common();
  Eliminated half;
  for (const Index c : {0, 1}) {  // reaching the same rows
    const cholmod_sparse* reached = common.solve_sparse(factor_->L, rows, values.col(c));
    const auto* const first = static_cast<const int*>(reached->i);
    half.rows.assign(first, first + static_cast<const int*>(reached->p)[1]);
    std::sort(half.rows.begin(), half.rows.end());
    half.values.conservativeResize(2, static_cast<Index>(half.rows.size()));
    for (std::size_t i = 0; i < half.rows.size(); ++i)
      half.values(c, static_cast<Index>(i)) = common.solution()[half.rows[i]];
  }
  return half;
}

// Two paths that have met go on as one, and before that there is nothing to multiply.
Eigen::Matrix2d SparseFactor::product(const Eliminated& a, const Eliminated& b) const {
  std::size_t common = 0, beyond = std::min(a.rows.size(), b.rows.size()) + 1;
  while (beyond - common > 1) {
    const std::size_t middle = (common + beyond) / 2;
    (a.rows[a.rows.size() - middle] == b.rows[b.rows.size() - middle] ? common : beyond) = middle;
  }
  const auto n = static_cast<Index>(common);
  const Index first_a = a.values.cols() - n, first_b = b.values.cols() - n;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (Index i = 0; i < n; ++i) {
    const int row = a.rows[static_cast<std::size_t>(first_a + i)];
    sum += a.values.col(first_a + i) * inverse_pivots_(row) * b.values.col(first_b + i).transpose();
  }
  return sum;
}

MatrixXd SparseFactor::solve(const std::vector<const Eliminated*>& parts, const MatrixXd& y) const {
  assert(ok());
  MatrixXd half = MatrixXd::Zero(rows(), y.cols());
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (Index c = 0; c < y.cols(); ++c) {
      const Eigen::Vector2d factors = y.block<2, 1>(2 * static_cast<Index>(k), c);
      for (std::size_t i = 0; i < parts[k]->rows.size(); ++i)
        half(parts[k]->rows[i], c) += parts[k]->values.col(static_cast<Index>(i)).dot(factors);
    }
  cholmod_dense view = view_of(half);
  const Eigen::Map<const MatrixXd> x(this_threads_common().solve(CHOLMOD_DLt, factor_->L, &view),
                                     half.rows(), half.cols());
  return x(place_, Eigen::all);
}

long SparseFactor::nonzeros() const {
  const auto* const counts = static_cast<const int*>(factor_->L->nz);
  return std::accumulate(counts, counts + factor_->L->n, 0L);
}

}  // namespace havers::sim
