#include "sim/structure/sparse_factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <thread>
#include <vector>

namespace havers::sim {
namespace {

constexpr int links = 50;

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
  const SparseFactor factor(chain(), 1, end_first());
  ASSERT_TRUE(factor.ok());
  const Eigen::VectorXd x = factor.solve(-3.0 * Eigen::VectorXd::Unit(links + 1, links));
  for (int i = 0; i < links; ++i) EXPECT_NEAR(x(i), -3.0 * (i + 1.0) / links, 1e-13);
  EXPECT_NEAR(x(links), 3.0 / links, 1e-15);
  EXPECT_GE(factor.nonzeros(), 2 * links - 1);
}

// Half solutions give the products bᵀA⁻¹c, and with the other half the solution.
TEST(SparseFactor, SolvesByHalves) {
  const SparseFactor factor(chain(), 1, end_first());
  Eigen::MatrixX2d values(2, 2);
  values << 1.0, 0.5, -2.0, 3.0;
  const std::vector<int> rows{7, links};
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(links + 1, 2);
  b(7, Eigen::all) = values.row(0);
  b(links, Eigen::all) = values.row(1);
  Eigen::MatrixXd x(links + 1, 2);
  for (const Eigen::Index c : {0, 1}) x.col(c) = factor.solve(b.col(c));

  const HalfSolution half = factor.solve_half(rows, values);
  EXPECT_TRUE(std::is_sorted(half.rows.begin(), half.rows.end()));
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(links + 1, 2);
  for (std::size_t i = 0; i < half.rows.size(); ++i)
    w.row(half.rows[i]) = half.values.row(static_cast<Eigen::Index>(i));
  const Eigen::Matrix2d products = w.transpose() * factor.pivots().cwiseInverse().asDiagonal() * w;
  EXPECT_LT((products - b.transpose() * x).norm(), 1e-13 * products.norm());
  for (const Eigen::Index c : {0, 1})
    EXPECT_LT((factor.finish(w.col(c)) - x.col(c)).norm(), 1e-13 * x.col(c).norm());
  // What the next load finds must not be what this one left behind.
  EXPECT_EQ(factor.solve_half({3}, Eigen::MatrixX2d::Ones(1, 2)).values(0, 0), 1.0);
}

TEST(SparseFactor, SaysWhenItHasNoPivots) {
  Eigen::SparseMatrix<double> indefinite = chain();
  indefinite.coeffRef(3, 3) = -1.0;
  EXPECT_FALSE(SparseFactor(indefinite, 1, end_first()).ok());
  std::vector<int> too_early = end_first();
  std::swap(too_early[0], too_early[1]);
  EXPECT_FALSE(SparseFactor(chain(), 1, too_early).ok());
}

TEST(SparseFactor, ServesSeveralThreadsAtOnce) {
  const SparseFactor factor(chain(), 1, end_first());
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
  std::thread([&] { factor.emplace(chain(), 1, end_first()); }).join();
  EXPECT_NEAR(factor->solve(Eigen::VectorXd::Unit(links + 1, links))(links - 1), 1.0, 1e-14);
}

TEST(OrderOfLittleFill, LeavesNoneInAStar) {
  constexpr int arms = 20;  // eliminated first, the centre would connect them all
  std::vector<Eigen::Triplet<double>> entries{{0, 0, arms + 1.0}};
  for (int i = 1; i <= arms; ++i) {
    entries.emplace_back(i, i, 2.0);
    entries.emplace_back(i, 0, -1.0);
  }
  Eigen::SparseMatrix<double> star(arms + 1, arms + 1);
  star.setFromTriplets(entries.begin(), entries.end());
  EXPECT_EQ(SparseFactor(star, 0, order_of_little_fill(star)).nonzeros(), 2 * arms + 1);
}

// A cube of so many points that nested dissection is tried.
TEST(OrderOfLittleFill, NamesEveryRowOnceInACube) {
  constexpr int side = 18;
  std::vector<Eigen::Triplet<double>> entries;
  const auto row = [](int x, int y, int z) { return x + side * (y + side * z); };
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int here = row(x, y, z);
        entries.emplace_back(here, here, 7.0);
        if (x + 1 < side) entries.emplace_back(row(x + 1, y, z), here, -1.0);
        if (y + 1 < side) entries.emplace_back(row(x, y + 1, z), here, -1.0);
        if (z + 1 < side) entries.emplace_back(row(x, y, z + 1), here, -1.0);
      }
  constexpr int n = side * side * side;
  Eigen::SparseMatrix<double> lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  const std::vector<int> order = order_of_little_fill(lower);
  std::vector<int> rows = order;
  std::sort(rows.begin(), rows.end());
  for (int i = 0; i < n; ++i) ASSERT_EQ(rows[static_cast<std::size_t>(i)], i);
  EXPECT_LT(SparseFactor(lower, 0, order).nonzeros(), n * 82);  // by minimum degree 84 a row
}

}  // namespace
}  // namespace havers::sim
