// Supervariables are found by splitting sets of rows, element by element: rows that no element
// parts stay together. That takes O(rows of all elements).
#include "sim/structure/element_matrices.hpp"

#include <algorithm>
#include <cassert>

namespace havers::sim {

namespace {

// Rows that no element tells apart have the same number; it says nothing else.
std::vector<int> told_apart(const ElementMatrices& sum) {
  struct Set {
    int split_by;  // the last element that has some of its rows,
    int those;     // and where these are now
  };
  std::vector<int> set_of(static_cast<std::size_t>(sum.size), 0);
  std::fill(set_of.end() - sum.multipliers, set_of.end(), 1);
  std::vector<Set> sets(2, Set{-1, -1});
  for (int e = 0; e < static_cast<int>(sum.elements.size()); ++e)
    // The rows of a set that are in the element move to a new set.
    for (const int row : sum.rows_of(sum.elements[static_cast<std::size_t>(e)])) {
      int& set = set_of[static_cast<std::size_t>(row)];
      if (sets[static_cast<std::size_t>(set)].split_by != e) {
        sets[static_cast<std::size_t>(set)] = {e, static_cast<int>(sets.size())};
        sets.push_back({-1, -1});
      }
      set = sets[static_cast<std::size_t>(set)].those;
    }
  return set_of;
}

}  // namespace

Supervariables::Supervariables(const ElementMatrices& sum) : of_rows_(told_apart(sum)) {
  assert(!of_rows_.empty());
  std::vector<int> number(1 + static_cast<std::size_t>(std::ranges::max(of_rows_)), -1);
  for (std::size_t row = 0; row < of_rows_.size(); ++row) {
    int& group = number[static_cast<std::size_t>(of_rows_[row])];
    if (group < 0) {
      group = count();
      sizes_.push_back(0);
    }
    of_rows_[row] = group;
    ++sizes_[static_cast<std::size_t>(group)];
    if (static_cast<int>(row) < sum.size - sum.multipliers) unknowns_ = count();
  }

  // An element couples all of its supervariables with each other.
  std::vector<Eigen::Triplet<char>> entries;
  std::vector<int> in_element;
  for (const ElementMatrices::Element& element : sum.elements) {
    in_element.clear();
    for (const int row : sum.rows_of(element))
      in_element.push_back(of_rows_[static_cast<std::size_t>(row)]);
    std::ranges::sort(in_element);
    in_element.erase(std::unique(in_element.begin(), in_element.end()), in_element.end());
    for (auto column = in_element.begin(); column != in_element.end(); ++column)
      for (auto row = column; row != in_element.end(); ++row)
        entries.emplace_back(*row, *column, 1);
  }
  graph_.resize(count(), count());
  graph_.setFromTriplets(entries.begin(), entries.end(), [](char one, char) { return one; });
}

}  // namespace havers::sim
