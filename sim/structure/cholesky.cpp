#include "sim/structure/cholesky.hpp"

#include <cholmod.h>

#include <cassert>
#include <cmath>
#include <cstring>

namespace havers::sim {
// CHOLMOD keeps its workspace in a `common`; one per thread makes a factor usable by all of them.
class CholmodCommon {
 public:
  CholmodCommon() {
    cholmod_start(&common_);
    // Simplicial: no BLAS, so that the numbers do not depend on which BLAS is installed or on its
    // threads.
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_ll = 1;
    common_.print = 0;
    common_.quick_return_if_not_posdef = 1;
  }
  ~CholmodCommon() {
    cholmod_free_dense(&y_, &common_);
    cholmod_free_dense(&e_, &common_);
    cholmod_free_dense(&x_, &common_);
    cholmod_finish(&common_);
  }
  CholmodCommon(const CholmodCommon&) = delete;
  CholmodCommon& operator=(const CholmodCommon&) = delete;

  cholmod_common* get() { return &common_; }
  cholmod_dense* solve(cholmod_factor* factor, cholmod_dense* b) {
    cholmod_solve2(CHOLMOD_A, factor, b, nullptr, &x_, nullptr, &y_, &e_, &common_);
    return x_;
  }

 private:
  cholmod_common common_{};
  cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;  // reused from solve to solve
};

namespace {

CholmodCommon& this_threads_common() {
  thread_local CholmodCommon common;
  return common;
}

}  // namespace

struct Cholesky::Factor {
  CholmodCommon common;  // owns the factor's memory, whichever thread frees it
  cholmod_factor* L = nullptr;
};

Cholesky::Cholesky(const Eigen::SparseMatrix<double>& lower) : factor_(std::make_unique<Factor>()) {
  assert(lower.isCompressed());
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(lower.rows());
  view.ncol = static_cast<std::size_t>(lower.cols());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  // CHOLMOD's views are not const; analysis and factorisation only read them.
  view.p = const_cast<int*>(lower.outerIndexPtr());  // NOLINT
  view.i = const_cast<int*>(lower.innerIndexPtr());  // NOLINT
  view.x = const_cast<double*>(lower.valuePtr());    // NOLINT
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  cholmod_common* common = factor_->common.get();
  factor_->L = cholmod_analyze(&view, common);
  cholmod_factorize(&view, factor_->L, common);
}

Cholesky::~Cholesky() {
  if (factor_ && factor_->L != nullptr) cholmod_free_factor(&factor_->L, factor_->common.get());
}
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&& other) noexcept {
  std::swap(factor_, other.factor_);
  return *this;
}

bool Cholesky::ok() const {
  return factor_->L != nullptr && factor_->L->minor == factor_->L->n;
}

Eigen::MatrixXd Cholesky::solve(const Eigen::MatrixXd& b) const {
  assert(ok());
  cholmod_dense view{};
  view.nrow = static_cast<std::size_t>(b.rows());
  view.ncol = static_cast<std::size_t>(b.cols());
  view.nzmax = static_cast<std::size_t>(b.size());
  view.d = static_cast<std::size_t>(b.rows());
  view.x = const_cast<double*>(b.data());  // NOLINT: only read
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  const cholmod_dense* x = this_threads_common().solve(factor_->L, &view);
  return Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), b.rows(), b.cols());
}

long Cholesky::nonzeros() const {
  long sum = 0;
  const cholmod_factor* L = factor_->L;
  if (L->is_super != 0) return static_cast<long>(L->xsize);
  for (std::size_t j = 0; j < L->n; ++j) sum += static_cast<const int*>(L->nz)[j];
  return sum;
}

}  // namespace havers::sim
