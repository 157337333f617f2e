#include "sim/structure/elimination_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace havers::sim {
namespace {

int nonzeros_of(const EliminationTree& tree) {
  int sum = 0;
  for (const Panel& panel : tree.panels)
    for (int j = 0; j < panel.columns; ++j) sum += static_cast<int>(panel.height) - j;
  return sum;
}

TEST(LeastDegreeOrder, LeavesNoFillInAStar) {
  constexpr int arms = 20;  // eliminated first, the centre would connect them all
  std::vector<Eigen::Triplet<char>> entries;
  for (int i = 1; i <= arms; ++i) entries.emplace_back(i, 0, 1);
  Graph star(arms + 1, arms + 1);
  star.setFromTriplets(entries.begin(), entries.end());
  const std::vector<int> sizes(arms + 1, 1), order = least_degree_order(star);
  EXPECT_EQ(cost_of(star, order, sizes).nonzeros, 2 * arms + 1);
  EXPECT_EQ(nonzeros_of(elimination_tree(star, order)), 2 * arms + 1);
  // The centre in a part before the others'.
  std::vector<int> parts(arms + 1, 1);
  parts[0] = 0;
  const std::vector<int> worst = least_degree_order(star, parts);
  EXPECT_EQ(worst[0], 0);
  EXPECT_EQ(cost_of(star, worst, sizes).nonzeros, (arms + 1) * (arms + 2) / 2);
  EXPECT_EQ(nonzeros_of(elimination_tree(star, worst)), (arms + 1) * (arms + 2) / 2);
}

// What a panel takes from the rows below it is all that its parent needs of it: these are the
// parent's own or below them too. Panels that share a parent come directly one after the other,
// with what is below each of them.
TEST(EliminationTree, HandsRowsOnFromChildToParent) {
  constexpr int side = 12;
  std::vector<Eigen::Triplet<char>> entries;
  for (int i = 0; i < side * side; ++i) {
    if (i % side + 1 < side) entries.emplace_back(i + 1, i, 1);
    if (i + side < side * side) entries.emplace_back(i + side, i, 1);
  }
  Graph grid(side * side, side * side);
  grid.setFromTriplets(entries.begin(), entries.end());
  const EliminationTree tree = elimination_tree(grid, least_degree_order(grid));
  ASSERT_GT(tree.panels.size(), 10U);

  int column = 0;
  std::vector<const Panel*> waiting;
  for (const Panel& panel : tree.panels) {
    EXPECT_EQ(panel.first, column);
    column += panel.columns;
    EXPECT_EQ(&tree.panel_of(panel.first), &panel);
    EXPECT_EQ(&tree.panel_of(column - 1), &panel);
    const auto rows = tree.rows_of(panel);
    EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
    for (; !waiting.empty() && tree.parent_of(*waiting.back()) == &panel; waiting.pop_back()) {
      const auto below =
          tree.rows_of(*waiting.back()).subspan(static_cast<std::size_t>(waiting.back()->columns));
      EXPECT_TRUE(std::includes(rows.begin(), rows.end(), below.begin(), below.end()));
    }
    if (tree.parent_of(panel) != nullptr) waiting.push_back(&panel);
  }
  EXPECT_EQ(column, side * side);
  EXPECT_TRUE(waiting.empty());
}

}  // namespace
}  // namespace havers::sim
