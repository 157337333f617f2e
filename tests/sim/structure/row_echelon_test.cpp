#include "sim/structure/row_echelon.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <set>

namespace havers::sim {
namespace {

// Rows of three entries among 30 columns, every third one the difference of the two before it.
TEST(RowEchelon, FindsAPivotForEachRowThatSaysSomethingNew) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> column(0, 29);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(60, 30);
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    if (i % 3 == 2)
      all.row(i) = all.row(i - 1) - all.row(i - 2);
    else
      for (int k = 0; k < 3; ++k) all(i, column(random)) += value(random);
  RowEchelon rows(1e-9);
  std::set<int> pivots;
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    RowEchelon::Row row;
    for (int k = 0; k < all.cols(); ++k)
      if (all(i, k) != 0.0) row.emplace_back(k, all(i, k));
    const int pivot = rows.add(row);
    EXPECT_EQ(pivot >= 0,
              pivots.size() < static_cast<std::size_t>(all.topRows(i + 1).fullPivLu().rank()));
    if (pivot < 0) continue;
    EXPECT_TRUE(pivots.insert(pivot).second) << pivot;
  }
  // The columns of pivots are independent: none but 0 is nothing to all rows.
  Eigen::MatrixXd chosen(all.rows(), 0);
  for (const int pivot : pivots) {
    chosen.conservativeResize(Eigen::NoChange, chosen.cols() + 1);
    chosen.rightCols<1>() = all.col(pivot);
  }
  EXPECT_EQ(chosen.fullPivLu().rank(), chosen.cols());
}

// A column that a row names twice counts as the sum.
TEST(RowEchelon, GivesNoPivotToWhatIsTooSmall) {
  RowEchelon rows(0.1);
  EXPECT_EQ(rows.add({{3, 0.06}, {5, 0.05}}), -1);
  EXPECT_EQ(rows.add({{3, 0.06}, {3, 0.06}, {5, 0.05}}), 3);
  EXPECT_EQ(rows.add({{3, 0.12}, {5, 0.05}}), -1);
  EXPECT_EQ(rows.add({{3, 0.12}, {5, 0.25}}), 5);
  EXPECT_EQ(rows.add({}), -1);
}

}  // namespace
}  // namespace havers::sim
