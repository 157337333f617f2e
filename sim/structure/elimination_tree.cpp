// The graph of supervariables is analysed by CHOLMOD; then rows take the place of supervariables,
// panels get their elements, and those that have the same values are found, in the order of
// elimination.
#include "sim/structure/elimination_tree.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <new>
#include <numeric>
#include <utility>

namespace havers::sim {
namespace {

// CHOLMOD's analysis of a matrix.
class Analysis {
 public:
  explicit Analysis(const Graph& graph) {
    assert(graph.isCompressed());
    cholmod_start(&common_);
    common_.nmethods = 1;
    // The order is given; rows that do not feel each other may still change places.
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.print = 0;
    // No panels of columns that only nearly reach the same rows.
    for (std::size_t& columns : common_.nrelax) columns = 0;
    for (double& zeros : common_.zrelax) zeros = 0.0;
    // The view is not const; what it is given to only reads it.
    view_.nrow = static_cast<std::size_t>(graph.rows());
    view_.ncol = static_cast<std::size_t>(graph.cols());
    view_.nzmax = static_cast<std::size_t>(graph.nonZeros());
    view_.p = const_cast<int*>(graph.outerIndexPtr());  // NOLINT
    view_.i = const_cast<int*>(graph.innerIndexPtr());  // NOLINT
    view_.stype = -1;                                   // lower triangle
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

  const cholmod_factor& factor(std::vector<int> order) {
    factor_ = cholmod_analyze_p(&view_, order.data(), nullptr, 0, &common_);
    if (factor_ == nullptr) throw std::bad_alloc();
    return *factor_;
  }
  std::vector<int> least_degree(std::vector<int> parts) {
    std::vector<int> order(view_.nrow);
    const int done = parts.empty()
                         ? cholmod_amd(&view_, nullptr, 0, order.data(), &common_)
                         : cholmod_camd(&view_, nullptr, 0, parts.data(), order.data(), &common_);
    if (done == 0) throw std::bad_alloc();
    return order;
  }

 private:
  cholmod_common common_{};
  cholmod_sparse view_{};
  cholmod_factor* factor_ = nullptr;
};

std::span<const int> span_of(const void* numbers, std::size_t count) {
  return {static_cast<const int*>(numbers), count};
}

}  // namespace

std::vector<int> least_degree_order(const Graph& graph, std::vector<int> parts) {
  return Analysis(graph).least_degree(std::move(parts));
}

Cost cost_of(const Graph& graph, std::vector<int> order, std::span<const int> sizes) {
  const EliminationTree tree = elimination_tree(graph, std::move(order));
  // Counted in rows: a supervariable has several columns, each a row shorter than the one before.
  std::vector<int> size_at(tree.place.size());
  for (std::size_t row = 0; row < size_at.size(); ++row)
    size_at[static_cast<std::size_t>(tree.place[row])] = sizes[row];
  Cost cost;
  for (const Panel& panel : tree.panels) {
    double height = 0.0;
    for (const int place : tree.rows_of(panel)) height += size_at[static_cast<std::size_t>(place)];
    for (int place = panel.first; place < panel.first + panel.columns; ++place)
      for (int column = 0; column < size_at[static_cast<std::size_t>(place)]; ++column, --height) {
        cost.nonzeros += height;
        cost.operations += height * height;
      }
  }
  return cost;
}

EliminationTree elimination_tree(const Graph& graph, std::vector<int> order) {
  Analysis analysis(graph);
  const cholmod_factor& L = analysis.factor(std::move(order));
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
    tree.panels.push_back({first[p], first[p + 1] - first[p], begin, end - begin, 0});
  }
  // From the last on, so that children come in rising order.
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

namespace {

// Each supervariable's rows in its place.
EliminationTree in_rows(EliminationTree tree, const Supervariables& groups) {
  const auto size = [&](int group) { return groups.sizes()[static_cast<std::size_t>(group)]; };
  std::vector<int> first(tree.place.size() + 1, 0);  // row of each place
  for (std::size_t group = 0; group < tree.place.size(); ++group)
    first[static_cast<std::size_t>(tree.place[group]) + 1] = size(static_cast<int>(group));
  std::partial_sum(first.begin(), first.end(), first.begin());
  const auto begin_of = [&](int place) { return first[static_cast<std::size_t>(place)]; };

  std::vector<int> rows;
  for (Panel& panel : tree.panels) {
    const std::size_t at = rows.size();
    for (const int place : tree.rows_of(panel))
      for (int row = begin_of(place); row < begin_of(place + 1); ++row) rows.push_back(row);
    panel.columns = begin_of(panel.first + panel.columns) - begin_of(panel.first);
    panel.first = begin_of(panel.first);
    panel.at = at;
    panel.height = rows.size() - at;
    panel.values = tree.values;
    tree.values += panel.height * static_cast<std::size_t>(panel.columns);
  }
  tree.rows = std::move(rows);
  std::vector<int> next(tree.place.size());  // of each supervariable
  for (std::size_t group = 0; group < next.size(); ++group)
    next[group] = begin_of(tree.place[group]);
  tree.place.clear();
  for (const int group : groups.of_rows())
    tree.place.push_back(next[static_cast<std::size_t>(group)]++);
  return tree;
}

// Each element goes to the panel of the first of its rows, which reaches all others.
void hand_out_elements(EliminationTree& tree, const ElementMatrices& sum) {
  std::vector<std::size_t> of_element;
  for (const ElementMatrices::Element& element : sum.elements) {
    int first = sum.size;
    for (const int row : sum.rows_of(element))
      first = std::min(first, tree.place[static_cast<std::size_t>(row)]);
    of_element.push_back(static_cast<std::size_t>(&tree.panel_of(first) - tree.panels.data()));
    ++tree.panels[of_element.back()].element_count;
  }
  // Counted first, then put down one panel after the other.
  std::size_t next = 0;
  for (Panel& panel : tree.panels) {
    panel.elements = next;
    next += std::exchange(panel.element_count, 0);
  }
  tree.elements.resize(next);
  for (std::size_t e = 0; e < of_element.size(); ++e) {
    Panel& panel = tree.panels[of_element[e]];
    tree.elements[panel.elements + panel.element_count++] = static_cast<int>(e);
  }
}

}  // namespace

EliminationTree elimination_tree(const ElementMatrices& sum, const Supervariables& groups,
                                 std::vector<int> order) {
  EliminationTree tree = in_rows(elimination_tree(groups.graph(), std::move(order)), groups);
  hand_out_elements(tree, sum);
  return tree;
}

// What a panel's values follow from, as numbers: its size, its elements' matrices and which panels
// its children are like, each with where their rows are in it.
void share_values(EliminationTree& tree, const ElementMatrices& sum) {
  // The row of the matrix at each place, and where a place is in the panel that is looked at.
  std::vector<int> row_at(tree.place.size()), where(tree.place.size());
  for (std::size_t row = 0; row < row_at.size(); ++row)
    row_at[static_cast<std::size_t>(tree.place[row])] = static_cast<int>(row);
  std::map<std::vector<int>, int> known;
  std::vector<int> key;
  const auto add_place = [&](int place) { key.push_back(where[static_cast<std::size_t>(place)]); };
  tree.values = 0;
  // Children come first, so that what they are like is known.
  for (std::size_t p = 0; p < tree.panels.size(); ++p) {
    Panel& panel = tree.panels[p];
    // Rows below, in an order that does not depend on when they are eliminated.
    std::ranges::sort(std::span(tree.rows)
                          .subspan(panel.at, panel.height)
                          .subspan(static_cast<std::size_t>(panel.columns)),
                      {}, [&](int place) { return row_at[static_cast<std::size_t>(place)]; });
    int height = 0;
    for (const int row : tree.rows_of(panel)) where[static_cast<std::size_t>(row)] = height++;
    key.assign({panel.columns, height, static_cast<int>(panel.element_count)});
    // Pivots of multipliers have another sign, and other limits.
    for (int place = panel.first; place < panel.first + panel.columns; ++place)
      key.push_back(row_at[static_cast<std::size_t>(place)] < sum.size - sum.multipliers ? 0 : 1);
    for (const int e : tree.elements_of(panel)) {
      const ElementMatrices::Element& element = sum.elements[static_cast<std::size_t>(e)];
      key.push_back(element.matrix);
      for (const int row : sum.rows_of(element))
        add_place(tree.place[static_cast<std::size_t>(row)]);
    }
    for (const Panel* child = tree.at(panel.child); child; child = tree.at(child->sibling)) {
      key.push_back(child->like);
      for (const int row : tree.below(*child)) add_place(row);
    }
    panel.like = known.try_emplace(key, static_cast<int>(p)).first->second;
    const Panel& first = tree.panels[static_cast<std::size_t>(panel.like)];
    // Values are laid out anew, as a panel that is like an earlier one has none of its own.
    panel.values = &first == &panel ? tree.values : first.values;
    if (&first == &panel) tree.values += panel.height * static_cast<std::size_t>(panel.columns);
  }
}

const Panel& EliminationTree::panel_of(int column) const {
  return *std::prev(std::ranges::upper_bound(panels, column, {}, &Panel::first));
}

}  // namespace havers::sim
