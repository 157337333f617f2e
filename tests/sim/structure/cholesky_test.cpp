#include "sim/structure/cholesky.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

namespace havers::sim {
namespace {

// The chain of n springs held at one end: its answer to a pull at the free end is 1, 2, ..., n.
Eigen::SparseMatrix<double> chain(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, i + 1 < n ? 2.0 : 1.0);
    if (i + 1 < n) entries.emplace_back(i + 1, i, -1.0);
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(Cholesky, SolvesForSeveralColumns) {
  const Cholesky factor(chain(50));
  ASSERT_TRUE(factor.ok());
  Eigen::MatrixXd pulls = Eigen::MatrixXd::Zero(50, 2);
  pulls(49, 0) = 1.0;
  pulls(49, 1) = -3.0;
  const Eigen::MatrixXd x = factor.solve(pulls);
  for (int i = 0; i < 50; ++i) {
    EXPECT_NEAR(x(i, 0), i + 1.0, 1e-11);
    EXPECT_NEAR(x(i, 1), -3.0 * (i + 1.0), 1e-11);
  }
  EXPECT_GE(factor.nonzeros(), 99);
}

TEST(Cholesky, SaysWhenAMatrixIsNotPositiveDefinite) {
  Eigen::SparseMatrix<double> matrix = chain(5);
  matrix.coeffRef(3, 3) = -1.0;
  EXPECT_FALSE(Cholesky(matrix).ok());
}

TEST(Cholesky, ServesSeveralThreadsAtOnce) {
  const Cholesky factor(chain(200));
  const Eigen::VectorXd pull = Eigen::VectorXd::Unit(200, 199);
  const Eigen::VectorXd alone = factor.solve(pull);
  std::vector<Eigen::VectorXd> found(4);
  std::vector<std::thread> threads;
  for (Eigen::VectorXd& x : found)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) x = factor.solve(pull);
    });
  for (std::thread& thread : threads) thread.join();
  for (const Eigen::VectorXd& x : found) EXPECT_EQ(x, alone);
}

TEST(Cholesky, OutlivesTheThreadThatMadeIt) {
  std::optional<Cholesky> factor;
  std::thread([&] { factor.emplace(chain(10)); }).join();
  EXPECT_NEAR(factor->solve(Eigen::VectorXd::Unit(10, 9))(9), 10.0, 1e-12);
}

}  // namespace
}  // namespace havers::sim
