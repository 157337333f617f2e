// In which order a sparse symmetric matrix is eliminated, and what that fills (CHOLMOD).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/structure/element_matrices.hpp"

namespace havers::sim {

/// An order of elimination, of minimum degree (AMD).
/// @param parts  of each row: lower ones come first (CAMD); empty: one part
std::vector<int> least_degree_order(const Graph& graph, std::vector<int> parts = {});

/// What a factor costs.
struct Cost {
  double nonzeros = 0.0;
  double operations = 0.0;  ///< Of floating point, to find it.
};

/// @param order  of elimination
/// @param sizes  how many rows each row of the graph stands for
Cost cost_of(const Graph& graph, std::vector<int> order, std::span<const int> sizes);

/// Neighbouring columns of a factor that reach the same rows (a supernode).
struct Panel {
  int first, columns;      ///< In the order of elimination.
  std::size_t at, height;  ///< Among the rows of all panels: their own, then those below.
  std::size_t values;      ///< Before its own, in all panels.
  int parent = -1;         ///< The panel of the first row below.
  int child = -1;          ///< The first panel of those it is the parent of,
  int sibling = -1;        ///< and the next one after itself.
  int like = -1;           ///< The first panel of those that share their values.
  std::size_t elements = 0, element_count = 0;  ///< Of the matrix, that are added to it.
};

/// The panels of a factor, children before their parents.
struct EliminationTree {
  std::vector<int> place;  ///< Of each row, in the order of elimination.
  std::vector<Panel> panels;
  std::vector<int> rows;      ///< Of all panels, by their places.
  std::size_t values = 0;     ///< Of all panels, once of those that share them.
  std::vector<int> elements;  ///< Of all panels: each in that of the first of its rows.

  /// Places of its own rows, then of those below.
  [[nodiscard]] std::span<const int> rows_of(const Panel& panel) const {
    return std::span(rows).subspan(panel.at, panel.height);
  }
  [[nodiscard]] std::span<const int> below(const Panel& panel) const {
    return rows_of(panel).subspan(static_cast<std::size_t>(panel.columns));
  }
  /// Elements that are added to it, by their index in the sum.
  [[nodiscard]] std::span<const int> elements_of(const Panel& panel) const {
    return std::span(elements).subspan(panel.elements, panel.element_count);
  }
  [[nodiscard]] const Panel* parent_of(const Panel& panel) const { return at(panel.parent); }
  /// Of those that share their values.
  [[nodiscard]] bool is_first(const Panel& panel) const { return at(panel.like) == &panel; }
  /// None where there is no such panel.
  [[nodiscard]] const Panel* at(int panel) const {
    return panel < 0 ? nullptr : &panels[static_cast<std::size_t>(panel)];
  }
  /// The panel that has a column; O(log of the panels).
  [[nodiscard]] const Panel& panel_of(int column) const;
};

/// @param order  of elimination; rows that do not feel each other may change places
EliminationTree elimination_tree(const Graph& graph, std::vector<int> order);

/// The same for the rows of a matrix.
/// @param order  of its supervariables
EliminationTree elimination_tree(const ElementMatrices& sum, const Supervariables& groups,
                                 std::vector<int> order);

/// Lets panels share their values where these come out the same bit for bit: the same is added to
/// them, and to all that are eliminated before them and feel them. For that, rows below a panel's
/// own take the order of the matrix.
void share_values(EliminationTree& tree, const ElementMatrices& sum);

}  // namespace havers::sim
