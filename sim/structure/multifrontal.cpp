// Panel by panel in the order of elimination [DR83]: assemble, factorise, and hand on to the parent
// what is taken from the rows below. Only these fronts are kept besides the factor.
#include "sim/structure/multifrontal.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "sim/structure/panel.hpp"

namespace havers::sim {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// What panels take from rows below them, one for those that share their values, until the last
// parent has added it.
template <class Scalar>
class Fronts {
 public:
  using Matrix = Eigen::MatrixX<Scalar>;

  Fronts(const EliminationTree& tree, const ElementMatrices& sum)
      : tree_(tree),
        sum_(sum),
        where_(tree.place.size()),
        fronts_(tree.panels.size()),
        awaited_(tree.panels.size(), 0) {
    // A front is awaited once for each panel that shares it and whose parent is itself found.
    for (const Panel& panel : tree.panels)
      if (const Panel* parent = tree.parent_of(panel); parent != nullptr && tree.is_first(*parent))
        ++awaited_[static_cast<std::size_t>(panel.like)];
  }

  /// The elements of a panel and what its children take from its rows.
  /// @return what they take from those below, lower triangle
  Matrix assemble(const Panel& panel, Eigen::Ref<Matrix> own) {
    Index height = 0;
    for (const int row : tree_.rows_of(panel)) where_[static_cast<std::size_t>(row)] = height++;
    Matrix below = Matrix::Zero(height - own.cols(), height - own.cols());
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
  void keep(const Panel& panel, Matrix front) {
    const auto first = static_cast<std::size_t>(panel.like);
    if (awaited_[first] > 0) fronts_[first] = std::move(front);
  }

 private:
  void add_place(int row) {
    places_.push_back({where_[static_cast<std::size_t>(row)], std::ssize(places_)});
  }
  // A matrix of which the lower triangle counts, its rows at these places.
  void add(const auto& part, Eigen::Ref<Matrix> own, Matrix& below) {
    // Sorted by their place in the panel, so that only the lower triangle is added to.
    std::ranges::sort(places_);
    for (auto place = places_.begin(); place != places_.end(); ++place) {
      const auto [column, j] = *place;
      const Index above = column < own.cols() ? 0 : own.cols();  // rows that are not in it
      Scalar* const to = above == 0 ? &own(0, column) : &below(0, column - above);
      for (auto lower = place; lower != places_.end(); ++lower) {
        const auto [row, i] = *lower;
        to[row - above] += static_cast<Scalar>(part(std::max(i, j), std::min(i, j)));
      }
    }
  }

  const EliminationTree& tree_;
  const ElementMatrices& sum_;
  std::vector<Index> where_;                  // rows are in the panel that was assembled last
  std::vector<std::array<Index, 2>> places_;  // in a panel and in what is added to it
  std::vector<Matrix> fronts_;
  std::vector<int> awaited_;  // parents
};

}  // namespace

template <class Scalar>
VectorXd factorise(const ElementMatrices& A, const EliminationTree& tree, const Pivots& asked,
                   const PanelStore<Scalar>& store) {
  const auto multipliers = std::span(tree.place).last(static_cast<std::size_t>(A.multipliers));
  // Multipliers have negative pivots: K is positive definite, and N K⁻¹Nᵀ is taken away from 0.
  VectorXd sign = VectorXd::Ones(A.size), inverse_pivots(A.size);
  VectorXd least = VectorXd::Constant(A.size, asked.least_stiffness);
  sign(multipliers).setConstant(-1.0);
  least(multipliers).setConstant(asked.least);
  Fronts<Scalar> fronts(tree, A);
  for (const Panel& panel : tree.panels) {
    auto of_panel = [&](VectorXd& all) { return all.segment(panel.first, panel.columns).array(); };
    const auto signs = of_panel(sign);
    auto inverse = of_panel(inverse_pivots);
    if (tree.is_first(panel)) {
      auto own = store.zeros(panel);
      auto below = fronts.assemble(panel, own);
      // Added to rows of K alone.
      own.diagonal().array() += (asked.added * signs.max(0.0)).template cast<Scalar>();
      factorise_panel<Scalar>(own);
      take_panel_from<Scalar>(below, own);
      fronts.keep(panel, std::move(below));
      inverse = own.diagonal().array().template cast<double>().inverse();
      store.take(panel, own);
    } else {
      inverse = inverse_pivots.segment(tree.panels[static_cast<std::size_t>(panel.like)].first,
                                       panel.columns);
    }
    // A pivot that is no number is too small as well.
    const auto pivots = inverse.inverse();
    if (!(pivots * signs > of_panel(least)).all()) return {};
  }
  return inverse_pivots;
}

template VectorXd factorise(const ElementMatrices&, const EliminationTree&, const Pivots&,
                            const PanelStore<double>&);
template VectorXd factorise(const ElementMatrices&, const EliminationTree&, const Pivots&,
                            const PanelStore<float>&);

}  // namespace havers::sim
