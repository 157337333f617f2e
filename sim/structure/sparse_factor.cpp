#include "sim/structure/sparse_factor.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>
#include <span>
#include <utility>

#include "sim/memory.hpp"
#include "sim/structure/panel.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// What panels take from rows below them, one for those that share their values, until the last
// parent has added it.
class Fronts {
 public:
  Fronts(const EliminationTree& tree, const ElementMatrices& sum)
      : tree_(tree),
        sum_(sum),
        where_(tree.place.size()),
        fronts_(tree.panels.size()),
        awaited_(tree.panels.size(), 0) {
    for (const Panel& panel : tree.panels)
      if (const Panel* parent = tree.parent_of(panel); parent != nullptr && tree.is_first(*parent))
        ++awaited_[static_cast<std::size_t>(panel.like)];
  }

  /// The elements of a panel and what its children take from its rows.
  /// @return what they take from those below, lower triangle
  MatrixXd assemble(const Panel& panel, Eigen::Ref<MatrixXd> own) {
    Index height = 0;
    for (const int row : tree_.rows_of(panel)) where_[static_cast<std::size_t>(row)] = height++;
    MatrixXd below = MatrixXd::Zero(height - own.cols(), height - own.cols());
    for (const int e : tree_.elements_of(panel)) {
      const ElementMatrices::Element& element = sum_.elements[static_cast<std::size_t>(e)];
      places_.clear();
      for (const int row : sum_.rows_of(element))
        add_place(tree_.place[static_cast<std::size_t>(row)]);
      add(sum_.matrix_of(element), own, below);
    }
    for (const Panel* child = tree_.at(panel.child); child; child = tree_.at(child->sibling)) {
      const auto first = static_cast<std::size_t>(child->like);
      places_.clear();
      for (const int row : tree_.below(*child)) add_place(row);
      add(fronts_[first], own, below);
      if (--awaited_[first] == 0) fronts_[first].resize(0, 0);
    }
    return below;
  }
  void keep(const Panel& panel, MatrixXd front) {
    const auto first = static_cast<std::size_t>(panel.like);
    if (awaited_[first] > 0) fronts_[first] = std::move(front);
  }

 private:
  void add_place(int row) {
    places_.push_back({where_[static_cast<std::size_t>(row)], std::ssize(places_)});
  }
  // A matrix of which the lower triangle counts, its rows at these places.
  void add(const MatrixXd& part, Eigen::Ref<MatrixXd> own, MatrixXd& below) {
    std::ranges::sort(places_);
    for (auto place = places_.begin(); place != places_.end(); ++place) {
      const auto [column, j] = *place;
      double* const to =
          column < own.cols() ? &own(0, column) : &below(0, column - own.cols()) - own.cols();
      for (auto lower = place; lower != places_.end(); ++lower) {
        const auto [row, i] = *lower;
        to[row] += part(std::max(i, j), std::min(i, j));
      }
    }
  }

  const EliminationTree& tree_;
  const ElementMatrices& sum_;
  std::vector<Index> where_;                  // rows are in the panel that was assembled last
  std::vector<std::array<Index, 2>> places_;  // in a panel and in what is added to it
  std::vector<MatrixXd> fronts_;
  std::vector<int> awaited_;  // parents
};

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

SparseFactor::SparseFactor(const ElementMatrices& A, EliminationTree tree, const Pivots& pivots,
                           std::vector<double> memory)
    : tree_(std::move(tree)), values_(std::move(memory)), inverse_pivots_(A.size) {
  values_.clear();
  values_.reserve(tree_.values);
  ask_for_large_pages(values_.data(), tree_.values * sizeof(double));
  values_.assign(tree_.values, 0.0);
  ok_ = factorise(A, pivots);
}

// Multifrontal: a panel is complete when its children have handed on what they take from it.
bool SparseFactor::factorise(const ElementMatrices& A, const Pivots& asked) {
  VectorXd sign = VectorXd::Ones(A.size);
  sign(std::span(tree_.place).last(static_cast<std::size_t>(A.multipliers))).setConstant(-1.0);
  Fronts fronts(tree_, A);
  for (const Panel& panel : tree_.panels) {
    Eigen::Map<MatrixXd> own(values_.data() + panel.values, static_cast<Index>(panel.height),
                             panel.columns);
    const auto signs = sign.segment(panel.first, panel.columns).array();
    if (tree_.is_first(panel)) {
      MatrixXd below = fronts.assemble(panel, own);
      own.diagonal().array() += asked.added * signs.max(0.0);
      factorise_panel(own);
      take_panel_from(below, own);
      fronts.keep(panel, std::move(below));
    }
    const auto pivots = own.diagonal().array();
    if (!(pivots * signs > (signs < 0.0).cast<double>() * asked.least).all()) return false;
    inverse_pivots_.segment(panel.first, panel.columns) = pivots.inverse();
  }
  return true;
}

MatrixXd SparseFactor::solve(const Eigen::Ref<const MatrixXd>& b) const {
  assert(ok());
  MatrixXd x(b.rows(), b.cols()), work(b.rows(), b.cols());
  x(tree_.place, Eigen::all) = b;
  for (const Panel& panel : tree_.panels) {
    if (x.middleRows(panel.first, panel.columns).isZero(0.0)) continue;
    auto part = work.topRows(static_cast<Index>(panel.height));
    const Panel* const next = &panel == &tree_.panels.back() ? nullptr : &panel + 1;
    gather(tree_.rows_of(panel), soon_needed(next, values_), x, part);
    eliminate_panel(values_of(panel, values_), 0, part);
    x(tree_.rows_of(panel), Eigen::all) = part;
  }
  return complete(std::move(x));
}

MatrixXd SparseFactor::complete(MatrixXd x) const {
  x = inverse_pivots_.asDiagonal() * x;
  substitute_panels(tree_, values_, x);
  return x(tree_.place, Eigen::all);
}

Eliminated SparseFactor::eliminate(std::vector<int> rows, const Eigen::MatrixX2d& values) const {
  assert(ok());
  thread_local MatrixXd x;  // zero between calls
  if (x.rows() < this->rows()) x.setZero(this->rows(), 2);
  for (int& row : rows) row = tree_.place[static_cast<std::size_t>(row)];
  x(rows, Eigen::all) = values;

  Eliminated half;
  MatrixXd work(this->rows(), 2);
  const int first = *std::min_element(rows.begin(), rows.end());
  const Panel* next = nullptr;
  for (const Panel* panel = &tree_.panel_of(first); panel != nullptr; panel = next) {
    next = tree_.parent_of(*panel);
    auto part = work.topRows(static_cast<Index>(panel->height));
    gather(tree_.rows_of(*panel), soon_needed(next, values_), x, part);
    const int begin = std::max(panel->first, first);
    eliminate_panel(values_of(*panel, values_), begin - panel->first, part);
    x(tree_.rows_of(*panel), Eigen::all) = part;
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
  for (const Panel& panel : tree_.panels)
    sum +=
        panel.columns * static_cast<long>(panel.height) - panel.columns * (panel.columns - 1L) / 2;
  return sum;
}

}  // namespace havers::sim
