// Each half of a solve reads a panel once, for all loads. Elimination asks for the values of the
// next panel ahead of its turn, and passes over panels that no load reaches.
#include "sim/structure/sparse_factor.hpp"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

#include "sim/memory.hpp"
#include "sim/structure/panel.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

Eigen::Map<const MatrixXd> values_of(const Panel& panel, const std::vector<double>& values) {
  return {values.data() + panel.values, static_cast<Index>(panel.height), panel.columns};
}

// Values that should be on their way while the panel before is worked on: none where the factor
// stays in the caches near a core.
std::span<const double> soon_needed(const Panel* panel, const std::vector<double>& values) {
  constexpr std::size_t in_cache = std::size_t{1} << 22U, at_most = 65536;  // bytes
  if (panel == nullptr || values.size() <= in_cache / sizeof(double)) return {};
  const std::size_t count = panel->height * static_cast<std::size_t>(panel->columns);
  return std::span(values).subspan(panel->values, std::min(count, at_most / sizeof(double)));
}

// Rows of a panel, while the values of the next one are asked for.
void gather(std::span<const int> rows, std::span<const double> next, const MatrixXd& x,
            Eigen::Ref<MatrixXd> part) {
  constexpr std::size_t in_a_line = 64 / sizeof(double);
  for (std::size_t i = 0; i < next.size(); i += in_a_line) __builtin_prefetch(&next[i]);
  part = x(rows, Eigen::all);
}

// x ← L⁻ᵀ x. Values are read from the last to the first.
void substitute_panels(const EliminationTree& tree, const std::vector<double>& values,
                       MatrixXd& x) {
  MatrixXd work(x.rows(), x.cols());
  for (auto panel = tree.panels.rbegin(); panel != tree.panels.rend(); ++panel) {
    auto part = work.topRows(static_cast<Index>(panel->height));
    part = x(tree.rows_of(*panel), Eigen::all);
    substitute_panel(values_of(*panel, values), part);
    x.middleRows(panel->first, panel->columns) = part.topRows(panel->columns);
  }
}

}  // namespace

SparseFactor::SparseFactor(const ElementMatrices& A, std::shared_ptr<const EliminationTree> tree,
                           const Pivots& pivots, std::vector<double> memory)
    : tree_(std::move(tree)), values_(std::move(memory)) {
  // Memory that was used before has its pages already.
  values_.clear();
  values_.reserve(tree_->values);
  ask_for_large_pages(values_.data(), tree_->values * sizeof(double));
  values_.assign(tree_->values, 0.0);
  using Panels = PanelStore<double>::Panels;
  inverse_pivots_ =
      factorise<double>(A, *tree_, pivots,
                        {[&](const Panel& panel) {
                           return Panels(values_.data() + panel.values,
                                         static_cast<Index>(panel.height), panel.columns);
                         },
                         [](const Panel&, const Panels&) {}});
}

MatrixXd SparseFactor::solve(const Eigen::Ref<const MatrixXd>& b) const {
  assert(ok());
  MatrixXd x(b.rows(), b.cols()), work(b.rows(), b.cols());
  x(tree_->place, Eigen::all) = b;
  for (const Panel& panel : tree_->panels) {
    // A panel that the load has not reached changes nothing.
    if (x.middleRows(panel.first, panel.columns).isZero(0.0)) continue;
    auto part = work.topRows(static_cast<Index>(panel.height));
    const Panel* const next = &panel == &tree_->panels.back() ? nullptr : &panel + 1;
    gather(tree_->rows_of(panel), soon_needed(next, values_), x, part);
    eliminate_panel(values_of(panel, values_), 0, part);
    x(tree_->rows_of(panel), Eigen::all) = part;
  }
  return complete(std::move(x));
}

MatrixXd SparseFactor::complete(MatrixXd x) const {
  x = inverse_pivots_.asDiagonal() * x;
  substitute_panels(*tree_, values_, x);
  return x(tree_->place, Eigen::all);
}

Eliminated SparseFactor::eliminate(std::vector<int> rows, const Eigen::MatrixX2d& values) const {
  assert(ok());
  thread_local MatrixXd x;  // zero between calls
  // It stays as long as the longest factor so far: to clear it for each call would cost more than
  // the path does.
  if (x.rows() < this->rows()) x.setZero(this->rows(), 2);
  for (int& row : rows) row = tree_->place[static_cast<std::size_t>(row)];
  x(rows, Eigen::all) = values;

  Eliminated half;
  MatrixXd work(this->rows(), 2);
  const int first = *std::min_element(rows.begin(), rows.end());
  const Panel* next = nullptr;
  for (const Panel* panel = &tree_->panel_of(first); panel != nullptr; panel = next) {
    next = tree_->parent_of(*panel);
    auto part = work.topRows(static_cast<Index>(panel->height));
    gather(tree_->rows_of(*panel), soon_needed(next, values_), x, part);
    // Columns before the first of the rows see zeros.
    const int begin = std::max(panel->first, first);
    eliminate_panel(values_of(*panel, values_), begin - panel->first, part);
    x(tree_->rows_of(*panel), Eigen::all) = part;
    for (int row = begin; row < panel->first + panel->columns; ++row) half.rows.push_back(row);
  }
  assert(std::all_of(rows.begin(), rows.end(), [&](int row) {
    return std::binary_search(half.rows.begin(), half.rows.end(), row);
  }));
  half.values = x(half.rows, Eigen::all).transpose();
  x(half.rows, Eigen::all).setZero();
  return half;
}

Eliminated SparseFactor::over_pivots(Eliminated half) const {
  half.values = half.values * inverse_pivots_(half.rows).asDiagonal();
  return half;
}

// Two paths that have met go on as one, and before that there is nothing to multiply.
Eigen::Matrix2d product(const Eliminated& a, const Eliminated& b) {
  // Seen from the root both paths are alike up to some row, which bisection finds.
  std::size_t common = 0, beyond = std::min(a.rows.size(), b.rows.size()) + 1;
  while (beyond - common > 1) {
    const std::size_t middle = (common + beyond) / 2;
    (a.rows[a.rows.size() - middle] == b.rows[b.rows.size() - middle] ? common : beyond) = middle;
  }
  const auto n = static_cast<Index>(common);
  return a.values.rightCols(n).lazyProduct(b.values.rightCols(n).transpose());
}

long SparseFactor::nonzeros() const {
  long sum = 0;
  for (const Panel& panel : tree_->panels)
    sum +=
        panel.columns * static_cast<long>(panel.height) - panel.columns * (panel.columns - 1L) / 2;
  return sum;
}

}  // namespace havers::sim
