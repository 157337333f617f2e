#include "sim/structure/elimination_tree.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <new>
#include <string>
#include <utility>

namespace havers::sim {
namespace {

// CHOLMOD's analysis of a matrix, and what it counts.
class Analysis {
 public:
  explicit Analysis(const Eigen::SparseMatrix<double>& lower) {
    assert(lower.isCompressed());
    cholmod_start(&common_);
    common_.nmethods = 1;
    common_.print = 0;
    // No panels of columns that only nearly reach the same rows.
    for (std::size_t& columns : common_.nrelax) columns = 0;
    for (double& zeros : common_.zrelax) zeros = 0.0;
    // The view is not const; what it is given to only reads it.
    view_.nrow = static_cast<std::size_t>(lower.rows());
    view_.ncol = static_cast<std::size_t>(lower.cols());
    view_.nzmax = static_cast<std::size_t>(lower.nonZeros());
    view_.p = const_cast<int*>(lower.outerIndexPtr());  // NOLINT
    view_.i = const_cast<int*>(lower.innerIndexPtr());  // NOLINT
    view_.stype = -1;
    view_.itype = CHOLMOD_INT;
    view_.xtype = CHOLMOD_PATTERN;
    view_.dtype = CHOLMOD_DOUBLE;
    view_.sorted = 1;
    view_.packed = 1;
  }
  ~Analysis() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  /// @param order  given; null: of minimum degree
  const cholmod_factor& factor(int* order, int kind) {
    common_.supernodal = kind;
    common_.method[0].ordering = order != nullptr ? CHOLMOD_GIVEN : CHOLMOD_AMD;
    factor_ = cholmod_analyze_p(&view_, order, nullptr, 0, &common_);
    if (factor_ == nullptr) throw std::bad_alloc();
    return *factor_;
  }
  std::vector<int> least_degree_in(std::vector<int> parts) {
    std::vector<int> order(view_.nrow);
    if (cholmod_camd(&view_, nullptr, 0, parts.data(), order.data(), &common_) == 0)
      throw std::bad_alloc();
    return order;
  }
  [[nodiscard]] double operations() const { return common_.fl; }
  [[nodiscard]] double nonzeros() const { return common_.lnz; }

 private:
  cholmod_common common_{};
  cholmod_sparse view_{};
  cholmod_factor* factor_ = nullptr;
};

std::span<const int> span_of(const void* numbers, std::size_t count) {
  return {static_cast<const int*>(numbers), count};
}

}  // namespace

Order least_degree_order(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& parts) {
  Analysis analysis(lower);
  std::vector<int> given;
  if (!parts.empty()) given = analysis.least_degree_in(parts);
  const cholmod_factor& L =
      analysis.factor(given.empty() ? nullptr : given.data(), CHOLMOD_SIMPLICIAL);
  const auto rows = span_of(L.Perm, L.n);
  return {{rows.begin(), rows.end()}, analysis.nonzeros(), analysis.operations()};
}

EliminationTree elimination_tree(const Eigen::SparseMatrix<double>& lower, std::vector<int> order) {
  Analysis analysis(lower);
  const cholmod_factor& L = analysis.factor(order.data(), CHOLMOD_SUPERNODAL);
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
  for (int p = static_cast<int>(L.nsuper) - 1; p >= 0; --p) {
    Panel& panel = tree.panels[static_cast<std::size_t>(p)];
    panel.like = p;
    const auto below = tree.below(panel);
    if (below.empty()) continue;
    panel.parent = static_cast<int>(&tree.panel_of(below.front()) - tree.panels.data());
    panel.sibling = std::exchange(tree.panels[static_cast<std::size_t>(panel.parent)].child, p);
  }
  return tree;
}

// What a panel's values follow from, as bytes: its size, its entries, which panels its children are
// like and where their rows are in it.
void share_values(EliminationTree& tree, const Eigen::SparseMatrix<double>& matrix) {
  std::vector<int> row_at(tree.place.size()), where(tree.place.size());
  for (std::size_t row = 0; row < row_at.size(); ++row)
    row_at[static_cast<std::size_t>(tree.place[row])] = static_cast<int>(row);
  std::map<std::string, int> known;
  std::string key;
  const auto add = [&key](const auto& value) {
    key.append(reinterpret_cast<const char*>(&value), sizeof value);  // NOLINT(*-reinterpret-cast)
  };
  tree.values = 0;
  for (std::size_t p = 0; p < tree.panels.size(); ++p) {
    Panel& panel = tree.panels[p];
    std::ranges::sort(std::span(tree.rows)
                          .subspan(panel.at, panel.height)
                          .subspan(static_cast<std::size_t>(panel.columns)),
                      {}, [&](int place) { return row_at[static_cast<std::size_t>(place)]; });
    int height = 0;
    for (const int row : tree.rows_of(panel)) where[static_cast<std::size_t>(row)] = height++;
    key.clear();
    add(panel.columns);
    add(panel.height);
    for (int j = 0; j < panel.columns; ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, panel.first + j); entry;
           ++entry) {
        add(j);
        add(where[static_cast<std::size_t>(entry.row())]);
        add(entry.value());
      }
    for (const Panel* child = tree.at(panel.child); child; child = tree.at(child->sibling)) {
      add(~child->like);  // less than zero, as no entry's column is
      for (const int row : tree.below(*child)) add(where[static_cast<std::size_t>(row)]);
    }
    panel.like = known.try_emplace(key, static_cast<int>(p)).first->second;
    const Panel& first = tree.panels[static_cast<std::size_t>(panel.like)];
    panel.values = &first == &panel ? tree.values : first.values;
    if (&first == &panel) tree.values += panel.height * static_cast<std::size_t>(panel.columns);
  }
}

const Panel& EliminationTree::panel_of(int column) const {
  return *std::prev(std::ranges::upper_bound(panels, column, {}, &Panel::first));
}

}  // namespace havers::sim
