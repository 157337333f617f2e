#include "sim/structure/element_matrices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sim/structure/elimination_tree.hpp"

namespace havers::sim {
namespace {

// Two bodies that share rows 1 and 4; 0 and 3 are the first one's own, 2 is the second one's, and
// each has a multiplier. What is not in an element with another row does not feel it.
ElementMatrices two_bodies() {
  ElementMatrices sum{.size = 7, .multipliers = 2};
  sum.matrices = {Eigen::MatrixXd::Identity(5, 5), Eigen::MatrixXd::Identity(4, 4)};
  sum.elements = {{0, 0}, {1, 5}};
  sum.rows = {3, 0, 1, 4, 5, 4, 2, 1, 6};
  return sum;
}

TEST(Supervariables, AreTheRowsInTheSameElements) {
  const Supervariables groups(two_bodies());
  EXPECT_EQ(groups.of_rows(), (std::vector{0, 1, 2, 0, 1, 3, 4}));
  EXPECT_EQ(groups.sizes(), (std::vector{2, 2, 1, 1, 1}));
  EXPECT_EQ(groups.unknowns(), 3);
  Eigen::Matrix<int, 5, 5> felt;  // lower triangle
  felt << 1, 0, 0, 0, 0,          //
      1, 1, 0, 0, 0,              //
      0, 1, 1, 0, 0,              //
      1, 1, 0, 1, 0,              //
      0, 1, 1, 0, 1;
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      EXPECT_EQ(groups.graph().coeff(row, column) != 0, felt(row, column) != 0)
          << row << ' ' << column;
}

TEST(Supervariables, AreEliminatedWithTheirRowsOneAfterTheOther) {
  const ElementMatrices sum = two_bodies();
  const Supervariables groups(sum);
  const EliminationTree tree = elimination_tree(sum, groups, {0, 3, 2, 1, 4});
  std::size_t elements = 0;
  for (const Panel& panel : tree.panels) {
    elements += panel.element_count;
    for (const int element : tree.elements_of(panel)) {
      int first = sum.size;
      for (const int row : sum.rows_of(sum.elements[static_cast<std::size_t>(element)]))
        first = std::min(first, tree.place[static_cast<std::size_t>(row)]);
      EXPECT_EQ(&tree.panel_of(first), &panel);
    }
  }
  EXPECT_EQ(elements, sum.elements.size());
  EXPECT_EQ(tree.place[3], tree.place[0] + 1);
  EXPECT_EQ(tree.place[4], tree.place[1] + 1);
  EXPECT_LT(tree.place[0], tree.place[1]);
  EXPECT_LT(tree.place[2], tree.place[1]);
  // As if each row had been a supervariable: 0 and 3 reach 1, 4 and 5, 5 reaches 1 and 4, 2 reaches
  // 1, 4 and 6, and 1 and 4 reach 6.
  const Cost cost = cost_of(groups.graph(), {0, 3, 2, 1, 4}, groups.sizes());
  EXPECT_EQ(cost.nonzeros, 5 + 4 + 3 + 4 + 3 + 2 + 1);
  EXPECT_EQ(cost.operations, 25 + 16 + 9 + 16 + 9 + 4 + 1);
}

}  // namespace
}  // namespace havers::sim
