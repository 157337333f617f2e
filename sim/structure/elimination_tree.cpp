#include "sim/structure/elimination_tree.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <new>

namespace havers::sim {
namespace {

// CHOLMOD keeps its settings and counts in a `common`.
class Cholmod {
 public:
  Cholmod(int ordering, int kind) {
    cholmod_start(&common_);
    common_.nmethods = 1;
    common_.method[0].ordering = ordering;
    common_.supernodal = kind;
    common_.print = 0;
    // No panels of columns that only nearly reach the same rows.
    for (std::size_t& columns : common_.nrelax) columns = 0;
    for (double& zeros : common_.zrelax) zeros = 0.0;
  }
  ~Cholmod() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  /// @param order  if it is given
  const cholmod_factor& analyse(const Eigen::SparseMatrix<double>& lower, int* order) {
    assert(lower.isCompressed());
    // The view is not const; what it is given to only reads it.
    cholmod_sparse view{};
    view.nrow = static_cast<std::size_t>(lower.rows());
    view.ncol = static_cast<std::size_t>(lower.cols());
    view.nzmax = static_cast<std::size_t>(lower.nonZeros());
    view.p = const_cast<int*>(lower.outerIndexPtr());  // NOLINT
    view.i = const_cast<int*>(lower.innerIndexPtr());  // NOLINT
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_PATTERN;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    cholmod_free_factor(&factor_, &common_);
    factor_ = cholmod_analyze_p(&view, order, nullptr, 0, &common_);
    if (factor_ == nullptr) throw std::bad_alloc();
    return *factor_;
  }
  [[nodiscard]] double operations() const { return common_.fl; }
  [[nodiscard]] double nonzeros() const { return common_.lnz; }

 private:
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

std::span<const int> span_of(const void* numbers, std::size_t count) {
  return {static_cast<const int*>(numbers), count};
}

}  // namespace

// Minimum degree is the quicker to find, and mostly the better one. Where much is left to do for
// each nonzero, nested dissection is tried too.
std::vector<int> order_of_little_fill(const Eigen::SparseMatrix<double>& lower) {
  constexpr double much = 200.0;  // floating-point operations
  Cholmod by_degree(CHOLMOD_AMD, CHOLMOD_SIMPLICIAL),
      by_dissection(CHOLMOD_NESDIS, CHOLMOD_SIMPLICIAL);
  const auto order_of = [](const cholmod_factor& factor) {
    const auto order = span_of(factor.Perm, factor.n);
    return std::vector<int>(order.begin(), order.end());
  };
  std::vector<int> order = order_of(by_degree.analyse(lower, nullptr));
  if (by_degree.operations() <= much * by_degree.nonzeros()) return order;
  const cholmod_factor& other = by_dissection.analyse(lower, nullptr);
  return by_dissection.operations() < by_degree.operations() ? order_of(other) : order;
}

EliminationTree elimination_tree(const Eigen::SparseMatrix<double>& lower, std::vector<int> order) {
  Cholmod cholmod(CHOLMOD_GIVEN, CHOLMOD_SUPERNODAL);
  const cholmod_factor& L = cholmod.analyse(lower, order.data());
  EliminationTree tree;
  tree.place.resize(L.n);
  int next = 0;
  for (const int row : span_of(L.Perm, L.n)) tree.place[static_cast<std::size_t>(row)] = next++;
  const auto rows = span_of(L.s, L.ssize);
  tree.rows.assign(rows.begin(), rows.end());
  const auto first = span_of(L.super, L.nsuper + 1), at = span_of(L.pi, L.nsuper + 1);
  tree.panels.reserve(L.nsuper);
  for (std::size_t p = 0; p < L.nsuper; ++p) {
    const auto begin = static_cast<std::size_t>(at[p]), end = static_cast<std::size_t>(at[p + 1]);
    const Panel panel{first[p], first[p + 1] - first[p], begin, end - begin, tree.values};
    tree.values += panel.height * static_cast<std::size_t>(panel.columns);
    tree.panels.push_back(panel);
  }
  for (Panel& panel : tree.panels) {
    const auto below = tree.rows_of(panel).subspan(static_cast<std::size_t>(panel.columns));
    if (!below.empty())
      panel.parent = static_cast<int>(&tree.panel_of(below.front()) - tree.panels.data());
  }
  return tree;
}

const Panel& EliminationTree::panel_of(int column) const {
  const auto behind =
      std::upper_bound(panels.begin(), panels.end(), column,
                       [](int place_of, const Panel& panel) { return place_of < panel.first; });
  return *std::prev(behind);
}

}  // namespace havers::sim
