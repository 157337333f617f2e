#include "sim/structure/sparse_factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "sim/structure/single_precision_factor.hpp"

namespace havers::sim {
namespace {

constexpr int links = 50;

// Each entry below the diagonal is an element, and so is each row with its own.
ElementMatrices elements_of(const Eigen::SparseMatrix<double>& lower, int multipliers) {
  ElementMatrices sum{.size = static_cast<int>(lower.rows()), .multipliers = multipliers};
  for (int j = 0; j < lower.cols(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry) {
      const bool diagonal = entry.row() == j;
      Eigen::MatrixXd matrix(1, 1);
      matrix(0, 0) = entry.value();
      if (!diagonal) matrix = Eigen::Matrix2d{{0.0, entry.value()}, {entry.value(), 0.0}};
      const auto known = std::ranges::find_if(sum.matrices, [&](const Eigen::MatrixXd& other) {
        return other.size() == matrix.size() && other == matrix;
      });
      sum.elements.push_back({static_cast<int>(known - sum.matrices.begin()), sum.rows.size()});
      if (known == sum.matrices.end()) sum.matrices.push_back(std::move(matrix));
      sum.rows.push_back(j);
      if (!diagonal) sum.rows.push_back(static_cast<int>(entry.row()));
    }
  return sum;
}

// Its rows are told apart by the elements on the diagonal: each is a supervariable.
std::shared_ptr<const EliminationTree> tree_of(const ElementMatrices& sum,
                                               const std::vector<int>& order, bool share) {
  auto tree = std::make_shared<EliminationTree>(elimination_tree(sum, Supervariables(sum), order));
  if (share) share_values(*tree, sum);
  return tree;
}

SparseFactor factor_of(const Eigen::SparseMatrix<double>& lower, int multipliers,
                       const std::vector<int>& order, bool share = false,
                       std::vector<double> memory = {}) {
  const ElementMatrices sum = elements_of(lower, multipliers);
  return SparseFactor(sum, tree_of(sum, order, share), {}, std::move(memory));
}

// A chain of springs of stiffness 1, held at one end, the other end's displacement prescribed by a
// multiplier: the lower triangle of (K Nᵀ; N 0).
Eigen::SparseMatrix<double> chain() {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < links; ++i) {
    entries.emplace_back(i, i, i + 1 < links ? 2.0 : 1.0);
    if (i + 1 < links) entries.emplace_back(i + 1, i, -1.0);
  }
  entries.emplace_back(links, links - 1, 1.0);
  Eigen::SparseMatrix<double> matrix(links + 1, links + 1);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// The end and its multiplier before all others.
std::vector<int> end_first() {
  std::vector<int> order{links - 1, links};
  for (int i = 0; i < links - 1; ++i) order.push_back(i);
  return order;
}

TEST(SparseFactor, StretchesAChain) {
  const SparseFactor factor = factor_of(chain(), 1, end_first());
  ASSERT_TRUE(factor.ok());
  const Eigen::VectorXd x = factor.solve(-3.0 * Eigen::VectorXd::Unit(links + 1, links));
  for (int i = 0; i < links; ++i) EXPECT_NEAR(x(i), -3.0 * (i + 1.0) / links, 1e-13);
  EXPECT_NEAR(x(links), 3.0 / links, 1e-15);
  EXPECT_EQ(factor.nonzeros(), 2 * links + 2);  // the only fill couples the multiplier to a link
}

TEST(SparseFactor, SolvesForFewEntriesAsForMany) {
  const SparseFactor factor = factor_of(chain(), 1, end_first());
  Eigen::MatrixX2d values(2, 2);
  values << 1.0, 0.5, -2.0, 3.0;
  const Eliminated half = factor.eliminate({7, 8}, values);
  EXPECT_TRUE(std::is_sorted(half.rows.begin(), half.rows.end()));
  Eigen::MatrixX2d b = Eigen::MatrixX2d::Zero(links + 1, 2);
  b.row(7) = values.row(0);
  b.row(8) = values.row(1);
  const Eigen::MatrixX2d x = factor.solve(b);
  for (const Eigen::Index c : {0, 1})
    EXPECT_LT((factor.solve(b.col(c)) - x.col(c)).norm(), 1e-13 * x.norm());

  // Of two that meet late, and of what must not find what the last one left behind.
  const Eliminated other = factor.eliminate({3}, Eigen::RowVector2d(1.0, -1.0));
  const Eigen::VectorXd unit = factor.solve(Eigen::VectorXd::Unit(links + 1, 3));
  const Eigen::RowVector2d expected = unit.transpose() * b;
  EXPECT_LT((product(factor.over_pivots(other), half).row(0) - expected).norm(),
            1e-13 * expected.norm());
  EXPECT_LT((product(half, factor.over_pivots(other)).col(1) + expected.transpose()).norm(),
            1e-13 * expected.norm());
}

// Panels of one column and of many, more than are taken from the others at once: (K Nᵀ; N 0) of a
// grid with all of its sides coupled, or dense, solved for one load and for three.
TEST(SparseFactor, SolvesWithPanelsOfAnyWidth) {
  for (const int side : {3, 9, 40}) {
    const int n = side * side, width = side < 40 ? n : side;  // the first two are dense
    const auto entry = [&](int i, int j) { return 1.0 / (1.0 + std::abs(i - j)); };
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < n; ++j) {
      entries.emplace_back(j, j, 0.1 + 4.0 * std::log(width));
      for (int i = j + 1; i < std::min(n, j / width * width + width); ++i)
        entries.emplace_back(i, j, entry(i, j));
      if (j + width < n) entries.emplace_back(j + width, j, -1.0);
    }
    constexpr int multipliers = 2;
    for (int m = 0; m < multipliers; ++m)
      for (int j = m; j < n; j += 3) entries.emplace_back(n + m, j, 1.0 + m);
    Eigen::SparseMatrix<double> lower(n + multipliers, n + multipliers);
    lower.setFromTriplets(entries.begin(), entries.end());
    std::vector<int> order =
        least_degree_order(Supervariables(elements_of(lower.topLeftCorner(n, n), 0)).graph());
    for (int m = 0; m < multipliers; ++m) order.push_back(n + m);
    const SparseFactor factor = factor_of(lower, multipliers, order);
    ASSERT_TRUE(factor.ok()) << side;

    const Eigen::MatrixXd dense = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
    for (const int loads : {1, 3}) {
      const Eigen::MatrixXd b = Eigen::MatrixXd::Random(n + multipliers, loads);
      EXPECT_LT((dense * factor.solve(b) - b).norm(), 1e-12 * b.norm()) << side;
    }
    const Eigen::Matrix2d values{{1.0, 2.0}, {0.5, -1.0}};
    Eigen::MatrixX2d few = Eigen::MatrixX2d::Zero(n + multipliers, 2);
    few(std::vector{1, 0}, Eigen::all) = values;
    const Eigen::MatrixX2d x = factor.solve(few);
    EXPECT_LT((dense * x - few).norm(), 1e-12 * few.norm()) << side;
    const Eliminated half = factor.eliminate({1, 0}, values);
    EXPECT_LT((product(factor.over_pivots(half), half) - few.transpose() * x).norm(), 1e-12)
        << side;
    Eigen::MatrixXd path = Eigen::MatrixXd::Zero(n + multipliers, 2);
    path(half.rows, Eigen::all) = half.values.transpose();
    EXPECT_LT((dense * factor.complete(path) - few).norm(), 1e-12 * few.norm()) << side;
    // A copy, and one that was found so.
    const ElementMatrices sum = elements_of(lower, multipliers);
    for (const SinglePrecisionFactor& single :
         {SinglePrecisionFactor(factor),
          SinglePrecisionFactor(sum, tree_of(sum, order, false), {})}) {
      ASSERT_TRUE(single.ok()) << side;
      const Eliminated nearly = single.eliminate({1, 0}, values);
      EXPECT_EQ(nearly.rows, half.rows);
      EXPECT_LT((nearly.values - half.values).norm(), 1e-6 * half.values.norm()) << side;
      EXPECT_LT((product(single.over_pivots(nearly), half) - few.transpose() * x).norm(), 1e-5)
          << side;
      const Eigen::VectorXd b = few.col(0);
      const Eigen::VectorXf halved = single.halve(b);
      for (const Eigen::VectorXd& of_b :
           {Eigen::VectorXd(path.col(0)), Eigen::VectorXd(halved.cast<double>())})
        EXPECT_LT((dense * single.complete(of_b).cast<double>() - b).norm(), 1e-5 * b.norm())
            << side;
    }
  }
}

// Grids whose last rows meet in a stem, which a multiplier holds.
Eigen::SparseMatrix<double> bunch_of_grids(int grids, int side, double first_entry) {
  std::vector<Eigen::Triplet<double>> entries;
  const int rows = side * side, stem = grids * rows;
  for (int grid = 0; grid < grids; ++grid)
    for (int i = 0; i < rows; ++i) {
      const auto add = [&](int row, double value) {
        entries.emplace_back(grid * rows + row, grid * rows + i, value);
      };
      add(i, grid == 0 && i == 0 ? first_entry : 4.5);
      if (i % side + 1 < side) add(i + 1, -1.0);
      if (i + side < rows)
        add(i + side, -1.0 - 0.003 * i);
      else
        entries.emplace_back(stem + i % side, grid * rows + i, -1.0);
    }
  for (int i = 0; i < side; ++i) {
    entries.emplace_back(stem + i, stem + i, 10.0 * grids);
    entries.emplace_back(stem + side, stem + i, 1.0 + i);
  }
  Eigen::SparseMatrix<double> matrix(stem + side + 1, stem + side + 1);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// The same but for rounding as if each had been computed. An entry that differs in its last digit
// is not the same, and neither is what it is handed on to. The stem is eliminated against the order
// of its rows, in which those below the grids' panels are kept.
TEST(SparseFactor, KeepsOnceWhatRepeatsItself) {
  constexpr int grids = 5, side = 6;
  std::size_t kept = 0;
  for (const double first_entry : {4.5, std::nextafter(4.5, 5.0)}) {
    const Eigen::SparseMatrix<double> lower = bunch_of_grids(grids, side, first_entry);
    std::vector<int> order(static_cast<std::size_t>(lower.rows()));
    std::iota(order.begin(), order.end(), 0);
    const SparseFactor shared = factor_of(lower, 1, order, true),
                       apart = factor_of(lower, 1, order);
    ASSERT_TRUE(shared.ok());
    EXPECT_EQ(shared.nonzeros(), apart.nonzeros());
    EXPECT_GT(shared.values(), kept);
    kept = shared.values();
    EXPECT_LT(3 * kept, 2 * apart.values());
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(lower.rows(), 3);
    EXPECT_EQ(shared.solve(b), apart.solve(b));
    const Eliminated one = shared.eliminate({side * side}, Eigen::RowVector2d(1.0, 2.0)),
                     other = apart.eliminate({side * side}, Eigen::RowVector2d(1.0, 2.0));
    EXPECT_EQ(one.rows, other.rows);
    EXPECT_EQ(one.values, other.values);
    const Eigen::MatrixXd dense = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
    EXPECT_LT((dense * shared.solve(b) - b).norm(), 1e-12 * b.norm());
  }
}

// The stem is eliminated against the order of its rows, in which panels have those below their own.
TEST(SparseFactor, FindsWhatRepeatsItselfInAnyOrder) {
  constexpr int side = 6;
  const Eigen::SparseMatrix<double> lower = bunch_of_grids(5, side, 4.5);
  std::vector<int> order(static_cast<std::size_t>(lower.rows()));
  std::iota(order.begin(), order.end(), 0);
  const std::size_t in_order = factor_of(lower, 1, order, true).values();
  std::reverse(order.end() - 1 - side, order.end() - 1);
  const SparseFactor factor = factor_of(lower, 1, order, true);
  ASSERT_TRUE(factor.ok());
  EXPECT_EQ(factor.values(), in_order);
  const Eigen::MatrixXd dense = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(lower.rows(), 3);
  EXPECT_LT((dense * factor.solve(b) - b).norm(), 1e-12 * b.norm());
}

// Of a smaller one, and of one that has left more behind than is needed.
TEST(SparseFactor, UsesTheMemoryOfAnotherAgain) {
  const Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(links + 1, -1.0, 2.0);
  const Eigen::VectorXd alone = factor_of(chain(), 1, end_first()).solve(load);
  for (const std::size_t values : {1U, 1000U}) {
    SparseFactor factor =
        factor_of(chain(), 1, end_first(), false, std::vector<double>(values, 7.0));
    EXPECT_EQ(factor.solve(load), alone);
    const SparseFactor next = factor_of(chain(), 1, end_first(), false, std::move(factor).memory());
    EXPECT_EQ(next.solve(load), alone);
  }
}

TEST(SparseFactor, SaysWhenItHasNoPivots) {
  Eigen::SparseMatrix<double> indefinite = chain();
  indefinite.coeffRef(3, 3) = -1.0;
  EXPECT_FALSE(factor_of(indefinite, 1, end_first()).ok());
  const ElementMatrices sum = elements_of(indefinite, 1);
  EXPECT_FALSE(SinglePrecisionFactor(sum, tree_of(sum, end_first(), false), {}).ok());
  std::vector<int> too_early = end_first();
  std::swap(too_early[0], too_early[1]);
  EXPECT_FALSE(factor_of(chain(), 1, too_early).ok());
}

TEST(SparseFactor, ServesSeveralThreadsAtOnce) {
  const SparseFactor factor = factor_of(chain(), 1, end_first());
  const Eigen::VectorXd stretch = Eigen::VectorXd::Unit(links + 1, links);
  const Eigen::VectorXd alone = factor.solve(stretch);
  std::vector<Eigen::VectorXd> found(4);
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (Eigen::VectorXd& x : found)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) x = factor.solve(stretch);
    });
  for (std::thread& thread : threads) thread.join();
  for (const Eigen::VectorXd& x : found) EXPECT_EQ(x, alone);
}

TEST(SparseFactor, OutlivesTheThreadThatMadeIt) {
  std::optional<SparseFactor> factor;
  std::thread([&] { factor.emplace(factor_of(chain(), 1, end_first())); }).join();
  EXPECT_NEAR(factor->solve(Eigen::VectorXd::Unit(links + 1, links))(links - 1), 1.0, 1e-14);
}

}  // namespace
}  // namespace havers::sim
